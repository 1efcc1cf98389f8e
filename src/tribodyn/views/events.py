"""Variables of a result as arrays to draw, and the reversals of its motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.results.reading import column

if TYPE_CHECKING:
    import xarray as xr


def series(dataset: xr.Dataset, name: str, scale: float = 1.0) -> FloatArray:
    """Return a variable as an array times ``scale``, shape (n_t,); infinities become NaN."""
    values = column(dataset, name) * scale
    return np.where(np.isfinite(values), values, np.nan)


def finite(values: FloatArray) -> FloatArray:
    """Return the finite entries."""
    return values[np.isfinite(values)]


def peak(values: FloatArray) -> float:
    """Return the largest finite size, 0 when there is none."""
    good = finite(values)
    return float(np.abs(good).max()) if good.size else 0.0


def signed(value: float) -> str:
    """Return a number with its sign, a true minus as in the tick labels."""
    return f"{value:+.3g}".replace("-", "−")


def impact_time(dataset: xr.Dataset) -> float:
    """Return the length of impacts after the start and each reversal [s]; the rest is smooth motion."""
    return float(dataset.attrs.get("impact_time", 0.0))


def reversal_times(dataset: xr.Dataset) -> FloatArray:
    """Return the times at which vane or drive reverse, stop or start [s], shape (n,); none without a drive.

    As the result holds it, else where the ideal vane speed changes its sign.
    """
    if "reversal_time" in dataset:
        return np.asarray(dataset["reversal_time"].values[1:], dtype=np.float64)
    if "omega_v_ideal" not in dataset:
        return np.empty(0)
    speed = series(dataset, "omega_v_ideal")
    moving = np.isfinite(speed) & (speed != 0.0)
    time, speed = series(dataset, "time")[moving], speed[moving]
    turn = np.flatnonzero(speed[1:] * speed[:-1] < 0.0)
    share = np.abs(speed[turn]) / (np.abs(speed[turn]) + np.abs(speed[turn + 1]))
    return np.asarray(time[turn] + share * (time[turn + 1] - time[turn]), dtype=np.float64)


def impact_windows(dataset: xr.Dataset) -> FloatArray:
    """Return begin and end [s] of the impacts after the start and each reversal, shape (n, 2)."""
    time, window = series(dataset, "time"), impact_time(dataset)
    begins = np.concatenate([[0.0], reversal_times(dataset)])
    windows = np.column_stack([begins, begins + window])
    return np.asarray(windows[(window > 0.0) & (windows[:, 1] > time[0]) & (windows[:, 0] < time[-1])])


def direction(dataset: xr.Dataset) -> FloatArray:
    """Return +1 while the ideal vane angle grows and -1 while it falls, shape (n_t,)."""
    return np.where(series(dataset, "omega_v_ideal") >= 0.0, 1.0, -1.0)


def smooth_limits(
    time: FloatArray, values: FloatArray, turns: FloatArray, impact_time: float
) -> tuple[float, float] | None:
    """Return an ordinate that fits the smooth motion, where impacts would flatten it; otherwise nothing.

    ``time``: times [s], shape (n_t,); ``values``: what is drawn, shape (..., n_t); ``turns``: reversal times
    [s]; ``impact_time``: how long impacts last after the start and each of them [s].
    """
    smooth = np.ones(time.shape, dtype=bool)
    for turn in (0.0, *turns):
        smooth &= ~((time >= turn) & (time <= turn + impact_time))
    quiet = peak(values[..., smooth])
    if not 0.0 < quiet < 0.5 * peak(values):
        return None
    return (-1.6 * quiet if np.nanmin(values) < 0.0 else 0.0), 1.6 * quiet
