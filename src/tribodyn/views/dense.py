"""Values between the rows of a result, from values and rates: cubic Hermite polynomials.

Rows follow the steps of the integrator, which are long where a body flies freely across its clearance. A
constant force then moves it along a parabola, which a cubic with the rates at both rows repeats; straight
lines between rows would show a polygon.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

_MOST: Final = 16
"""Samples between two rows, at most."""


def hermite(times: FloatArray, time: FloatArray, values: FloatArray, rates: FloatArray) -> FloatArray:
    """Return values at other times, shape (n, ...).

    Parameters
    ----------
    times
        Where values are wanted, within ``time`` [s], shape (n,).
    time
        Times of the rows [s], increasing, shape (n_t,), at least two.
    values, rates
        At the rows, shape (n_t, ...), and their derivatives [1/s]; both finite.
    """
    k = np.clip(np.searchsorted(time, times, side="right") - 1, 0, time.size - 2)
    shape = (-1,) + (1,) * (values.ndim - 1)
    step = (time[k + 1] - time[k]).reshape(shape)
    s = ((times - time[k]) / (time[k + 1] - time[k])).reshape(shape)
    begin, end = (1.0 + 2.0 * s) * (1.0 - s) ** 2, s**2 * (3.0 - 2.0 * s)
    leave, arrive = s * (1.0 - s) ** 2, s**2 * (s - 1.0)
    return np.asarray(
        begin * values[k] + end * values[k + 1] + step * (leave * rates[k] + arrive * rates[k + 1])
    )


def dense_times(time: FloatArray, values: FloatArray, rates: FloatArray, tolerance: float) -> FloatArray:
    """Return the times of the rows, and times between them where straight lines would miss the motion.

    A straight line misses a cubic by at most step × |difference of the end rates| / 8 to leading order.

    Parameters
    ----------
    time, values, rates
        As for :func:`hermite`; values of shape (n_t, n).
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
    parts = [begin + length * np.arange(n) / n for begin, length, n in zip(time, step, pieces, strict=False)]
    return np.concatenate([*parts, time[-1:]])
