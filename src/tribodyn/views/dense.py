"""Times at which a motion between the rows of a result is drawn: it follows cubics from values and rates.

Rows follow the steps of the integrator, which are long where a body flies freely across its clearance. A
constant force then moves it along a parabola, which a cubic with the rates at both rows repeats; straight
lines between rows would show a polygon.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

LINE_ERROR: Final = 0.002
"""Largest error of a straight line for the motion in a clearance, over the clearance."""
_MOST: Final = 16
"""Samples between two rows, at most."""


def dense_times(time: FloatArray, values: FloatArray, rates: FloatArray, tolerance: float) -> FloatArray:
    """Return the times of the rows, and times between them where straight lines would miss the motion.

    A straight line misses a cubic by at most step × |difference of the end rates| / 8 to leading order.

    Parameters
    ----------
    time
        Times of the rows [s], increasing, shape (n_t,), at least two.
    values, rates
        At the rows, shape (n_t, n), and their derivatives [1/s]; both finite.
    tolerance
        What a line may miss, in the unit of the values.

    Returns
    -------
    FloatArray
        Times [s], increasing.
    """
    step = np.diff(time)
    miss = np.linalg.norm(np.diff(values, axis=0) - step[:, None] * rates[:-1], axis=1)
    miss = np.maximum(miss, np.linalg.norm(np.diff(values, axis=0) - step[:, None] * rates[1:], axis=1)) / 4.0
    pieces = np.clip(np.ceil(np.sqrt(miss / tolerance)), 1, _MOST).astype(int)
    number = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    begin, length = np.repeat(time[:-1], pieces), np.repeat(step, pieces)
    return np.append(begin + length * number / np.repeat(pieces, pieces), time[-1])
