"""Cubics and roots without SciPy: its numbers."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, CubicSpline
from scipy.linalg import solve_banded
from scipy.optimize import bisect

from tribodyn.core.splines import Cubics, bisected, spline, tridiagonal


@pytest.mark.parametrize("n", [4, 5, 100])
def test_values_and_derivatives_are_those_of_scipy(n: int) -> None:
    rng = np.random.default_rng(n)
    x = np.cumsum(rng.uniform(0.1, 1.0, n))
    y, slopes = rng.normal(size=n), rng.normal(size=n)
    wanted = np.concatenate([x, rng.uniform(x[0] - 1.0, x[-1] + 1.0, 50)])
    for ours, theirs in (
        (spline(x, y), CubicSpline(x, y)),
        (Cubics(x, y, slopes), CubicHermiteSpline(x, y, slopes)),
    ):
        assert ours(wanted) == pytest.approx(theirs(wanted), rel=1e-10, abs=1e-10)
        assert ours.derivative(wanted) == pytest.approx(theirs(wanted, 1), rel=1e-10, abs=1e-10)


def test_a_system_that_exchanges_rows_is_solved() -> None:
    rng = np.random.default_rng(0)
    below, diagonal, above = rng.normal(size=49), 0.1 * rng.normal(size=50), rng.normal(size=49)
    right = rng.normal(size=50)
    bands = np.array([np.append(0.0, above), diagonal, np.append(below, 0.0)])
    assert tridiagonal(below, diagonal, above, right) == pytest.approx(
        solve_banded((1, 1), bands, right), rel=1e-9
    )


@pytest.mark.parametrize(("low", "high"), [(0.0, 2.0), (1.0, 2.0), (0.0, 1.0), (3.0, 0.5)])
def test_the_root_is_that_of_scipy(low: float, high: float) -> None:
    def function(x: float) -> float:
        return math.expm1(x - 1.0)

    assert bisected(function, low, high, 1e-12) == bisect(function, low, high, xtol=1e-12)
