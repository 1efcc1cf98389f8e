"""Numbers that follow time or a coordinate: constant, sinusoidal, or a smooth curve through a table."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class Signal:
    """A number that follows time or a coordinate: a polynomial between knots, or a sine.

    Attributes
    ----------
    kind
        ``constant``: c₀. ``sinusoid``: c₀ + c₁ sin(c₂ x + c₃). ``table``: a cubic spline, C² everywhere but
        at kinks.
    coefficients
        c of a constant or sinusoid, shape (1,) or (4,); of a table shape (4, n), highest power first, over
        the distance from the knot on the left.
    knots
        Shape (n + 1,), increasing; of no length without a table. The first and last value hold beyond.
    kinks
        Where the slope jumps: no step crosses them if the argument is time, shape (m,).
    """

    kind: str
    coefficients: FloatArray
    knots: FloatArray
    kinks: FloatArray


def constant(value: float) -> Signal:
    """Return a signal that never changes."""
    return Signal("constant", np.array([value]), np.empty(0), np.empty(0))


def sinusoid(mean: float, amplitude: float, angular_frequency: float, phase: float) -> Signal:
    """Return mean + amplitude sin(angular_frequency x + phase)."""
    return Signal("sinusoid", np.array([mean, amplitude, angular_frequency, phase]), np.empty(0), np.empty(0))


def spline(knots: ArrayLike, values: ArrayLike) -> Signal:
    """Return the cubic spline through a table, not-a-knot at its ends and on both sides of a kink.

    Parameters
    ----------
    knots
        Not decreasing, shape (n,), at least two different ones; one that stands there twice is a kink.
    values
        Shape (n,), the same on both sides of a kink.
    """
    # Imported here: SciPy takes longer than all of the package, and few cases have a table.
    from scipy.interpolate import CubicSpline

    x, y = np.asarray(knots, dtype=np.float64), np.asarray(values, dtype=np.float64)
    pieces = np.split(np.arange(x.size), np.flatnonzero(np.diff(x) == 0.0) + 1)
    smooth = [CubicSpline(x[piece], y[piece]) for piece in pieces]
    ends = np.array([x[0], *(x[piece[-1]] for piece in pieces)])
    return Signal("table", np.concatenate([part.c for part in smooth], axis=1), np.unique(x), ends)


def scaled(signal: Signal, factor: float) -> Signal:
    """Return a signal times a factor."""
    factors = np.array([factor, factor, 1.0, 1.0]) if signal.kind == "sinusoid" else factor
    return replace(signal, coefficients=signal.coefficients * factors)
