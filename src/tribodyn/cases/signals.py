"""Numbers that follow time or a coordinate, as tables of a case: constant, sinusoidal, or through a table."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, ClassVar, Final, Literal

from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.columns import KNOTS, TABLE, VALUES, TableProblem, check
from tribodyn.cases.fields import Numbers, choice, file, name, quantity, series

if TYPE_CHECKING:
    from tribodyn.core.signals import Signal

_FORMULA: Final = ("value", "amplitude", "swing")


class _Angle(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="deg", example="30 deg")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="deg", example="20 deg")
    swing: float | None = quantity(None, "from value there and back", "", unit="deg", example="40 deg")
    values: Numbers | None = series("in the place of a CSV file", "", unit="deg", example='"0, 10, 30 deg"')


class _Speed(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="rpm", example="5000 rpm")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="rpm", example="20 rpm")
    swing: float | None = quantity(None, "from value there and back", "", unit="rpm", example="40 rpm")
    values: Numbers | None = series("in the place of a CSV file", "", unit="rpm", example='"0, 100, 300 rpm"')


class _Position(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="mm", example="30 mm")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="mm", example="20 mm")
    swing: float | None = quantity(None, "from value there and back", "", unit="mm", example="40 mm")
    values: Numbers | None = series("in the place of a CSV file", "", unit="mm", example='"0, 10, 30 mm"')


class _Velocity(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="m/s", example="1 m/s")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="m/s", example="1 m/s")
    swing: float | None = quantity(None, "from value there and back", "", unit="m/s", example="2 m/s")
    values: Numbers | None = series("in the place of a CSV file", "", unit="m/s", example='"0, 1, 3 m/s"')


class _Torque(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="N m", example="2 N m")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="N m", example="1 N m")
    swing: float | None = quantity(None, "from value there and back", "", unit="N m", example="2 N m")
    values: Numbers | None = series("in the place of a CSV file", "", unit="N m", example='"0, 1, 3 N m"')


class _Force(Group):
    value: float | None = quantity(None, "constant, or where it begins", "", unit="N", example="100 N")
    amplitude: float | None = quantity(None, "of a sinusoid about value", "", unit="N", example="20 N")
    swing: float | None = quantity(None, "from value there and back", "", unit="N", example="40 N")
    values: Numbers | None = series("in the place of a CSV file", "", unit="N", example='"0, 10, 30 N"')


class _Course(NamedGroup):
    """What all of them have beside their value."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        *itertools.product(_FORMULA, (TABLE, VALUES, *KNOTS)),
        *itertools.product((TABLE,), (VALUES, *KNOTS)),
        *itertools.combinations(KNOTS, 2),
        ("amplitude", "swing"),
    )

    angular_frequency: float | None = quantity(
        None, "of amplitude or swing", "", unit="rad/s", gt=0, example="1 rad/s"
    )
    phase: float | None = quantity(None, "of a sinusoid at the start; 0 without", "", example="90 deg")
    table: str | None = file("CSV file: time, angle or position, then values", "table.csv")
    column: str | None = name(
        None, "which of its columns, by name; the second without it", "", example="force"
    )
    times: Numbers | None = series("of values", "", unit="s", example='"0, 0.5, 1 s"')
    angles: Numbers | None = series("of values", "", unit="deg", example='"0, 90, 360 deg"')
    positions: Numbers | None = series("of values", "", unit="mm", example='"0, 10, 20 mm"')
    interpolation: Literal["cubic", "linear"] | None = choice(
        None, "between the rows of a table; cubic without", "", example="linear"
    )

    if TYPE_CHECKING:  # What the groups of quantities declare.
        value: float | None
        amplitude: float | None
        swing: float | None
        values: Numbers | None

    def model_post_init(self, context: object, /) -> None:
        """Check what involves several keys."""
        moving = self.amplitude is not None or self.swing is not None
        demand(self.value is not None or moving or bool(self.values), "value", "give a value, or a table")
        key = "swing" if self.swing is not None else "amplitude"
        demand(not moving or self.angular_frequency is not None, key, "this needs an angular_frequency")
        demand(
            bool(self.over) == bool(self.values), VALUES, f"give one of {', '.join(KNOTS)} with the values"
        )
        try:
            check(self.knots, self.values or self.knots)
        except TableProblem as problem:
            demand(not self.values, VALUES, str(problem))

    @property
    def over(self) -> str:
        """Which of :data:`~tribodyn.cases.columns.KNOTS` a table runs over; empty without one."""
        return next((name for name in KNOTS if getattr(self, name)), "")

    @property
    def knots(self) -> Numbers:
        """Where a table has values, SI units."""
        return tuple(getattr(self, self.over)) if self.over else ()

    @property
    def period(self) -> float | None:
        """Time after which a sinusoid comes again [s]; None for what has none."""
        return None if self.angular_frequency is None else 2.0 * math.pi / self.angular_frequency

    def signal(self) -> Signal:
        """Return what kernels are given."""
        # Imported here: reading a case needs no NumPy.
        from tribodyn.core.signals import constant, sinusoid, spline

        mean, phase, frequency = self.value or 0.0, self.phase or 0.0, self.angular_frequency or 0.0
        if self.values:
            return spline(*self._rows())
        if self.swing is not None:
            half = 0.5 * self.swing
            return sinusoid(mean + half, -half, frequency, phase + 0.5 * math.pi)
        if self.amplitude is not None:
            return sinusoid(mean, self.amplitude, frequency, phase)
        return constant(mean)

    def _rows(self) -> tuple[Numbers, Numbers]:
        """Return knots and values; of straight lines each stands there twice but for the ends."""
        values = self.values or ()
        if self.interpolation != "linear":
            return self.knots, values
        rows = sorted(set(zip(self.knots, values, strict=True)))
        doubled = [rows[0], *(row for row in rows[1:-1] for _ in range(2)), rows[-1]]
        return tuple(row[0] for row in doubled), tuple(row[1] for row in doubled)


class AngleSignal(_Course, _Angle):
    """An angle: constant, sinusoidal, or from a table."""


class SpeedSignal(_Course, _Speed):
    """An angular speed: constant, sinusoidal, or from a table."""


class PositionSignal(_Course, _Position):
    """A position: constant, sinusoidal, or from a table."""


class VelocitySignal(_Course, _Velocity):
    """A velocity: constant, sinusoidal, or from a table."""


class TorqueSignal(_Course, _Torque):
    """A torque: constant, sinusoidal, or from a table."""


class ForceSignal(_Course, _Force):
    """A force: constant, sinusoidal, or from a table."""
