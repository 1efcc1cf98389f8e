"""The drive of a case, and the instants at which an integration restarts."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import demand
from tribodyn.core.signals import Signal, polyline, repeated, scaled, spline
from tribodyn.core.splines import Cubics
from tribodyn.kernels.vsv.data import CRANK_ANGLE, TIME, VANE
from tribodyn.mechanisms.shaft_loads import Term, crossings, inside, kinks_over, segments_of
from tribodyn.papers.cheng_2022.reduced.parameters import AnyDrive, CrankMotion, Lengths, TableDrive, Vsv
from tribodyn.papers.cheng_2022.reduced.reach import dead_centres, ideal_table

if TYPE_CHECKING:
    from tribodyn.cases.signals import AngleTable, PositionTable, SpeedTable
    from tribodyn.papers.cheng_2022.reduced.actions import CrankKeys

#: Of a table's largest angle or speed: what end and beginning may differ by where it is repeated.
_CLOSED: Final = 1.0e-6
_MOST_PIECES: Final = 1_000_000


def drive_of(keys: CrankKeys, duration: float, *, again: bool) -> AnyDrive:
    """Return the motion of the crank.

    ``keys``: its table of a case; ``duration``: of the run [s]; ``again``: whether its cycle comes again,
    however long the run is. Raises InputError if a table does not hold as much as the run needs, or jumps.
    """
    if keys.table is None:
        return CrankMotion(keys.start_angle, keys.speed_amplitude, keys.angular_frequency)
    name, table = keys.table
    demand(table.knots[0] == 0.0, f"drive.{name}", f"the table begins at {table.knots[0]:g} s, a run at 0 s")
    once = _angle(keys, name, table)
    period = float(once.knots[-1])
    n = max(1, math.ceil(duration / period * (1.0 - 1.0e-12)))
    demand(bool(once.coefficients[:-1].any()), f"drive.{name}", "the crank must move")
    demand((n == 1 and not again) or _closes(once), f"drive.{name}", _ends(period, duration))
    words = f"{n} times {once.knots.size} rows are too many; give a shorter run or fewer rows"
    demand(n * once.knots.size <= _MOST_PIECES, f"drive.{name}", words)
    return TableDrive(repeated(once, n), period)


def _angle(keys: CrankKeys, name: str, table: AngleTable | SpeedTable | PositionTable) -> Signal:
    """Return the crank angle over one length of the table [rad, s]."""
    if name == "speed":
        return _integrated(table.curve(closed=True), keys.start_angle)
    linear = table.interpolation == "linear"
    _check_smooth(table, f"drive.{name}", linear=linear)
    through = partial(polyline, corner=keys.corner_time) if linear else partial(spline, closed=True)
    values = table.values or ()
    curve = table.curve() if table.interpolation == "smooth" else through(table.knots, values)
    if name == "angle":
        return curve
    arm = keys.actuator_arm
    demand(arm is not None, "drive.actuator_arm", "a stroke needs the arm over which it turns the crank")
    turned = scaled(curve, 1.0 / (arm or 1.0))
    return replace(turned, coefficients=_raised(turned.coefficients, keys.start_angle))


def _check_smooth(table: AngleTable | SpeedTable | PositionTable, key: str, *, linear: bool) -> None:
    """Refuse an angle that kinks: no crank changes its speed at once."""
    twice = [a for a, b in zip(table.knots, table.knots[1:], strict=False) if a == b]
    at = f"the row at {[*twice, 0.0][0]:g} s stands there twice, but no crank changes its speed at once"
    words = "give it once; corners are rounded over drive.corner_time"
    if not linear:
        words = 'give it once, with interpolation = "linear" for ramps, or give the speed'
    demand(not twice, key, f"{at}: {words}")


def _raised(coefficients: FloatArray, by: float) -> FloatArray:
    """Return the coefficients of a polynomial plus a constant."""
    raised = coefficients.copy()
    raised[-1] += by
    return raised


def _integrated(speed: Signal, start: float) -> Signal:
    """Return the angle that a speed makes from a start on."""
    from scipy.interpolate import PPoly

    angle = PPoly(speed.coefficients, speed.knots).antiderivative()
    return replace(speed, coefficients=_raised(angle.c, start), knots=angle.x)


def _closes(angle: Signal) -> bool:
    """Tell whether a table may be repeated: it ends as it begins."""
    from scipy.interpolate import PPoly

    curve = PPoly(angle.coefficients, angle.knots)
    ends = angle.knots[[0, -1]]
    for order in (0, 1):
        values = curve.derivative(order)(angle.knots)
        first, last = curve.derivative(order)(ends)
        if abs(last - first) > _CLOSED * max(float(np.ptp(values)), 1.0e-12):
            return False
    return True


def _ends(period: float, duration: float) -> str:
    longer = f"the table holds {period:g} s, the run takes {duration:g} s: it"
    repeated = longer if duration > period * (1.0 + _CLOSED) else "the table of a wear campaign"
    return (
        f"{repeated} is repeated, which can be only where angle and speed of the crank at its end are those "
        "at its beginning"
    )


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
