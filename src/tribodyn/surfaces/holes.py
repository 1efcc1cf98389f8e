"""Filling missing heights, where a method needs a height everywhere."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray


def filled(heights: FloatArray) -> FloatArray:
    """Return heights whose holes are filled by Gaussian means of what surrounds them.

    The width of the mean doubles until every hole is reached: a hole takes the nearest heights there are.

    Parameters
    ----------
    heights
        [m], shape (n,) or (n_y, n_x), NaN where missing, known somewhere.
    """
    from scipy.ndimage import gaussian_filter

    result = heights.copy()
    width = 1.0
    while np.any(holes := np.isnan(result)):
        known = (~np.isnan(heights)).astype(np.float64)
        share = gaussian_filter(known, width, mode="nearest")
        mean = gaussian_filter(np.where(known > 0.0, heights, 0.0), width, mode="nearest")
        reached = holes & (share > 1e-3)
        result[reached] = mean[reached] / share[reached]
        width *= 2.0
    return result
