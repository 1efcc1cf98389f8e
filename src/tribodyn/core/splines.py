"""Cubic polynomials between nodes, a root, and points of Gauss and Legendre, without SciPy (0.3 s to import).

The operations are those of LAPACK's ``gtsv`` and of SciPy's ``PPoly`` and ``bisect`` in their order, so that
the numbers are theirs to the last bit, on any processor.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable


@dataclass(frozen=True)
class Cubics:
    """Cubic polynomials between nodes with given values and slopes; the outer ones go on beyond."""

    x: FloatArray  #: Nodes, rising, shape (n,).
    #: At the nodes, shape (n, ...).
    values: FloatArray
    slopes: FloatArray

    def _places(self, x: FloatArray) -> tuple[list[FloatArray], FloatArray]:
        """Return the coefficients of the polynomials at the positions, and the distance from their nodes."""
        others = (1,) * (self.values.ndim - 1)
        step = np.diff(self.x).reshape(-1, *others)
        chord = np.diff(self.values, axis=0) / step
        bend = (self.slopes[:-1] + self.slopes[1:] - 2.0 * chord) / step
        at = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, self.x.size - 2)
        square = (chord - self.slopes[:-1]) / step - bend
        coefficients = [part[at] for part in (self.values, self.slopes, square, bend / step)]
        return coefficients, np.reshape(x - self.x[at], (*x.shape, *others))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Return the values at positions of any shape, that shape and then that of a value."""
        (value, slope, square, cube), z = self._places(np.asarray(x, float))
        return np.asarray(value + slope * z + square * (z * z) + cube * (z * z * z))

    def derivative(self, x: FloatArray) -> FloatArray:
        """Return the first derivatives at positions of any shape, in the shape of the values there."""
        (_, slope, square, cube), z = self._places(np.asarray(x, float))
        return np.asarray(slope + square * z * 2.0 + cube * (z * z) * 3.0)


def spline(x: FloatArray, values: FloatArray) -> Cubics:
    """Return the cubic spline through four nodes or more, its third derivative continuous next to the ends.

    ``x``: nodes, rising, shape (n,); ``values``: at the nodes, shape (n,).

    Notes
    -----
    Conditions "not a knot"; C. de Boor, *A Practical Guide to Splines*, 1978, chapter IV.
    """
    step = np.diff(x)
    chord = np.diff(values) / step
    first, last = x[2] - x[0], x[-1] - x[-3]
    right = np.empty_like(values)
    right[0] = ((step[0] + 2.0 * first) * step[1] * chord[0] + step[0] ** 2 * chord[1]) / first
    right[1:-1] = 3.0 * (step[1:] * chord[:-1] + step[:-1] * chord[1:])
    right[-1] = (step[-1] ** 2 * chord[-2] + (2.0 * last + step[-1]) * step[-2] * chord[-1]) / last
    slopes = tridiagonal(
        np.append(step[1:], last),
        np.concatenate([step[1:2], 2.0 * (step[:-1] + step[1:]), step[-2:-1]]),
        np.append(first, step[:-1]),
        right,
    )
    return Cubics(x, values, slopes)


def tridiagonal(below: FloatArray, diagonal: FloatArray, above: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solution of a tridiagonal system by elimination with exchange of neighbouring rows.

    ``below``, ``diagonal``, ``above``: the matrix, regular, shapes (n - 1,), (n,), (n - 1,); ``right``:
    right-hand side, shape (n,).
    """
    low, mid, up, b = below.tolist(), diagonal.tolist(), above.tolist(), right.tolist()
    n = len(mid)
    far = [0.0] * n
    for i in range(n - 1):
        if abs(mid[i]) >= abs(low[i]):
            factor = low[i] / mid[i]
            mid[i + 1] -= factor * up[i]
            b[i + 1] -= factor * b[i]
            continue
        factor = mid[i] / low[i]
        mid[i], mid[i + 1], up[i] = low[i], up[i] - factor * mid[i + 1], mid[i + 1]
        b[i], b[i + 1] = b[i + 1], b[i] - factor * b[i + 1]
        if i < n - 2:
            far[i], up[i + 1] = up[i + 1], -factor * up[i + 1]
    b[-1] /= mid[-1]
    b[-2] = (b[-2] - up[-1] * b[-1]) / mid[-2]
    for i in range(n - 3, -1, -1):
        b[i] = (b[i] - up[i] * b[i + 1] - far[i] * b[i + 2]) / mid[i]
    return np.array(b)


def bisected(function: Callable[[float], float], low: float, high: float, tolerance: float) -> float:
    """Return a root between positions where a function has opposite signs, to a tolerance, by bisection."""
    at_low = function(low)
    if at_low == 0.0:
        return low
    if function(high) == 0.0:
        return high
    step = high - low
    while True:
        step *= 0.5
        middle = low + step
        value = function(middle)
        if math.copysign(1.0, value) == math.copysign(1.0, at_low):
            low = middle
        if value == 0.0 or abs(step) < tolerance + 4.0 * np.finfo(float).eps * abs(middle):
            return middle


_ITERATIONS: Final = 6  #: Each doubles the digits of points that begin with three.


@cache
def gauss_legendre(n: int) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [-1, 1] and their weights, shape (n,) each, read-only: they are found once.

    By Newton's method from equal angles, which each root of the Legendre polynomial is near to, and by the
    recurrence of the polynomials: Press et al., Numerical Recipes, section 4.6.
    """
    points = portable.cos(math.pi * (np.arange(n, 0, -1) - 0.25) / (n + 0.5))
    for _ in range(_ITERATIONS):
        value, slope = _legendre(n, points)
        points = points - value / slope
    _, slope = _legendre(n, points)
    weights = 2.0 / ((1.0 - points * points) * slope * slope)
    points.flags.writeable = weights.flags.writeable = False
    return points, weights


def _two(n: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the Legendre polynomials of degrees ``n - 1`` and ``n`` at ``x``."""
    before, value = np.zeros_like(x), np.ones_like(x)
    for k in range(n):
        before, value = value, ((2 * k + 1) * x * value - k * before) / (k + 1)
    return before, value


def _legendre(n: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the Legendre polynomial of degree ``n`` and its slope at ``x``, |x| < 1."""
    before, value = _two(n, x)
    return value, n * (x * value - before) / (x * x - 1.0)


def gauss_lobatto(n: int) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [0, 1], both ends among them, and their weights, shape (n,) each.

    Between the ends they are where the Legendre polynomial of degree n − 1 has no slope: Abramowitz and
    Stegun, Handbook of Mathematical Functions, 25.4.32.
    """
    degree = n - 1
    points = portable.cos(math.pi * np.arange(degree, -1, -1) / degree)
    for _ in range(4 * _ITERATIONS):
        before, value = _two(degree, points)
        points = points - (points * value - before) / (n * value)
    return 0.5 * (points + 1.0), 1.0 / (degree * n * _two(degree, points)[1] ** 2)


def gauss_legendre_between(n: int, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [first, last] and their weights, shape (n,) each."""
    points, weights = gauss_legendre(n)
    return 0.5 * ((last - first) * points + first + last), 0.5 * (last - first) * weights
