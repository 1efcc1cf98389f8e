"""The functions of a problem as methods call them."""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
import pytest

from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics
from tribodyn.integrate.binding import Binding, all_finite, kernel_types, machine_code


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
    return Binding(problem, machine_code(problem, kernel_types(problem)), statistics), statistics


def linear(t, y, data, memory, f):
    f[:] = t * y


def test_calls_are_counted_and_return_new_arrays():
    def jac(t, y, data, memory, f, jacobian):
        jacobian[0, 1] = 3.0

    binding, statistics = bind(make_problem(linear, jac))
    first, second = binding.rhs(1.0, np.ones(2)), binding.rhs(2.0, np.ones(2))
    np.testing.assert_array_equal([first, second], [[1.0, 1.0], [2.0, 2.0]])
    np.testing.assert_array_equal(binding.jac(0.0, np.ones(2)), [[0.0, 3.0], [0.0, 0.0]])
    assert statistics.rhs_evaluations == 2
    assert statistics.jacobian_evaluations == 1


def test_a_jacobian_may_be_overwritten_by_the_method():
    def jac(t, y, data, memory, f, jacobian):
        jacobian[:] = np.eye(2) if t == 0.0 else np.nan

    binding, _ = bind(make_problem(jac=jac))
    binding.jac(0.0, np.ones(2))[:] = 7.0
    np.testing.assert_array_equal(binding.jac(1.0, np.ones(2)), np.eye(2))


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


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_all_finite(bad):
    assert all_finite(np.array([1.0, -2.0, 0.0]))
    assert not all_finite(np.array([1.0, bad, 0.0]))
    assert not all_finite(np.array([np.inf, -np.inf]))


class Springs(NamedTuple):
    stiffness: np.ndarray
    mass: float


class Data(NamedTuple):
    springs: Springs


class Memory(NamedTuple):
    factor: np.ndarray


@numba.njit
def compiled_rhs(t, y, data, memory, f):
    f[0] = y[1]
    f[1] = -memory.factor[0] * data.springs.stiffness[0] * y[0] / data.springs.mass


def test_compiled_functions_are_called_directly_and_see_the_memory_change():
    memory = Memory(np.array([1.0]))
    problem = make_problem(compiled_rhs, data=Data(Springs(np.array([6.0]), 2.0)), memory=memory)
    assert numba.config.DISABLE_JIT or machine_code(problem, kernel_types(problem)).rhs is not compiled_rhs
    binding, _ = bind(problem)
    np.testing.assert_array_equal(binding.rhs(0.0, problem.y0), [2.0, -3.0])
    memory.factor[0] = 2.0
    np.testing.assert_array_equal(binding.rhs(0.0, problem.y0), [2.0, -6.0])


class Nested(NamedTuple):
    record: np.void
    pair: tuple[np.ndarray, np.ndarray]
    number: float


def test_types_of_data_are_those_that_numba_finds():
    record, matrix, fixed = np.zeros(1, dtype=[("a", "f8"), ("b", "i8", (2,))]), np.zeros((2, 3)), np.zeros(2)
    fixed.flags.writeable = False
    for pair in ((matrix, matrix.T), (fixed, np.zeros(2)), (matrix[:, ::2], record), (matrix, np.zeros(4))):
        data, memory = Nested(record[0], pair, 1.0), (record, pair)
        found = kernel_types(make_problem(rhs=compiled_rhs, data=data, memory=memory))
        assert numba.config.DISABLE_JIT or found == (numba.typeof(data), numba.typeof(memory))


def test_problems_of_one_kind_share_types_and_code_whatever_was_between():
    def kind(n):
        data = Data(Springs(np.array([6.0]), 2.0)) if n == 0 else (np.zeros((1,) * n),)
        return make_problem(compiled_rhs, data=data, memory=Memory(np.array([1.0])))

    first = kernel_types(kind(0))
    assert kernel_types(kind(0))[0] is first[0]
    for n in range(1, 20):
        kernel_types(kind(n))
    again = kernel_types(kind(0))
    assert again == first
    binding, _ = bind(kind(0))
    np.testing.assert_array_equal(binding.rhs(0.0, np.array([1.0, 2.0])), [2.0, -3.0])
