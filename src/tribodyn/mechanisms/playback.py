"""Times of pressure frames: the pictures of which the report makes its animation.

Evenly over one drive cycle, and close together after each reversal, where the trunnion crosses the
clearance within milliseconds. Frames are taken in the first and in the last complete cycle; the result
keeps those of the last one that was reached, so that a run that fails early has a film too.
"""

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

EVEN: Final = 120  #: Frames in a cycle, without those after reversals.
AFTER_REVERSAL: Final = 48  #: Frames after each reversal, fewer where there are many.
MOST_CLOSE: Final = 960  #: Of all such frames of a cycle.
_SAME: Final = 1.0e-9  #: Times closer than this share of the run are the same time.


def frame_times(
    duration: float, period: float, reversals: FloatArray, window: float, even: int = EVEN
) -> FloatArray:
    """Return the times of all frames [s], increasing, shape (n_frames,).

    ``duration``: simulated time [s]; ``period``: time of one drive cycle [s]; ``reversals``: times at which
    the motion turns around [s]; ``window``: how long after a reversal frames are close together [s];
    ``even``: frames in a cycle, without those after reversals.
    """
    cycles = {first_frame(duration, period), 0.0}
    parts = [_of_cycle(start, min(period, duration), reversals, window, even) for start in sorted(cycles)]
    return distinct(np.concatenate(parts), duration)


def first_frame(duration: float, period: float) -> float:
    """Return the beginning of the last complete cycle [s]; 0 where none is complete."""
    return max(math.floor(duration / period + _SAME) - 1, 0) * period


def shown(times: FloatArray, duration: float, period: float) -> slice:
    """Return the frames of the film among those that were reached: one cycle, the last one if it was begun.

    ``times``: times of the frames reached [s], increasing; ``duration``, ``period``: as for
    :func:`frame_times`.
    """
    last = first_frame(duration, period) - _SAME * duration
    begin = int(np.searchsorted(times, last))
    # One frame alone is no film: a run that fails as its last cycle begins shows the first.
    if times.size - begin > 1:
        return slice(begin, times.size)
    return slice(0, int(np.searchsorted(times, period + _SAME * duration)))


def merged(snapshots: FloatArray, frames: FloatArray, duration: float) -> FloatArray:
    """Return the times of snapshots and frames together [s], increasing, shape (n,); snapshots win."""
    near = np.abs(frames[:, None] - snapshots[None, :]).min(axis=1, initial=math.inf) <= _SAME * duration
    return np.sort(np.concatenate([snapshots, frames[~near]]))


def distinct(times: FloatArray, duration: float) -> FloatArray:
    """Return the times inside the run [s], sorted, each once."""
    ordered = np.sort(times[times <= duration])
    apart = np.append(np.diff(ordered) > _SAME * duration, True)
    return np.asarray(ordered[apart], dtype=np.float64)


def _of_cycle(start: float, length: float, reversals: FloatArray, window: float, even: int) -> FloatArray:
    """Return the times of the frames of one cycle [s]."""
    turns = np.concatenate([[start], reversals])
    within = turns[(turns >= start) & (turns < start + length)]
    each = max(1, min(AFTER_REVERSAL, MOST_CLOSE // max(within.size, 1)))
    burst = window * np.arange(1, each + 1) / each
    close = (within[:, None] + burst).ravel() if window > 0.0 else np.empty(0)
    return np.concatenate([start + length * np.linspace(0.0, 1.0, even + 1), close[close < start + length]])
