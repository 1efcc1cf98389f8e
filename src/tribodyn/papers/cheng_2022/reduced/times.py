"""Times at which a run keeps rows and pictures."""

import math
from functools import lru_cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.problem import Following
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.shaft_loads import crossings
from tribodyn.mechanisms.workload import distinct
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.drives import ideal_motion, run_segments
from tribodyn.papers.cheng_2022.reduced.parameters import CrankMotion, Lengths, TableDrive, Vsv
from tribodyn.papers.cheng_2022.reduced.reach import ideal_vane_angle

#: Quantities whose peaks are kept where there are more steps than rows.
_WATCHED: Final = tuple(
    (OBSERVED.index(name),) for name in ("F_cx", "F_cy", "F_kx", "F_ky", "damping_power", "p_max", "M_d")
)
_STRIDE: Final = 3
#: Share of the vane's range by which pictures near the reversals stand off their impacts.
_END_SHARE: Final = 0.02


def output_times(case: VsvCase, vsv: Vsv, duration: float) -> FloatArray:
    """Return the times of the rows [s]: uniform, and where the vane turns or a table kinks.

    ``duration`` is the time simulated in one go [s].
    """
    uniform = np.append(np.arange(0.0, duration, case.run.output_interval), duration)
    return distinct(np.concatenate([uniform, run_segments(vsv, duration).breaks]), duration)


def following(case: VsvCase, vsv: Vsv, duration: float, wanted: FloatArray) -> Following | None:
    """Return the intervals in which rows follow the steps: ``run.impact_window`` after start and reversals.

    The impacts there last milliseconds, those of ``paper`` some 25 µs. Every third step shows them; a row of
    each would take a tenth of the time of a run. Those where ``wanted`` is set by the kernels are the peaks.
    """
    run = case.run
    if run.impact_window == 0.0:
        return None
    begin = np.concatenate([[0.0], run_segments(vsv, duration).turns])
    end = np.minimum(begin + run.impact_window, np.append(begin[1:], duration))
    return Following(np.column_stack([begin, end]), run.impact_rows, _WATCHED, _STRIDE, wanted)


def snapshots(vsv: Vsv, duration: float) -> FloatArray:
    """Return the times of the pressure pictures [s]: three vane angles forward, the same in reverse.

    Near the smallest vane angle, at the angle where the air load changes sign (or the middle of the
    range), and near the largest; in the last complete cycle, or in the first where none is complete.
    """
    drive = vsv.drive
    if isinstance(drive, TableDrive):
        return _in_table(vsv, drive, duration)
    forward = np.array(_forward(vsv.lengths, drive, vsv.air.switch_angle))
    cycle = max(math.floor(duration / drive.period + 1.0e-9) - 1, 0) * drive.period
    times = cycle + np.concatenate([forward, drive.period - forward[::-1]])
    return np.asarray(times[times <= duration])


def _in_table(vsv: Vsv, drive: TableDrive, duration: float) -> FloatArray:
    """Return the times of the pictures in a cycle of a table [s], the first of each angle each way."""
    motion = ideal_motion(vsv.lengths, drive, duration)
    cycle = max(math.floor(duration / drive.period + 1.0e-9) - 1, 0) * drive.period
    last = min(cycle + drive.period, duration)
    turns = drive.turns(last)
    turns = np.concatenate([[cycle], turns[turns > cycle], [last]])
    angles = motion.vane_angle(turns)
    wanted = _wanted(float(angles.min()), float(angles.max()), vsv.air.switch_angle)
    met = [np.sort(crossings(motion.vane_angle, turns, np.array([angle]))) for angle in wanted]
    times = [
        on_the_way[0]
        for sense in (1.0, -1.0)
        for times in met
        if (on_the_way := times[motion.direction(times) == sense]).size
    ]
    return np.unique(np.array(times))


def _wanted(low: float, high: float, switch: float) -> FloatArray:
    """Return the vane angles of the pictures between two ends [rad]."""
    middle = switch if min(low, high) < switch < max(low, high) else 0.5 * (low + high)
    return np.array([low + _END_SHARE * (high - low), middle, high - _END_SHARE * (high - low)])


# Asked several times by a run, and by every case of a sweep, most of which share lengths and drive.
@lru_cache(maxsize=64)
def _forward(lengths: Lengths, drive: CrankMotion, switch: float) -> tuple[float, ...]:
    """Return the times of the pictures in the forward half of a cycle [s]; ``switch`` is in rad."""
    crank = np.linspace(drive.start_angle, drive.start_angle + drive.swing, 2001)
    vane = np.unwrap(ideal_vane_angle(lengths, crank))
    turns = np.flatnonzero(np.diff(np.sign(np.diff(vane))) != 0.0)
    if turns.size:
        # Past a dead centre the vane comes back to where it was, and out of reach it is nowhere.
        crank, vane = crank[: turns[0] + 2], vane[: turns[0] + 2]
    wanted = _wanted(float(vane[0]), float(vane[-1]), switch)
    order = np.argsort(vane)
    angle = np.interp(wanted, vane[order], crank[order])
    phase = portable.acos(np.clip(1.0 - (angle - drive.start_angle) / (0.5 * drive.swing), -1.0, 1.0))
    return tuple((phase / drive.angular_frequency).tolist())
