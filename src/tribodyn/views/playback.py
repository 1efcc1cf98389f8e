"""Times at which motion is drawn, its magnification in a clearance, variables as arrays, and reversals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.results.reading import column
from tribodyn.views.encode import packed

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray


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


_EVEN: Final = 241  #: Moments of results without pressure frames of their own.
_SHORT: Final = 0.5  #: Runs shorter than this [s] are shown in milliseconds.


def time_unit(dataset: xr.Dataset) -> tuple[str, float]:
    """Return the unit in which the times of a run read well, and the factor to it from seconds."""
    time = series(dataset, "time")
    return ("ms", 1e3) if time.size and np.ptp(time) < _SHORT else ("s", 1.0)


def playback_times(dataset: xr.Dataset) -> FloatArray:
    """Return the times of the frames [s], increasing; where there are none, even times in the last cycle."""
    if "frame_time" in dataset and dataset["frame_time"].size > 1:
        return np.asarray(dataset["frame_time"].values, dtype=np.float64)
    time = series(dataset, "time")
    if time.size < 2:
        return np.empty(0)
    period = float(dataset.attrs.get("cycle_period", np.inf))
    return np.linspace(max(time[0], time[-1] - period), time[-1], _EVEN)


def in_playback(dataset: xr.Dataset) -> NDArray[np.bool_]:
    """Tell of each time of the result whether it lies in the playback, shape (n_t,)."""
    times, time = playback_times(dataset), series(dataset, "time")
    return np.asarray((time >= times[0]) & (time <= times[-1]))


def at_frames(dataset: xr.Dataset, name: str, scale: float = 1.0) -> FloatArray:
    """Return a variable at the frames, shape (n_frames,)."""
    return np.interp(playback_times(dataset), series(dataset, "time"), series(dataset, name, scale))


def clock(dataset: xr.Dataset) -> dict[str, Any] | None:
    """Return the content of the time slider; nothing where there is no playback."""
    times = playback_times(dataset)
    if times.size < 2:
        return None
    unit, scale = time_unit(dataset)
    shown: dict[str, Any] = {"time": packed(times, "float64"), "unit": unit, "scale": scale, "notes": []}
    if "theta_v" in dataset and "omega_v_ideal" in dataset:
        # A little later: at a reversal the direction is the one about to begin.
        sense = np.interp(times + 1e-3, series(dataset, "time"), direction(dataset))
        angles = at_frames(dataset, "theta_v", 180.0 / np.pi)
        shown["notes"] = [
            f"vane {angle:.1f}°, {'forward' if way >= 0.0 else 'reverse'}"
            for angle, way in zip(angles, sense, strict=True)
        ]
    return shown


#: Largest error of a straight line for the motion in a clearance, over the clearance.
LINE_ERROR: Final = 0.002
_MOST: Final = 16  #: Samples between two rows, at most.


def dense_times(time: FloatArray, values: FloatArray, rates: FloatArray, tolerance: float) -> FloatArray:
    """Return the times of the rows, and times between them where straight lines would miss the motion.

    A straight line misses a cubic by at most step × |difference of the end rates| / 8 to leading order.

    ``time``: times of the rows [s], increasing, shape (n_t,), at least two; ``values``, ``rates``: at the
    rows, shape (n_t, n), and their derivatives [1/s]; both finite; ``tolerance``: what a line may miss, in
    the unit of the values. Returns times [s], increasing.
    """
    step = np.diff(time)
    miss = np.linalg.norm(np.diff(values, axis=0) - step[:, None] * rates[:-1], axis=1)
    miss = np.maximum(miss, np.linalg.norm(np.diff(values, axis=0) - step[:, None] * rates[1:], axis=1)) / 4.0
    pieces = np.clip(np.ceil(np.sqrt(miss / tolerance)), 1, _MOST).astype(int)
    number = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    begin, length = np.repeat(time[:-1], pieces), np.repeat(step, pieces)
    return np.append(begin + length * number / np.repeat(pieces, pieces), time[-1])


_SHOWN: Final = 0.35  #: Clearance as a scene first shows it, over the radius of the shaft.


def magnification(ratio: float) -> dict[str, Any]:
    """Return the range of the magnification and where it begins: round numbers.

    ``ratio``: radius of the shaft over its clearance.
    """
    first = _SHOWN * ratio
    digit = 10.0 ** np.floor(np.log10(first))
    value = float(max(np.floor(first / digit) * digit, 1.0))
    return {"value": value, "most": 2.0 * value}
