"""The functions of a problem as methods call them."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics
from tribodyn.integrate.base import Binding


def nothing(*_):
    return None


def make_problem(rhs=nothing, jac=nothing, data=None, memory=None):
    return Problem(
        functions=CompiledFunctions(rhs, jac, nothing, nothing, nothing, nothing, nothing),
        data=data,
        memory=memory,
        y0=np.array([1.0, 2.0]),
        t_span=(0.0, 1.0),
        breakpoints=(),
        atol=np.array([1e-6, 1e-6]),
        state_names=("gap", "speed"),
        n_observed=1,
        field_shape=(1, 2, 2),
    )


def bind(problem):
    statistics = Statistics()
    return Binding(problem, problem.functions, statistics), statistics


def linear(t, y, data, memory, f):
    f[:] = t * y


def test_a_first_jacobian_that_is_not_finite_names_the_entry():
    def jac(t, y, data, memory, f, jacobian):
        jacobian[1, 0] = np.inf

    binding, _ = bind(make_problem(jac=jac))
    with pytest.raises(IntegrationFailure, match=r"d\(rate of speed\)/d\(gap\) is not finite"):
        binding.jac(0.0, np.ones(2))


def test_a_rate_that_is_not_finite_is_noted_with_time_and_name():
    binding, _ = bind(make_problem(linear))
    binding.rhs(2.5, np.array([1.0, np.nan]))
    assert binding.reason("gave up") == "gave up; the rate of speed was not finite at t = 2.5 s"
