"""The entry point and the list of solvers."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.integrate import SOLVERS, integrate


def decay(t, y, data, memory, f):
    f[:] = -y


def decay_jac(t, y, data, memory, f, jacobian):
    jacobian[:] = -np.eye(y.size)


def observe(t, y, data, memory, row):
    row[:] = y


def nothing(*_):
    return None


PROBLEM = Problem(
    functions=CompiledFunctions(decay, decay_jac, nothing, nothing, nothing, observe, nothing),
    data=None,
    memory=None,
    y0=np.array([1.0, 2.0]),
    t_span=(0.0, 1.0),
    breakpoints=(0.5,),
    atol=np.full(2, 1e-9),
    state_names=("a", "b"),
    n_observed=2,
    field_shape=(),
)


@pytest.mark.parametrize("solver", SOLVERS)
def test_every_solver_reports_rows_and_cost(solver):
    y0 = PROBLEM.y0.copy()
    solution = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=np.linspace(0.0, 1.0, 5))
    exact = np.exp(-solution.t)[:, None] * y0
    np.testing.assert_allclose(solution.rows, exact, rtol=1e-4)  # accumulated over some 50 steps
    np.testing.assert_array_equal(PROBLEM.y0, y0)
    cost = solution.statistics
    assert cost.steps > 0
    assert cost.rhs_evaluations >= cost.steps
    assert cost.restarts == 1
    assert cost.wall_time > 0.0
    assert all(type(value) in (int, float) for value in vars(cost).values())


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_step_is_longer_than_asked(solver):
    ends = []
    functions = replace(PROBLEM.functions, accept=lambda t, *_: ends.append(t))
    problem = replace(PROBLEM, functions=functions, longest_step=0.01)
    integrate(problem, solver=solver, rtol=1e-2, output_times=[1.0])
    # Rounding of the times.
    assert np.diff([0.0, *ends]).max() <= 0.01 * (1.0 + 1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_rows_do_not_depend_on_each_other(solver):
    few = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=[1.0])
    many = integrate(PROBLEM, solver=solver, rtol=1e-6, output_times=np.linspace(0.0, 1.0, 101))
    np.testing.assert_array_equal(few.rows[-1], many.rows[-1])
    assert few.statistics.steps == many.statistics.steps


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"solver": "euler"}, r"solver\.name: unknown solver 'euler'; choose one of mebdf"),
        ({"rtol": 0.0}, r"solver\.rtol: rtol must lie between"),
        ({"rtol": float("nan")}, r"solver\.rtol: rtol must lie between"),
        ({"output_times": [2.0]}, "output times must lie between"),
    ],
)
def test_wrong_options_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        integrate(PROBLEM, **options)


def test_every_state_needs_a_tolerance():
    with pytest.raises(InputError, match="absolute tolerance"):
        integrate(replace(PROBLEM, atol=np.array([1e-6, 0.0])))


def test_importing_the_solvers_imports_neither_scipy_nor_numba():
    code = "import sys, tribodyn.integrate; sys.exit(bool({'scipy', 'numba', 'sksundae'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
