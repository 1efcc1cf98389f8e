"""Runs that cannot reach their end: every solver says why and keeps what it has."""

import numpy as np
import pytest

from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.integrate import SOLVERS, integrate


def nothing(*_):
    return None


def observe(t, y, data, memory, row):
    row[:] = y[:1]


def oscillator_jac(t, y, data, memory, f, jacobian):
    jacobian[:] = [[0.0, 1.0], [-1.0, 0.0]]


def late(value):
    def rhs(t, y, data, memory, f):
        f[:] = y[1], -y[0] if t < 0.5 else value

    return rhs


def blow_up(t, y, data, memory, f):
    f[:] = y[0] ** 2, 0.0


def blow_up_jac(t, y, data, memory, f, jacobian):
    jacobian[0, 0] = 2.0 * y[0]


def root(t, y, data, memory, f):
    f[:] = -1e3 * (np.sqrt(y[0]) - 1.0) if y[0] >= 0.0 else np.nan, 0.0


def root_jac(t, y, data, memory, f, jacobian):
    jacobian[0, 0] = -500.0 / np.sqrt(y[0]) if y[0] > 0.0 else np.nan


def stiff(t, y, data, memory, f):
    f[:] = -1e6 * (y[0] - np.cos(t)), 0.0


def nan_jac(t, y, data, memory, f, jacobian):
    jacobian[:] = np.nan


def run(solver, rhs, jac, first=1.0, stop=None):
    problem = Problem(
        functions=CompiledFunctions(rhs, jac, nothing, nothing, nothing, observe, nothing),
        data=None,
        memory=None,
        y0=np.array([first, 0.0]),
        t_span=(0.0, 10.0),
        breakpoints=(),
        atol=np.full(2, 1e-8),
        state_names=("gap", "speed"),
        n_observed=1,
        field_shape=(),
    )
    return integrate(problem, solver=solver, rtol=1e-6, output_times=np.linspace(0.0, 10.0, 101), stop=stop)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("solver", SOLVERS)
def test_a_rate_that_stops_being_finite(solver, value):
    solution = run(solver, late(value), oscillator_jac)
    assert solution.failure is not None
    assert "stopped at t = 0." in solution.failure
    assert "not finite" in solution.failure
    # LSODA may go beyond 0.5 s only in the step that fails; up to there the solution is cos t.
    assert 0.4 < solution.t_end <= 0.5 + 1e-9
    assert solution.t.size in (5, 6)
    np.testing.assert_allclose(solution.rows[:, 0], np.cos(solution.t), atol=1e-4)
    assert np.isfinite(solution.y_end).all()


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_solution_that_blows_up(solver):
    solution = run(solver, blow_up, blow_up_jac)
    assert solution.failure is not None
    # y = 1 / (1 - t): the error of the pole grows with the local error of 1e-6 to some 1e-4.
    assert solution.t_end == pytest.approx(1.0, abs=1e-3)
    assert solution.t.size >= 10


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_trial_state_outside_the_model_is_no_failure(solver):
    solution = run(solver, root, root_jac, first=1e-9)
    assert solution.complete
    assert solution.y_end[0] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_start_where_the_model_is_not_defined(solver):
    solution = run(solver, root, root_jac, first=-1.0)
    assert solution.failure is not None
    assert "the rate of gap is not finite where a segment starts" in solution.failure
    assert solution.t.size == 0


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_jacobian_that_is_not_finite(solver):
    solution = run(solver, stiff, nan_jac)
    assert solution.failure is not None
    assert "d(rate of gap)/d(gap) is not finite" in solution.failure


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_programming_error_is_not_hidden(solver):
    def broken(t, y, data, memory, f):
        if t > 0.3:
            raise ZeroDivisionError("broken")
        f[:] = 0.0

    with pytest.raises(ZeroDivisionError, match="broken"):
        run(solver, broken, oscillator_jac)


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_interrupted_run_keeps_what_it_has(solver):
    count = iter(range(1000))
    solution = run(solver, late(1.0), oscillator_jac, stop=lambda: next(count) >= 5)
    assert solution.failure == "interrupted"
    assert solution.statistics.steps == 6
    assert solution.t.size == np.searchsorted(np.linspace(0.0, 10.0, 101), solution.t_end, side="right")
