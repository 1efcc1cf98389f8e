"""Points and weights of Gauss and Legendre."""

from __future__ import annotations

from functools import cache

import numpy as np

from tribodyn.core.arrays import FloatArray


@cache
def gauss_legendre(n: int) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [-1, 1] and their weights, shape (n,) each, read-only: they are found once."""
    points, weights = np.polynomial.legendre.leggauss(n)
    points.flags.writeable = weights.flags.writeable = False
    return points, weights


def gauss_legendre_between(n: int, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` points on [first, last] and their weights, shape (n,) each."""
    points, weights = gauss_legendre(n)
    return 0.5 * ((last - first) * points + first + last), 0.5 * (last - first) * weights
