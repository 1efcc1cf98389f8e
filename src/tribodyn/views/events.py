"""When the motion turns around."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.series import peak, series

SETTLING: Final = 0.35
"""What follows a reversal within this time [s] counts as impact, not as smooth motion."""


def reversal_times(dataset: xr.Dataset) -> FloatArray:
    """Return when the ideal vane speed changes its sign [s], shape (n,); never where nothing is driven."""
    if "omega_v_ideal" not in dataset:
        return np.empty(0)
    speed = series(dataset, "omega_v_ideal")
    moving = np.isfinite(speed) & (speed != 0.0)
    time, speed = series(dataset, "time")[moving], speed[moving]
    turn = np.flatnonzero(speed[1:] * speed[:-1] < 0.0)
    share = np.abs(speed[turn]) / (np.abs(speed[turn]) + np.abs(speed[turn + 1]))
    return np.asarray(time[turn] + share * (time[turn + 1] - time[turn]), dtype=np.float64)


def direction(dataset: xr.Dataset) -> FloatArray:
    """Return +1 while the ideal vane angle grows and -1 while it falls, shape (n_t,)."""
    return np.where(series(dataset, "omega_v_ideal") >= 0.0, 1.0, -1.0)


def smooth_limits(time: FloatArray, values: FloatArray, turns: FloatArray) -> tuple[float, float] | None:
    """Return an ordinate that fits the smooth motion, where impacts would flatten it; otherwise nothing.

    Parameters
    ----------
    time
        Times [s], shape (n_t,).
    values
        What is drawn, shape (..., n_t).
    turns
        Reversal times [s].
    """
    smooth = np.ones(time.shape, dtype=bool)
    for turn in (0.0, *turns):
        smooth &= ~((time >= turn) & (time <= turn + SETTLING))
    quiet = peak(values[..., smooth])
    if not 0.0 < quiet < 0.5 * peak(values):
        return None
    return (-1.6 * quiet if np.nanmin(values) < 0.0 else 0.0), 1.6 * quiet
