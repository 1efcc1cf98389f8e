"""Instants at which an integration restarts: reversals of the vane and kinks of tables."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal
from tribodyn.core.splines import Cubics
from tribodyn.kernels.vsv.data import CRANK_ANGLE, TIME, VANE
from tribodyn.mechanisms.shaft_loads import Term, crossings, inside, kinks_over, segments_of
from tribodyn.papers.cheng_2022.reduced.parameters import AnyDrive, Lengths, Vsv
from tribodyn.papers.cheng_2022.reduced.reach import dead_centres, ideal_table

CLEARANCE_ROOM: Final = 0.01  #: Largest change of θ_v by clearance, generously [rad].


@dataclass(frozen=True)
class RunSegments:
    """Events of a run."""

    #: Times strictly inside the run at which the ideal vane reverses, stops or starts [s], shape (n_turns,).
    turns: FloatArray
    breaks: FloatArray  #: These, and where something kinks [s], shape (n,).
    segments: Any  #: What holds between, as kernels read it, shape (n + 1,).


@dataclass(frozen=True)
class IdealMotion:
    """The ideal mechanism over time."""

    drive: AnyDrive  #: Motion of the crank.
    curve: Cubics  #: θ_v over θ_a [rad].

    def vane_angle(self, times: FloatArray) -> FloatArray:
        """Return θ_v [rad] at times [s]."""
        return self.curve(self.drive.angle(times))

    def direction(self, times: FloatArray) -> FloatArray:
        """Return the direction of the vane's motion, 1, -1, or 0 at rest."""
        return np.asarray(
            np.sign(self.drive.speed(times)) * np.sign(self.curve.derivative(self.drive.angle(times)))
        )


def ideal_motion(lengths: Lengths, drive: AnyDrive, duration: float) -> IdealMotion:
    """Return the ideal mechanism over a run of ``duration`` [s]."""
    first, inverse_step, table = ideal_table(lengths, *drive.crank_range(duration))
    angles = first + np.arange(len(table)) / inverse_step
    return IdealMotion(drive, Cubics(angles, table[:, 0], inverse_step * table[:, 1]))


def ideal_range(lengths: Lengths, drive: AnyDrive, duration: float) -> tuple[float, float]:
    """Return the least and the largest θ_v of a run of ``duration`` [s], with room for clearance [rad]."""
    motion = ideal_motion(lengths, drive, duration)
    angles = motion.curve(motion.curve.x)
    return float(angles.min()) - CLEARANCE_ROOM, float(angles.max()) + CLEARANCE_ROOM


def run_segments(vsv: Vsv, duration: float) -> RunSegments:
    """Return the events of a run of ``duration`` [s]; of one without end, in its first drive cycle."""
    duration = duration if math.isfinite(duration) else vsv.drive.period
    return _run_segments(vsv.lengths, vsv.drive, vsv.terms, vsv.opening, duration)


# Asked eight times by a run.
@lru_cache(maxsize=4)
def _run_segments(
    lengths: Lengths, drive: AnyDrive, terms: tuple[Term, ...], opening: Signal | None, duration: float
) -> RunSegments:
    centres = np.array(dead_centres(lengths, *drive.crank_range(duration)))
    reversals = inside(np.concatenate([drive.turns(duration), drive.passes(centres, duration)]), duration)
    motion = ideal_motion(lengths, drive, duration)
    ends = np.concatenate([[0.0], reversals, [duration]])
    of_time = kinks_over(terms, TIME, ends)
    of_vane = kinks_over(terms, VANE, motion.vane_angle(ends))
    of_crank = kinks_over(terms, CRANK_ANGLE, drive.angle(ends))
    if opening is not None:
        of_time = np.union1d(of_time, opening.kinks)
    met = (crossings(motion.vane_angle, ends, of_vane), crossings(drive.angle, ends, of_crank))
    breaks = inside(np.concatenate([reversals, of_time, *met]), duration)
    ends = np.concatenate([[0.0], breaks, [duration]])
    middles = 0.5 * (ends[:-1] + ends[1:])
    directions = motion.direction(middles)
    if drive.signal is not None:
        of_time = np.union1d(of_time, drive.signal.kinks)
    others = [(motion.vane_angle(middles), of_vane), (drive.angle(middles), of_crank)]
    segments = segments_of(breaks, directions, of_time, others)
    return RunSegments(breaks[np.diff(directions) != 0.0], breaks, segments)
