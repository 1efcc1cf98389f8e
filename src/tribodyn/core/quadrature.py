"""Points and weights of Gauss and Legendre."""

import math
from functools import cache
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray

_ITERATIONS: Final = 6
"""Each doubles the digits of points that begin with three."""


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


def _legendre(n: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the Legendre polynomial of degree ``n`` and its slope at ``x``, |x| < 1."""
    before, value = np.zeros_like(x), np.ones_like(x)
    for k in range(n):
        before, value = value, ((2 * k + 1) * x * value - k * before) / (k + 1)
    return value, n * (x * value - before) / (x * x - 1.0)


def gauss_legendre_between(n: int, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [first, last] and their weights, shape (n,) each."""
    points, weights = gauss_legendre(n)
    return 0.5 * ((last - first) * points + first + last), 0.5 * (last - first) * weights
