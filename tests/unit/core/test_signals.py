"""Signals: smooth between kinks, exact for what a cubic can be."""

import numpy as np
import pytest
from scipy.interpolate import PPoly

from tribodyn.core.signals import Signal, constant, scaled, sinusoid, spline

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


@pytest.mark.parametrize("x", [[0.0, 1.0], [0.0, 1.0, 2.0]])
def test_two_and_three_points_are_enough(x: list[float]) -> None:
    assert at(spline(x, np.array(x) * 2.0), np.array([0.5])) == pytest.approx(1.0, abs=1e-15)


def test_a_factor_leaves_frequency_and_phase_alone() -> None:
    assert list(scaled(sinusoid(1.0, 2.0, 3.0, 4.0), -2.0).coefficients) == [-2.0, -4.0, 3.0, 4.0]
    assert list(scaled(constant(3.0), 2.0).coefficients) == [6.0]
    doubled = scaled(spline(POINTS, np.sin(POINTS)), 2.0)
    np.testing.assert_allclose(at(doubled, POINTS), 2.0 * np.sin(POINTS), atol=1e-15)
