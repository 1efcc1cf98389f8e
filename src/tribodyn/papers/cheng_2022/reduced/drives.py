"""The drive of a case: the sinusoid of the paper, or a crank angle, a speed or a stroke from a table."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Final

import numpy as np

from tribodyn.cases.case import demand
from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal, polyline, repeated, scaled, spline
from tribodyn.papers.cheng_2022.reduced.parameters import AnyDrive, CrankMotion, TableDrive

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
