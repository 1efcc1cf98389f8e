"""Fewer points of a curve that looks the same."""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

MOST: Final = 6000
"""Points of a curve above which it is thinned: three for each pixel of a wide screen."""


def thinned(x: FloatArray, y: FloatArray, most: int = MOST) -> tuple[FloatArray, FloatArray]:
    """Return a curve of at most ``most`` points with every peak in it.

    The curve is cut into stretches of equally many points; of each, the first, the last, the smallest and the
    largest are kept. Where a stretch holds a gap (NaN), one NaN is kept too.

    Parameters
    ----------
    x
        Increasing, shape (n,).
    y
        Shape (n,).
    most
        At least 5.

    Returns
    -------
    tuple of arrays
        Both of shape (m,), in the order of ``x``.
    """
    if x.size <= most:
        return x, y
    edges = np.linspace(0, x.size, most // 5 + 1).astype(int)
    kept = np.unique(np.concatenate([_extremes(y, a, b) for a, b in pairwise(edges)]))
    return x[kept], y[kept]


def _extremes(y: FloatArray, begin: int, end: int) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Return the indices to keep of ``y[begin:end]``."""
    part = y[begin:end]
    gaps = np.flatnonzero(np.isnan(part))
    ends = [0, part.size - 1, *gaps[:1]]
    inner = [] if gaps.size == part.size else [np.nanargmin(part), np.nanargmax(part)]
    return begin + np.array([*ends, *inner], dtype=np.intp)
