"""Amount of work and memory of a run, and the times of its pressure frames.

Evenly over one drive cycle, and close together after each reversal, where the trunnion crosses the
clearance within milliseconds. Frames are taken in the first and in the last complete cycle; the result
keeps those of the last one that was reached, so that a run that fails early has a film too.
"""

import math
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.joint_keys import Wear


@dataclass(frozen=True)
class Keys:
    """Keys that reduce a part of the workload, as a message names them."""

    #: Of the counts of :class:`Workload` with these names; ``length`` of the simulated time.
    nodes: str = "solver.grid.theta or solver.grid.z"
    cells: str = "film.grid.theta or film.grid.z"
    length: str = "run.duration"
    samples: str = "run.output_interval"
    followed: str = "run.step_rows"
    cycles: str = "wear.cycles"


@dataclass(frozen=True)
class Workload:
    """Counts of one run; floats, since a case may ask for more than an array could hold."""

    #: Accepted steps of one run, expected from its motion; see the mechanism's own ``workload.py``.
    steps: float
    states: float  #: Number of states.
    nodes: float  #: Nodes of all contact surfaces.
    joints: float  #: Joints with clearance.
    fields: float  #: Pressure fields kept.
    samples: float  #: Samples at output times.
    followed: float  #: Samples that follow the steps.
    quantities: float  #: Numbers of a sample.
    breaks: float = 0.0  #: Times at which the integration restarts.
    #: Cells of an oil film, and how many of them its solution couples at once; none without oil.
    cells: float = 0.0
    band: float = 0.0
    mapped: float = 0.0  #: Nodes of films in each field kept.
    runs: float = 1.0  #: How often the run is made: once, or for each simulated cycle of a wear campaign.
    solver: str = "mebdf"  #: Of the case: only this one runs in compiled code, with sparse matrices.
    keys: Keys = field(default_factory=Keys)  #: What to change.


def simulated_cycles(wear: Wear, settling: int, roughness: float, radius: float, rows: int) -> float:
    """Return the number of cycles that a wear campaign simulates.

    Depth per cycle is that of a typical pressure over a slip of one radius, so this is an order of magnitude.

    ``wear``: its table of the case; ``settling``: cycles before the first one whose wear counts;
    ``roughness``: combined rms roughness σ [m]; ``radius``: of the shaft [m]; ``rows``: of temperatures that
    follow time: a jump ends at each.
    """
    if not (wear.feedback or rows):
        return settling + 2.0
    rate = wear.specific_wear_rate + wear.partner_wear_rate
    depth = wear.cycles * rate * _PRESSURE * radius
    if wear.depth_limit is not None:
        depth = min(depth, wear.depth_limit)
    jumps = _FIRST_JUMPS + depth / (_SHARE_OF_JUMP * wear.jump_depth * roughness)
    return settling + 1.0 + min(float(wear.cycles), jumps + rows)


#: Mean contact pressure over a slip of one radius per cycle [Pa], from wear campaigns of two mechanisms.
_PRESSURE = 5.0e5
_SHARE_OF_JUMP = 0.4  #: Mean gain of a jump over ``wear.jump_depth``, from the same.
_FIRST_JUMPS = 20.0  #: Jumps until their length has grown to that.


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
