"""Fully implicit equations in the solver class: beside explicit ones, closed solutions, consistent starts."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).parents[3]))
from benchmarks.solver.dae_problems import pendulum
from benchmarks.solver.problems import PROBLEMS
from mebdf import MEBDF, solve_dae


def solve(fun, t_span, y0, slope, **options):
    return solve_ivp(fun, t_span, y0, method=MEBDF, slope=slope, **options)


def robertson(t, y, slope):
    slow, fast, last = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
    return [slope[0] + slow - fast, slope[1] - slow + fast + last, y[0] + y[1] + y[2] - 1.0]


def test_robertson_finds_its_slope():
    solution = solve(
        robertson, (0.0, 40.0), [1.0, 0.0, 0.0], np.zeros(3), rtol=1e-7, atol=[1e-9, 1e-12, 1e-9]
    )
    assert solution.success
    # Hindmarsh's values at t = 40; the tolerance is used up by a tenth or so.
    np.testing.assert_allclose(solution.y[:, -1], [0.7158271, 9.185535e-6, 0.2841637], rtol=1e-6)


def test_slopes_that_fade_among_large_terms_are_differenced_with_larger_changes():
    """E5: species of 1e-20 between rates that cancel; changes that showed at the start are lost."""
    problem = PROBLEMS["E5"]

    def rates(y):
        f = np.empty(4)
        problem.rhs(0.0, np.ascontiguousarray(y), f)
        return f

    def exact(t, y, slope):
        matrix = np.empty((4, 4))
        problem.jac(t, y, matrix)
        return -matrix, np.eye(4)

    ratios = []
    for tolerance in 10.0 ** -np.arange(3.0, 9.0):
        runs = [
            solve(
                lambda t, y, slope: slope - rates(y), (0.0, problem.t_end), problem.y0, np.zeros(4), jac=jac,
                rtol=tolerance, atol=tolerance * problem.atol,
            ) for jac in (None, exact)
        ]  # fmt: skip
        assert all(run.success for run in runs), (tolerance, runs[0].message)
        ratios.append(runs[0].nfev / runs[1].nfev)
    assert np.exp(np.mean(np.log(ratios))) < 1.4  # 1.11 to 1.14 in five such ensembles


@pytest.mark.parametrize("index", [1, 2, 3])
@pytest.mark.parametrize("exact", [True, False])
def test_the_pendulum_takes_what_it_takes_with_a_mass_matrix(index, exact):
    problem = pendulum(index)
    options = {"index": problem.index, "rtol": 1e-6, "atol": 1e-6}
    jac = (problem.jac, lambda t, y, slope: (-problem.jac(t, y), problem.mass)) if exact else (None, None)

    def residual(t, y, slope):
        return problem.mass @ slope - problem.fun(t, y)

    slope = np.array([0.0, 1.0, -1.0, -1.0, 0.0])
    implicit = solve(residual, (0.0, 1.0), problem.y0, slope, jac=jac[1], **options)
    explicit = solve_ivp(
        problem.fun, (0.0, 1.0), problem.y0, method=MEBDF, mass=problem.mass, jac=jac[0], **options
    )
    assert implicit.success
    # The force of index 3 has the least, 3.6: its error is multiplied by h² in the tests.
    assert problem.digits(implicit.y[:, -1]) > 3.0
    if exact:
        assert implicit.nfev == pytest.approx(explicit.nfev, rel=0.1)


@pytest.mark.parametrize(("slope", "end"), [(-1.0, 0.25), (1.0, 2.25)])
def test_an_equation_that_is_not_linear_in_the_slope(slope, end):
    """(y')² = y from 1 is (1 ± t/2)², as the sign of y' at the start has it."""
    solution = solve(lambda t, y, z: [z[0] ** 2 - y[0]], (0.0, 1.0), [1.0], [slope], rtol=1e-8, atol=1e-10)
    assert solution.y[0, -1] == pytest.approx(end, rel=1e-6)


def test_an_equation_that_no_slope_fulfils():
    with pytest.raises(ValueError, match="equation 0 does not hold, whatever `slope` is"):
        solve(lambda t, y, z: z**2 + 1.0, (0.0, 1.0), [0.0], [0.3], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("exact", [True, False])
def test_a_large_system(exact):
    n, rng = 70, np.random.default_rng(0)
    mass = np.eye(n) + 0.1 * rng.standard_normal((n, n)) / np.sqrt(n)
    rates = -np.linspace(1.0, 50.0, n)
    y0 = np.ones(n)

    def jac(t, y, slope):
        return np.diag(-rates), mass

    implicit = solve(
        lambda t, y, slope: mass @ slope - rates * y, (0.0, 0.5), y0, np.zeros(n),
        jac=jac if exact else None, rtol=1e-6, atol=1e-8,
    )  # fmt: skip
    values, vectors = np.linalg.eig(np.linalg.solve(mass, np.diag(rates)))
    found = (vectors * np.exp(0.5 * values)) @ np.linalg.solve(vectors, y0)
    np.testing.assert_allclose(implicit.y[:, -1], found.real, atol=1e-5)


def test_an_algebraic_value_is_found_and_told():
    with pytest.warns(UserWarning, match="changed component 1 from 0 to 0.5"):
        solution = solve(
            lambda t, y, z: [z[0] + y[1], 2.0 * y[1] - y[0]],
            (0.0, 1.0),
            [1.0, 0.0],
            [0.0, 0.0],
            rtol=1e-8,
            atol=1e-8,
        )
    assert solution.y[0, -1] == pytest.approx(np.exp(-0.5), rel=1e-6)


def test_events_and_breakpoints():
    def residual(t, y, slope):
        return [slope[0] + y[0] - (2.0 if t >= 1.0 else 0.0)]

    solution = solve(
        residual,
        (0.0, 3.0),
        [1.0],
        [0.0],
        breakpoints=[1.0],
        events=lambda t, y: y[0] - 1.0,
        rtol=1e-8,
        atol=1e-8,
    )
    middle = np.exp(-1.0)
    assert solution.t_events[0][-1] == pytest.approx(1.0 + np.log(2.0 - middle), rel=1e-6)
    assert solution.y[0, -1] == pytest.approx(2.0 + (middle - 2.0) * np.exp(-2.0), rel=1e-6)


def line(t, y, slope):
    return slope + y


@pytest.mark.parametrize(
    ("arguments", "options", "text"),
    [
        ((line, [1.0, 2.0], [0.0]), {}, "`slope` is expected to hold finite numbers"),
        ((line, [1.0], [np.nan]), {}, "`slope` is expected to hold finite numbers"),
        ((line, [1.0], [0.0]), {"mass": [1.0]}, "`slope` excludes `mass`"),
        ((line, [1.0], [0.0]), {"jac": [[1.0]]}, "is a function"),
        ((line, [1.0], [0.0]), {"jac": lambda t, y, z: (np.eye(2), np.eye(2))}, "two matrices"),
        ((lambda t, y, z: [1.0, 2.0], [1.0], [0.0]), {}, "is expected to return shape"),
        ((lambda t, y, z: z * np.nan, [1.0], [0.0]), {}, "not finite at t = 0"),
        ((lambda t, y, z: [z[0] + y[1], y[0] - 2.0], [1.0, 0.0], [0.0, 0.0]), {}, "equation 1 does not hold"),
    ],
)
def test_what_is_wrong_is_refused(arguments, options, text):
    fun, y0, slope = arguments
    with pytest.raises(ValueError, match=text):
        solve(fun, (0.0, 1.0), y0, slope, **options)


def test_a_residual_that_stops_being_finite_is_told():
    def residual(t, y, slope):
        return slope + y if t < 0.5 else slope * np.nan

    solution = solve(residual, (0.0, 1.0), [1.0], [0.0])
    assert not solution.success
    assert "was not finite at t = 0.5" in solution.message


# Functions of the slope alone, and their inverses.
LAWS = {
    "cubic": (lambda s: s**3 + s, lambda c: brentq(lambda s: s**3 + s - c, -9.0, 9.0)),
    "a third": (lambda s: s / 3.0, lambda c: 3.0 * c),
    "drag": (
        lambda s: 0.7 * s + 0.2 * s * np.abs(s),
        lambda c: brentq(lambda s: 0.7 * s + 0.2 * s * abs(s) - c, -99.0, 99.0),
    ),
    "exponential": (np.expm1, np.log1p),
    "sine": (np.sinh, np.arcsinh),
    "large terms": (lambda s: 1e8 * s, lambda c: 1e-8 * c),
}


@pytest.mark.parametrize("law", LAWS)
def test_equations_that_hold_no_value(law):
    # 20 of 29 such equations were refused for what rounding leaves of them.
    function, inverse = LAWS[law]
    rng = np.random.default_rng(len(law))
    for given in (0.0, 1.0) * 5:
        c, rtol = 10.0 ** rng.uniform(-3.0, 0.9), 10.0 ** rng.uniform(-9.0, -2.0)
        solution = solve(
            lambda t, y, s, c=c: function(s) - c, (0.0, 2.0), [1.0], [given], rtol=rtol, atol=rtol
        )
        assert solution.success
        assert solution.y[0, -1] == pytest.approx(1.0 + 2.0 * inverse(c), rel=10.0 * rtol)


def test_the_function_for_implicit_equations_takes_arguments_and_options():
    def residual(t, y, yp, k):
        return yp**3 + yp + k * y

    def jac(t, y, yp, k):
        return [[k]], [[3.0 * yp[0] ** 2 + 1.0]]

    def explicit(t, y):
        return [np.real(next(s for s in np.roots([1.0, 0.0, 1.0, 2.0 * y[0]]) if abs(s.imag) < 1e-9))]

    times = [1.0, 2.0]
    found = solve_dae(residual, (0.0, 2.0), [2.0], [0.0], args=(2.0,), jac=jac, t_eval=times, rtol=1e-7)
    expected = solve_ivp(explicit, (0.0, 2.0), [2.0], t_eval=times, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.y, expected.y, atol=1e-5)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize(
    ("residual", "rate"),
    [
        (lambda t, y, z: z**3 + z - 2.0, 1.0),
        (lambda t, y, z: z / 3.0 - 0.1, 0.3),
        (lambda t, y, z: np.exp(z) - 3.0, np.log(3.0)),
        (lambda t, y, z: 1e6 * (z / 3.0 - 0.1), 0.3),
    ],
)
def test_an_equation_that_holds_no_value(residual, rate, rtol):
    # What rounding leaves of it was more than no value allows: it was refused.
    solution = solve(residual, (0.0, 1.0), [0.0], [0.0], rtol=rtol, atol=1e-3 * rtol)
    assert solution.y[0, -1] == pytest.approx(rate, rel=rtol)
