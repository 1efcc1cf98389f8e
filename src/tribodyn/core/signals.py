"""Numbers that follow time or a coordinate: constant, sinusoidal, or a smooth curve through a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Final, Literal

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

_ROUNDING: Final = 1.0e-9


# One is equal to itself alone: arrays do not say of each other whether they are.
@dataclass(frozen=True, eq=False)
class Signal:
    """A number that follows time or a coordinate: a polynomial between knots, or a sine."""

    #: ``constant``: c₀. ``sinusoid``: c₀ + c₁ sin(c₂ x + c₃). ``table``: a cubic spline, C² everywhere but at
    #: kinks, or its integral.
    kind: str
    #: c of a constant or sinusoid, shape (1,) or (4,); of a table shape (4, n) or (5, n), highest power
    #: first, over the distance from the knot on the left.
    coefficients: FloatArray
    #: Shape (n + 1,), increasing; of no length without a table. The first and last value hold beyond.
    knots: FloatArray
    #: Where the slope, or what follows from it, jumps: no step crosses them if the argument is time, shape
    #: (m,).
    kinks: FloatArray
    #: Distance after which a table repeats, which is its length but for rounding; 0 where it does not.
    period: float = 0.0

    def __call__(self, places: FloatArray) -> FloatArray:
        """Return the values of a table, shape of ``places``."""
        return np.asarray(self._curve(np.clip(places, self.knots[0], self.knots[-1])))

    def at(self, place: float) -> float:
        """Return the value at one place."""
        c = self.coefficients
        if self.kind == "table":
            return float(self(np.array([place]))[0])
        return float(c[0] if self.kind == "constant" else c[0] + c[1] * math.sin(c[2] * place + c[3]))

    def slope(self, places: FloatArray, order: int) -> FloatArray:
        """Return derivatives of a table of some order inside it, shape of ``places``."""
        return np.asarray(self._curve(places, order))

    def kinks_within(self, low: float, high: float) -> FloatArray:
        """Return the kinks between two places, and one beyond each, shape (m,)."""
        if not self.period:
            return self.kinks
        first, last = np.floor((np.array([low, high]) - self.knots[0]) / self.period)
        return np.unique(self.kinks + self.period * np.arange(first - 1.0, last + 2.0)[:, None])

    @property
    def at_start(self) -> float:
        """Value of a table at zero."""
        return self.at(0.0)

    def zeros(self, order: int) -> FloatArray:
        """Return the zeros of a derivative of a table, shape (m,); begins of zero pieces."""
        found = np.asarray(self._curve.derivative(order).roots(extrapolate=False))
        return found[np.isfinite(found)]

    def least(self, until: float) -> tuple[float, float]:
        """Return the place of a table's least value between zero and ``until``, and that value."""
        places = np.concatenate([[0.0, until], self.knots, self.zeros(1)])
        places = places[(places >= 0.0) & (places <= until)]
        values = self(places)
        return float(places[values.argmin()]), float(values.min())

    @cached_property
    def _curve(self) -> PPoly:
        from scipy.interpolate import PPoly

        return PPoly(self.coefficients, self.knots)


def constant(value: float) -> Signal:
    """Return a signal that never changes."""
    return Signal("constant", np.array([value]), np.empty(0), np.empty(0))


def sinusoid(mean: float, amplitude: float, angular_frequency: float, phase: float) -> Signal:
    """Return mean + amplitude sin(angular_frequency x + phase)."""
    return Signal("sinusoid", np.array([mean, amplitude, angular_frequency, phase]), np.empty(0), np.empty(0))


def spline(knots: ArrayLike, values: ArrayLike, *, closed: bool = False) -> Signal:
    """Return the cubic spline through a table, not-a-knot at its ends and on both sides of a kink.

    ``knots``: not decreasing, shape (n,), at least two different ones; one that stands there twice is a kink;
    ``values``: shape (n,), the same on both sides of a kink; ``closed``: whether the curve is to go on
    smoothly from its end to its beginning, where they have one value and nothing kinks between.
    """
    # Imported here: SciPy takes longer than all of the package, and few cases have a table.
    from scipy.interpolate import CubicSpline

    x, y = np.asarray(knots, dtype=np.float64), np.asarray(values, dtype=np.float64)
    pieces = np.split(np.arange(x.size), np.flatnonzero(np.diff(x) == 0.0) + 1)
    round_trip = closed and len(pieces) == 1 and x.size > 2 and bool(y[0] == y[-1])
    ends: Literal["periodic", "not-a-knot"] = "periodic" if round_trip else "not-a-knot"
    smooth = [CubicSpline(x[piece], y[piece], bc_type=ends) for piece in pieces]
    kinks = np.array([x[0], *(x[piece[-1]] for piece in pieces)])
    return Signal("table", np.concatenate([part.c for part in smooth], axis=1), np.unique(x), kinks)


def smoothed(knots: ArrayLike, values: ArrayLike) -> Signal:
    """Return a cubic spline near the rows of a table that was measured with noise.

    How near is chosen by generalised cross-validation, as in Woltring, Adv. Eng. Softw. 8 (1986) 104-113.

    ``knots``: increasing, shape (n,), five at least; ``values``: shape (n,).
    """
    from scipy.interpolate import PPoly, make_smoothing_spline

    x = np.asarray(knots, dtype=np.float64)
    found = make_smoothing_spline(x, np.asarray(values, dtype=np.float64))
    curve = PPoly.from_spline(found.tck)
    wide = np.flatnonzero(np.diff(curve.x) > 0.0)
    return Signal("table", curve.c[:, wide], np.append(curve.x[wide], x[-1]), x[[0, -1]])


def polyline(knots: ArrayLike, values: ArrayLike, corner: float) -> Signal:
    """Return straight lines through a table whose corners are parabolas: ramps and holds of what has a mass.

    ``knots``: increasing, shape (n,), two at least; ``values``: shape (n,); ``corner``: length of the
    parabolas, half of it on either side of a row; less where rows stand closer.
    """
    x, y = np.asarray(knots, dtype=np.float64), np.asarray(values, dtype=np.float64)
    slope, rows = np.diff(y) / np.diff(x), []
    gap = np.concatenate([[np.inf], np.diff(x), [np.inf]])
    left, value = x[0], y[0]
    for i in range(1, x.size - 1):
        before, after = slope[i - 1], slope[i]
        if before == after:
            continue
        half = 0.5 * min(corner, gap[i], gap[i + 1])
        rows.append((left, value, before, 0.0))
        rows.append((x[i] - half, y[i] - before * half, before, (after - before) / (4.0 * half)))
        left, value = x[i] + half, y[i] + after * half
    rows.append((left, value, slope[-1], 0.0))
    table = np.array([row for k, row in enumerate(rows) if k + 1 == len(rows) or row[0] < rows[k + 1][0]])
    ends = np.append(table[:, 0], x[-1])
    inner = np.vstack([np.zeros(len(table)), table[:, 3], table[:, 2], table[:, 1]])
    wide = np.diff(ends) > 0.0
    places = np.append(ends[:-1][wide], x[-1])
    return Signal("table", inner[:, wide], places, places)


def pulse(begin: float, length: float, height: float, base: float = 0.0) -> Signal:
    """Return base + height sin²(π (x − begin)/length) over one pulse, and the base elsewhere, as a table.

    Its middle counts as a kink, too: a step over all of it would see the base alone.
    """
    from mebdf.kernels.elementary import portable

    phase = np.linspace(0.0, 1.0, 65)
    shape = portable.sin(np.pi * phase) ** 2
    shape[-1] = 0.0
    curve = spline(begin + length * phase, base + height * shape, closed=True)
    return replace(curve, kinks=begin + length * np.array([0.0, 0.5, 1.0]))


def repeated(signal: Signal, n: int, rise: float = 0.0) -> Signal:
    """Return a table ``n`` times, one after the other, each time higher by ``rise``."""
    length = signal.knots[-1] - signal.knots[0]
    shifts = length * np.arange(n)[:, None]
    knots = (shifts + signal.knots[None, :-1]).ravel()
    coefficients = np.tile(signal.coefficients, n)
    coefficients[-1] += np.repeat(rise * np.arange(n), signal.knots.size - 1)
    return replace(
        signal,
        coefficients=coefficients,
        knots=np.append(knots, signal.knots[-1] + shifts[-1]),
        # Where one ends the next begins, at one instant and not at two that differ by rounding.
        kinks=np.append((shifts + signal.kinks[None, :-1]).ravel(), signal.kinks[-1] + shifts[-1]),
    )


def turning(signal: Signal, turns: int) -> Signal:
    """Return a table over angles [rad] that repeats after some whole turns; as it is for none."""
    return replace(signal, period=2.0 * math.pi * turns)


def for_each_cycle(signal: Signal, cycle: float, duration: float, rise: float = 0.0) -> Signal:
    """Return a table over one cycle [s] once for each cycle of a run; ``rise`` as for :func:`repeated`."""
    return repeated(signal, max(1, math.ceil(duration / cycle * (1.0 - _ROUNDING))), rise)


def summed(parts: Sequence[tuple[Signal, float]]) -> Signal:
    """Return the sum of tables over the same argument, each times a factor; beyond a table its ends hold."""
    knots = np.unique(np.concatenate([part.knots for part, _ in parts]))
    inner = knots[:-1]
    coefficients = np.zeros((4, inner.size))
    for part, factor in parts:
        coefficients[3] += factor * part(inner)
        within = (inner >= part.knots[0]) & (inner < part.knots[-1])
        for power, faculty in ((1, 1.0), (2, 2.0), (3, 6.0)):
            coefficients[3 - power, within] += factor * part.slope(inner[within], power) / faculty
    kinks = np.unique(np.concatenate([part.kinks for part, _ in parts]))
    return Signal("table", coefficients, knots, kinks)


def begun(signal: Signal, time: float) -> Signal:
    """Return a table over time as it goes on after some time, which is zero then."""
    return replace(signal, knots=signal.knots - time, kinks=signal.kinks - time)


def scaled(signal: Signal, factor: float) -> Signal:
    """Return a signal times a factor."""
    factors = np.array([factor, factor, 1.0, 1.0]) if signal.kind == "sinusoid" else factor
    return replace(signal, coefficients=signal.coefficients * factors)
