"""Signals: smooth between kinks, exact for what a cubic can be."""

import numpy as np
from scipy.interpolate import PPoly

from tribodyn.core.signals import Signal, spline

POINTS = np.linspace(0.0, 2.0, 41)


def at(signal: Signal, x: np.ndarray, order: int = 0) -> np.ndarray:
    return np.asarray(PPoly(signal.coefficients, signal.knots).derivative(order)(x))


def test_a_cubic_comes_back_with_its_derivatives() -> None:
    signal = spline(np.linspace(0.0, 2.0, 7), np.linspace(0.0, 2.0, 7) ** 3)
    # Rounding of a spline through seven points.
    np.testing.assert_allclose(at(signal, POINTS), POINTS**3, atol=1e-13)
    np.testing.assert_allclose(at(signal, POINTS, 2), 6.0 * POINTS, atol=1e-11)
    assert list(signal.kinks) == [0.0, 2.0]


def test_a_knot_that_stands_there_twice_is_a_kink() -> None:
    x = np.array([0.0, 0.3, 0.6, 1.0, 1.0, 1.4, 1.7, 2.0])
    signal = spline(x, np.abs(x - 1.0))
    np.testing.assert_allclose(at(signal, POINTS), np.abs(POINTS - 1.0), atol=1e-14)
    assert list(signal.kinks) == [0.0, 1.0, 2.0]
    assert list(signal.knots) == [0.0, 0.3, 0.6, 1.0, 1.4, 1.7, 2.0]
