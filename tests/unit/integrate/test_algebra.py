"""A problem that solves with its Newton matrix itself: a chain whose matrix is tridiagonal."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, LinearSolver, Problem
from tribodyn.integrate import SOLVERS, integrate
from tribodyn.kernels.jit import kernel

RATE = 400.0


def rhs(t, y, data, memory, f):
    """Diffusion along a chain between walls at zero, with a cubic sink."""
    n = y.size
    for i in range(n):
        left = y[i - 1] if i > 0 else 0.0
        right = y[i + 1] if i < n - 1 else 0.0
        f[i] = data * (left - 2.0 * y[i] + right) - y[i] ** 3


def jac_dense(t, y, data, memory, f, jacobian):
    n = y.size
    for i in range(n):
        jacobian[i, i] = -2.0 * data - 3.0 * y[i] ** 2
        if i > 0:
            jacobian[i, i - 1] = data
        if i < n - 1:
            jacobian[i, i + 1] = data


def jac_entries(t, y, data, memory, f, jacobian):
    """Fill lower, main and upper diagonal one after the other."""
    n = y.size
    jacobian[: n - 1] = data
    jacobian[2 * n - 1 :] = data
    for i in range(n):
        jacobian[n - 1 + i] = -2.0 * data - 3.0 * y[i] ** 2


def factorise(gamma, data, jacobian, factors, pivots):
    """Gaussian elimination without pivoting: multipliers, pivots, upper diagonal."""
    n = (jacobian.size + 2) // 3
    for i in range(jacobian.size):
        factors[i] = -gamma * jacobian[i]
    factors[n - 1] += 1.0
    for i in range(1, n):
        factors[n - 1 + i] += 1.0
        factors[i - 1] /= factors[n - 2 + i]
        factors[n - 1 + i] -= factors[i - 1] * factors[2 * n - 2 + i]
    for i in range(factors.size):
        if not np.isfinite(factors[i]):
            return 0
    return 1


def solve(data, factors, pivots, x):
    n = x.size
    for i in range(1, n):
        x[i] -= factors[i - 1] * x[i - 1]
    x[n - 1] /= factors[2 * n - 2]
    for i in range(n - 2, -1, -1):
        x[i] = (x[i] - factors[2 * n - 1 + i] * x[i + 1]) / factors[n - 1 + i]


def observe(t, y, data, memory, row):
    row[0] = y[y.size // 2]


def nothing(t, y, data, memory):
    pass


def advance(t_a, t_b, y_b, data, memory):
    pass


def picture(t, y, data, memory, fields):
    pass


def chain(n, own, compiled=True, breakpoints=(0.5,)):
    made = kernel if compiled else lambda function: function
    jac = jac_entries if own else jac_dense
    k = np.arange(n)
    places = np.array([[*k[1:], *k, *k[:-1]], [*k[:-1], *k, *k[1:]]])
    return Problem(
        functions=CompiledFunctions(*map(made, (rhs, jac, nothing, advance, nothing, observe, picture))),
        data=RATE,
        memory=0.0,
        y0=np.sin(np.pi * (k + 1) / (n + 1)),
        t_span=(0.0, 1.0),
        breakpoints=breakpoints,
        atol=np.full(n, 1e-8),
        state_names=tuple(f"y{i}" for i in k),
        n_observed=1,
        field_shape=(),
        algebra=LinearSolver(places, made(factorise), made(solve), 3 * n - 2) if own else None,
    )


@pytest.mark.parametrize("compiled", [pytest.param(True, marks=pytest.mark.long), False])
def test_its_own_algebra_takes_the_steps_of_the_dense_one(compiled):
    times = np.linspace(0.0, 1.0, 6)
    runs = [integrate(chain(30, own, compiled), rtol=1e-6, output_times=times) for own in (False, True)]
    assert all(run.complete for run in runs)
    # The same corrections but for the rounding of the elimination, magnified by some hundred steps.
    np.testing.assert_allclose(runs[0].rows, runs[1].rows, rtol=1e-9)
    costs = [(run.statistics.steps, run.statistics.lu_decompositions) for run in runs]
    assert costs[0] == costs[1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_every_solver_takes_its_entries(solver):
    solution = integrate(chain(6, True, compiled=False), solver=solver, rtol=1e-6, output_times=[0.1])
    dense = integrate(chain(6, False, compiled=False), rtol=1e-8, output_times=[0.1])
    # Some hundred steps, each within 1e-6 of it and 1e-8.
    np.testing.assert_allclose(solution.rows, dense.rows, rtol=1e-4, atol=1e-6)


def test_memory_grows_with_the_number_of_states():
    peaks = []
    for n in (1000, 4000):
        problem = chain(n, own=True, compiled=False)
        integrate(replace(problem, t_span=(0.0, 1e-6), breakpoints=()))  # imports
        tracemalloc.start()
        integrate(replace(problem, t_span=(0.0, 1e-3), breakpoints=()))
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 4.5 * peaks[0]
    assert peaks[1] < 8 * 4000**2 / 10  # a tenth of one dense matrix


def with_mass(n, own, **changes):
    mass = np.ones(n)
    mass[1::2] = 0.0
    problem = replace(chain(n, own, compiled=False), mass=mass, **changes)
    if problem.algebra is None:
        return problem

    def factorise_with_mass(gamma, data, jacobian, factors, pivots):
        """Gaussian elimination as above, with the mass on the diagonal."""
        factors[:] = -gamma * jacobian
        factors[n - 1 : 2 * n - 1] += mass
        for i in range(1, n):
            factors[i - 1] /= factors[n - 2 + i]
            factors[n - 1 + i] -= factors[i - 1] * factors[2 * n - 2 + i]
        return bool(np.all(np.isfinite(factors)))

    return replace(problem, algebra=replace(problem.algebra, factorise=factorise_with_mass))


def test_a_mass_matrix_with_either_algebra():
    times = [0.0, 0.05, 0.1]
    runs = [integrate(with_mass(9, own), rtol=1e-7, output_times=times) for own in (False, True)]
    assert all(run.complete for run in runs)
    np.testing.assert_allclose(runs[0].rows, runs[1].rows, rtol=1e-8)
    # Algebraic values are those of the cubic equation, from the first row on.
    y = runs[0].y_end
    inner = RATE * (y[:-2:2] - 2.0 * y[1::2] + y[2::2]) - y[1::2] ** 3
    np.testing.assert_allclose(inner, 0.0, atol=1e-4 * RATE)


def test_other_solvers_refuse_a_mass_matrix():
    with pytest.raises(InputError, match="'bdf' takes no mass matrix; choose mebdf"):
        integrate(with_mass(5, own=False), solver="bdf")


def test_values_that_cannot_be_consistent_end_the_run():
    def unsolvable(t, y, data, memory, f):
        rhs(t, y, data, memory, f)
        f[1] = 1.0 + y[1] ** 2

    problem = with_mass(5, own=False)
    problem = replace(problem, functions=replace(problem.functions, rhs=unsolvable))
    assert "not consistent" in (integrate(problem).failure or "")


@pytest.mark.parametrize("own", [pytest.param(False, marks=pytest.mark.long), True])
def test_the_equation_that_does_not_hold_is_named_among_many_equations(own):
    def unsolvable(t, y, data, memory, f):
        rhs(t, y, data, memory, f)
        f[101] = 1.0 + y[101] ** 2

    problem = with_mass(151, own)
    problem = replace(problem, functions=replace(problem.functions, rhs=unsolvable))
    failure = integrate(problem).failure or ""
    assert "The values at t = 0 are not consistent: equation 101 leaves a residual of" in failure
    assert "no consistent value was found for y101" in failure


@pytest.mark.parametrize("own", [False, True])
def test_many_equations_begin_with_consistent_values(own):
    problem = with_mass(601, own, t_span=(0.0, 1e-4), breakpoints=())
    run = integrate(replace(problem, y0=problem.y0 * problem.mass), rtol=1e-6, output_times=[0.0])
    assert run.complete, run.failure
    y = run.y_end
    inner = RATE * (y[:-2:2] - 2.0 * y[1::2] + y[2::2]) - y[1::2] ** 3
    np.testing.assert_allclose(inner, 0.0, atol=1e-4 * RATE)


def test_a_jacobian_that_is_not_finite_is_told_by_its_entry():
    def broken(t, y, data, memory, f, jacobian):
        jac_entries(t, y, data, memory, f, jacobian)
        jacobian[3] = np.nan

    problem = chain(5, own=True, compiled=False)
    problem = replace(problem, functions=replace(problem.functions, jac=broken))
    assert "d(rate of y4)/d(y3) is not finite" in (integrate(problem).failure or "")


def test_a_matrix_that_is_always_singular_ends_the_run():
    problem = chain(5, own=True, compiled=False)
    assert problem.algebra is not None
    singular = replace(problem.algebra, factorise=lambda *arguments: False)
    failure = integrate(replace(problem, algebra=singular)).failure or ""
    assert "the matrix of Newton's iteration is singular" in failure
