"""When the motion turns around."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.style import GREY, SMALL, peak, series

SETTLING: Final = 0.35
"""What follows a reversal within this time [s] counts as impact, not as smooth motion."""


def reversal_times(dataset: xr.Dataset) -> FloatArray:
    """Return the times [s] at which the ideal vane speed changes its sign, shape (n,)."""
    speed = series(dataset, "omega_v_ideal")
    moving = np.isfinite(speed) & (speed != 0.0)
    time, speed = series(dataset, "time")[moving], speed[moving]
    turn = np.flatnonzero(speed[1:] * speed[:-1] < 0.0)
    share = np.abs(speed[turn]) / (np.abs(speed[turn]) + np.abs(speed[turn + 1]))
    return np.asarray(time[turn] + share * (time[turn + 1] - time[turn]), dtype=np.float64)


def direction(dataset: xr.Dataset) -> FloatArray:
    """Return +1 while the ideal vane angle grows and -1 while it falls, shape (n_t,)."""
    return np.where(series(dataset, "omega_v_ideal") >= 0.0, 1.0, -1.0)


def mark_reversals(axes: Axes, times: FloatArray, label: bool = False) -> None:
    """Draw a fine line at each reversal, and name the first one above the axes if asked."""
    for time in times:
        axes.axvline(time, color=GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=1)
    if label and times.size:
        axes.annotate(
            "vane reverses",
            (times[0], 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            size=SMALL - 0.5,
            color=GREY,
        )


def limit_to_smooth(axes: Axes, time: FloatArray, values: FloatArray, turns: FloatArray, unit: str) -> None:
    """Scale the y axis to the smooth motion where impacts would flatten it, and say what lies outside.

    Parameters
    ----------
    axes
        Axes to scale; an axis that begins at zero stays so.
    time
        Times [s], shape (n_t,).
    values
        What is drawn, shape (..., n_t).
    turns
        Reversal times [s].
    unit
        Unit of the values.
    """
    limits = smooth_limits(time, values, turns)
    if not limits:
        return
    axes.set_ylim(*limits)
    loud = peak(values)
    text = f"cut off: impacts reach {loud:.3g} {unit}"
    axes.text(1.0, 1.02, text, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)


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
