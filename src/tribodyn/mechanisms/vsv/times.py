"""When a run keeps rows and pictures."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.vsv.case import VsvCase
from tribodyn.mechanisms.vsv.parameters import Drive, Lengths, Vsv
from tribodyn.mechanisms.vsv.problem import reversals
from tribodyn.mechanisms.vsv.reach import ideal_vane_angle

_END_SHARE: Final = 0.02
"""Share of the vane's range by which pictures near the reversals stand off their impacts."""


def output_times(case: VsvCase, vsv: Vsv, duration: float) -> FloatArray:
    """Return the times of the rows [s]: uniform, the reversals, and close together after each reversal.

    The impacts after a reversal last milliseconds; ``run.impact_interval`` resolves them for the
    length of ``run.impact_window``. ``duration`` is the time simulated in one go [s].
    """
    run = case.run
    uniform = np.append(np.arange(0.0, duration, run.output_interval), duration)
    events = [uniform]
    burst = np.arange(0.0, run.impact_window, run.impact_interval)
    for reversal in reversals(vsv, duration):
        events.append(reversal + burst)
    times = np.unique(np.concatenate(events))
    times = times[times <= duration]
    distinct = np.append(np.diff(times) > 1.0e-9 * duration, True)
    return np.asarray(times[distinct])


def snapshots(vsv: Vsv, duration: float) -> FloatArray:
    """Return the times of the pressure pictures [s]: three vane angles forward, the same in reverse.

    Near the smallest vane angle, at the angle where the air load changes sign (or the middle of the
    range), and near the largest; in the last complete cycle, or in the first where none is complete.
    """
    drive = vsv.drive
    forward = np.array(_forward(vsv.lengths, drive, vsv.air.switch_angle))
    cycle = max(math.floor(duration / drive.period + 1.0e-9) - 1, 0) * drive.period
    times = cycle + np.concatenate([forward, drive.period - forward[::-1]])
    return np.asarray(times[times <= duration])


# Asked several times by a run, and by every case of a sweep, most of which share lengths and drive.
@lru_cache(maxsize=64)
def _forward(lengths: Lengths, drive: Drive, switch: float) -> tuple[float, ...]:
    """Return the times of the pictures in the forward half of a cycle [s]; ``switch`` is in rad."""
    crank = np.linspace(drive.start_angle, drive.start_angle + drive.swing, 2001)
    vane = np.unwrap(ideal_vane_angle(lengths, crank))
    turns = np.flatnonzero(np.diff(np.sign(np.diff(vane))) != 0.0)
    if turns.size:
        # Past a dead centre the vane comes back to where it was, and out of reach it is nowhere.
        crank, vane = crank[: turns[0] + 2], vane[: turns[0] + 2]
    low, high = float(vane[0]), float(vane[-1])
    middle = switch if min(low, high) < switch < max(low, high) else 0.5 * (low + high)
    wanted = np.array([low + _END_SHARE * (high - low), middle, high - _END_SHARE * (high - low)])
    order = np.argsort(vane)
    angle = np.interp(wanted, vane[order], crank[order])
    phase = np.arccos(np.clip(1.0 - (angle - drive.start_angle) / (0.5 * drive.swing), -1.0, 1.0))
    return tuple((phase / drive.angular_frequency).tolist())
