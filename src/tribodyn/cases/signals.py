"""Numbers that follow time or a coordinate, as tables of a case: constant, sinusoidal, or through a table.

One file because signals, tables and maps of all quantities share their keys and checks.
"""

from __future__ import annotations

import itertools
import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, Final, Literal

from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.columns import KNOTS, MAP, TABLE, TIMES, VALUES, TableProblem, check, check_map
from tribodyn.cases.fields import Numbers, choice, file, name, number, quantity, series, switch
from tribodyn.cases.followed_tables import whole_turns
from tribodyn.cases.units import unit_of

if TYPE_CHECKING:
    from mebdf.arrays import FloatArray
    from tribodyn.core.signals import Signal

_FORMULA: Final = ("value", "amplitude", "swing")
_PULSE: Final = "pulse"
_FEWEST_SMOOTH: Final = 5
_KEPT: Final = 8  #: Curves through tables that are kept.
_ROUNDING: Final = 1.0e-14
_TINY: Final = 1.0e-300
_TURN: Final = 2.0 * math.pi * (1.0 - 1.0e-9)


def _value(example: str) -> Any:
    return quantity(None, "constant, or where it begins", example=example)


def _amplitude(example: str) -> Any:
    return quantity(None, "of a sinusoid about value", example=example)


def _swing(example: str) -> Any:
    return quantity(None, "from value there and back", example=example)


def _pulse(example: str) -> Any:
    return quantity(None, "largest value of one squared sine above value", example=example)


def _values(example: str) -> Any:
    unit = unit_of(example.rpartition(", ")[2])
    return series("in the place of a CSV file", unit=unit, example=f'"{example}"')


class _Angle(Group):
    value: float | None = _value("30 deg")
    amplitude: float | None = _amplitude("20 deg")
    swing: float | None = _swing("40 deg")
    values: Numbers | None = _values("0, 10, 30 deg")


class _Speed(Group):
    value: float | None = _value("5000 rpm")
    amplitude: float | None = _amplitude("20 rpm")
    swing: float | None = _swing("40 rpm")
    values: Numbers | None = _values("0, 100, 300 rpm")


class _Position(Group):
    value: float | None = _value("30 mm")
    amplitude: float | None = _amplitude("20 mm")
    swing: float | None = _swing("40 mm")
    values: Numbers | None = _values("0, 10, 30 mm")


class _Velocity(Group):
    value: float | None = _value("1 m/s")
    amplitude: float | None = _amplitude("1 m/s")
    swing: float | None = _swing("2 m/s")
    values: Numbers | None = _values("0, 1, 3 m/s")


class _Torque(Group):
    value: float | None = _value("2 N m")
    amplitude: float | None = _amplitude("1 N m")
    swing: float | None = _swing("2 N m")
    values: Numbers | None = _values("0, 1, 3 N m")


class _Force(Group):
    value: float | None = _value("100 N")
    amplitude: float | None = _amplitude("20 N")
    swing: float | None = _swing("40 N")
    values: Numbers | None = _values("0, 10, 30 N")


class _TableRows(NamedGroup):
    """Keys of all tables beside their values and knots."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = tuple(itertools.product((TABLE,), (VALUES, *KNOTS)))

    table: str | None = file("CSV file: time, angle or position, then values", "table.csv")
    column: str | None = name(None, "which of its columns, by name; the second without it", example="force")
    interpolation: Literal["cubic", "linear", "smooth"] | None = choice(
        None, "between the rows of a table, or near those of a noisy one; cubic without", example="linear"
    )

    if TYPE_CHECKING:  # What the groups of quantities declare.
        values: Numbers | None

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        self._check_given()
        try:
            self._check_rows()
        except TableProblem as problem:
            demand(not self.values, VALUES, str(problem))

    def _check_given(self) -> None:
        demand(bool(self.values), TABLE, "give a table, or its values")
        self._check_over()

    def _check_over(self) -> None:
        there = ", ".join(name for name in KNOTS if name in type(self).model_fields)
        demand(bool(self.over) == bool(self.values), VALUES, f"give one of {there} with the values")

    def _check_rows(self) -> None:
        check(self.knots, self.values or self.knots)
        if self.interpolation == "smooth" and len(set(self.knots)) < max(len(self.knots), _FEWEST_SMOOTH):
            raise TableProblem(f"a smooth curve needs {_FEWEST_SMOOTH} rows, none of them twice")

    @property
    def axes(self) -> dict[str, Numbers]:
        """Knots of a table or a map by name, in the order of :data:`~tribodyn.cases.columns.KNOTS`."""
        return {name: tuple(found) for name in KNOTS if (found := getattr(self, name, None))}

    @property
    def over(self) -> str:
        """Members of :data:`~tribodyn.cases.columns.KNOTS` that a table runs over; empty without one."""
        return next(iter(self.axes), "")

    @property
    def knots(self) -> Numbers:
        """Knots of a table, SI units."""
        return tuple(getattr(self, self.over)) if self.over else ()

    def curve(self, *, closed: bool = False) -> Signal:
        """Return the curve through the rows; ``closed`` as for :func:`tribodyn.core.signals.spline`."""
        return _curve(*self._rows(), self.interpolation == "smooth", closed)

    def _rows(self) -> tuple[Numbers, Numbers]:
        """Return knots and values; of straight lines each stands there twice but for the ends."""
        values = self.values or ()
        if self.interpolation != "linear":
            return self.knots, values
        rows = sorted(set(zip(self.knots, values, strict=True)))
        doubled = [rows[0], *(row for row in rows[1:-1] for _ in range(2)), rows[-1]]
        return tuple(row[0] for row in doubled), tuple(row[1] for row in doubled)


@lru_cache(_KEPT)
def _curve(knots: Numbers, values: Numbers, smooth: bool, closed: bool) -> Signal:
    """Return the curve through rows; many loads of a mechanism, and all cases of a sweep, have the same."""
    # Imported here: reading a case needs no NumPy.
    from tribodyn.core.signals import smoothed, spline

    return smoothed(knots, values) if smooth else spline(knots, values, closed=closed)


class _Timed(_TableRows):
    """A table over time."""

    times: Numbers | None = series("times of the values", unit="s", example='"0, 0.5, 1 s"')


class AngleTable(_Timed):
    """An angle over time."""

    values: Numbers | None = _values("0, 10, 30 deg")


class SpeedTable(_Timed):
    """An angular speed over time."""

    values: Numbers | None = _values("0, 10, 10, 0 deg/s")


class PositionTable(_Timed):
    """A position over time."""

    values: Numbers | None = _values("0, 10, 30 mm")


class TemperatureTable(_Timed):
    """A temperature over time."""

    values: Numbers | None = _values("20, 200, 300 degC")


class ProfileTable(_TableRows):
    """A deviation of a radius over a position."""

    positions: Numbers | None = series("positions of the values", unit="mm", example='"-10, 0, 10 mm"')
    values: Numbers | None = _values("0, 3, 0 um")


class BoreMap(NamedGroup):
    """A deviation of a radius over angle and position."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = tuple(
        itertools.product((MAP,), (VALUES, "angles", "positions"))
    )

    map: str | None = file("CSV file: an angle down, positions across; or the other way round", "bore.csv")
    angles: Numbers | None = series("angles of the values", unit="deg", example='"0, 90, 180, 270 deg"')
    positions: Numbers | None = series("positions of the values", unit="mm", example='"-10, 10 mm"')
    values: Numbers | None = _values("0, 3, 0 um")

    def model_post_init(self, context: object, /) -> None:
        """Check that it is a map of the whole bore."""
        angles, positions, values = self.angles or (), self.positions or (), self.values or ()
        demand(bool(values), MAP, "give a map, or angles, positions and values")
        try:
            check_map({"angles": angles, "positions": positions}, values)
        except TableProblem as problem:
            demand(False, VALUES, str(problem))
        words = "they go once around: four at least, the last less than a turn after the first"
        demand(len(angles) > 3 and angles[-1] - angles[0] < _TURN, "angles", words)


class LineLoadTable(_TableRows):
    """A load per length over a position."""

    positions: Numbers | None = series("positions of the values", unit="mm", example='"0, 10, 20 mm"')
    values: Numbers | None = _values("100, 200, 150 N/m")


class _Signal(_Timed):
    """Keys of all signals beside their value."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        *itertools.product(_FORMULA, (TABLE, VALUES, *KNOTS)),
        *itertools.product((TABLE,), (VALUES, *KNOTS)),
        *itertools.combinations(KNOTS, 2),
        ("amplitude", "swing"),
    )

    angular_frequency: float | None = quantity(
        None, "of amplitude or swing", unit="rad/s", gt=0, example="1 rad/s"
    )
    phase: float | None = quantity(None, "of a sinusoid at the start; 0 without", example="90 deg")
    cyclic: bool | None = switch(None, "whether a table over time is repeated", example="true")
    angles: Numbers | None = series("angles of the values", unit="deg", example='"0, 90, 360 deg"')
    positions: Numbers | None = series("positions of the values", unit="mm", example='"0, 10, 20 mm"')
    speeds: Numbers | None = series("speeds of the values", unit="rad/s", example='"0, 10, 20 rad/s"')
    velocities: Numbers | None = series("velocities of the values", unit="m/s", example='"0, 1, 2 m/s"')

    if TYPE_CHECKING:  # What the groups of quantities declare.
        value: float | None
        amplitude: float | None
        swing: float | None

    def _check_given(self) -> None:
        moving = self.amplitude is not None or self.swing is not None
        demand(self.value is not None or moving or bool(self.values), "value", "give a value, or a table")
        timed = self.over == TIMES and not self.knots[0]
        demand(timed or not self.cyclic, "cyclic", "a cyclic table is one over times that begin at 0 s")
        key = "swing" if self.swing is not None else "amplitude"
        demand(not moving or self.frequency is not None, key, "this needs an angular_frequency")
        self._check_over()

    @property
    def frequency(self) -> float | None:
        """Angular frequency of a sinusoid [rad/s]; None where none is given."""
        return self.angular_frequency

    @property
    def period(self) -> float | None:
        """Time after which a sinusoid or a cyclic table comes again [s]; None for what has none."""
        if self.cyclic:
            return self.knots[-1]
        return None if self.frequency is None else 2.0 * math.pi / self.frequency

    @property
    def turns(self) -> int:
        """Whole turns after which a table over angles repeats; 0 where it does not."""
        return whole_turns(tuple(self.angles or ()))

    def signal(self) -> Signal:
        """Return the data of the kernels."""
        from tribodyn.core.signals import constant, sinusoid, turning

        mean, phase, frequency = self.value or 0.0, self.phase or 0.0, self.frequency or 0.0
        if self.values:
            return turning(self.curve(closed=self.turns > 0 or bool(self.cyclic)), self.turns)
        if self.swing is not None:
            half = 0.5 * self.swing
            return sinusoid(mean + half, -half, frequency, phase + 0.5 * math.pi)
        if self.amplitude is not None:
            return sinusoid(mean, self.amplitude, frequency, phase)
        return constant(mean)

    def over_run(self, duration: float, *, rising: bool = False) -> Signal:
        """Return it over a run [s]; a cyclic table that is ``rising`` continues from where it ends."""
        from tribodyn.core.signals import for_each_cycle

        if not self.cyclic:
            return self.signal()
        values = self.values or (0.0,)
        rise = values[-1] - values[0] if rising else 0.0
        return for_each_cycle(self.signal(), self.knots[-1], duration, rise)


#: Quantities over which a map may be given: time and another one, or a coordinate and its rate.
_MAPPED: Final = (
    *((TIMES, other) for other in KNOTS if other != TIMES),
    ("angles", "speeds"),
    ("positions", "velocities"),
)


class _Mapped(_Signal):
    """A signal of a load: also a pulse, or a map over two quantities."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        *itertools.product((*_FORMULA, _PULSE, TABLE), (MAP,)),
        *itertools.product((MAP,), (VALUES, *KNOTS)),
        *itertools.product((*_FORMULA, _PULSE), (TABLE, VALUES, *KNOTS)),
        *itertools.product((_PULSE,), ("amplitude", "swing")),
        *itertools.product(("angular_frequency",), ("order", "shaft_speed")),
        *itertools.product((TABLE,), (VALUES, *KNOTS)),
        *(pair for pair in itertools.combinations(KNOTS, 2) if pair not in _MAPPED),
        ("amplitude", "swing"),
    )

    map: str | None = file("CSV file: time down, an angle across; or the other way round", "map.csv")
    order: float | None = number(
        None,
        "waves in a turn of a shaft, such as its number of blades: frequency of amplitude or swing",
        gt=0,
        example="36",
    )
    shaft_speed: float | None = quantity(None, "of that shaft", gt=0, example="12000 rpm")
    begin: float | None = quantity(None, "of a pulse; 0 s without", ge=0, example="20 ms")
    length: float | None = quantity(None, "of a pulse", gt=0, example="50 ms")

    if TYPE_CHECKING:  # What the groups of quantities declare.
        pulse: float | None

    def _check_given(self) -> None:
        both = (self.order is None) == (self.shaft_speed is None)
        demand(both, "order", "order and shaft_speed go together")
        demand((self.pulse is None) == (self.length is None), _PULSE, "a pulse needs its length")
        demand(self.begin is None or self.pulse is not None, "begin", "only a pulse has a begin")
        if self.pulse is None:
            super()._check_given()

    @property
    def frequency(self) -> float | None:
        """Angular frequency of a sinusoid [rad/s]; None where none is given."""
        if self.order is not None and self.shaft_speed is not None:
            return self.order * self.shaft_speed
        return super().frequency

    def signal(self) -> Signal:
        """Return the data of the kernels."""
        from tribodyn.core.signals import pulse

        if self.pulse is None or self.length is None:
            return super().signal()
        return pulse(self.begin or 0.0, self.length, self.pulse, self.value or 0.0)

    @property
    def is_map(self) -> bool:
        """Whether its values stand over two quantities."""
        return len(self.axes) == 2

    def _check_rows(self) -> None:
        if self.is_map:
            check_map(self.axes, self.values or ())
        else:
            super()._check_rows()

    def products(self) -> list[tuple[tuple[Signal, str], ...]]:
        """Return signals over one of :data:`~tribodyn.cases.columns.KNOTS` each, whose products add up to it.

        Of a map they are those of its singular vectors: the bicubic spline through it, as few as it takes.
        """
        if not self.is_map:
            return [((self.signal(), self.over or TIMES),)]
        import numpy as np

        (first, rows), (second, columns) = self.axes.items()
        down, sizes, across = np.linalg.svd(np.reshape(self.values or (), (len(rows), len(columns))))
        return [
            ((self._along(first, size * column), first), (self._along(second, row), second))
            for size, column, row in zip(sizes, down.T, across, strict=False)
            if size > _ROUNDING * max(sizes[0], _TINY)
        ]

    def _along(self, over: str, values: FloatArray) -> Signal:
        """Return the curve of a singular vector over one of the two quantities."""
        from tribodyn.core.signals import spline, turning

        turns = self.turns if over == "angles" else 0
        return turning(spline(self.axes[over], values, closed=turns > 0), turns)


class AngleSignal(_Signal, _Angle):
    """An angle: constant, sinusoidal, or from a table."""


class SpeedSignal(_Signal, _Speed):
    """An angular speed: constant, sinusoidal, or from a table."""


class PositionSignal(_Signal, _Position):
    """A position: constant, sinusoidal, or from a table."""


class VelocitySignal(_Signal, _Velocity):
    """A velocity: constant, sinusoidal, or from a table."""


class TorqueSignal(_Signal, _Torque):
    """A torque: constant, sinusoidal, or from a table."""


class ForceSignal(_Signal, _Force):
    """A force: constant, sinusoidal, or from a table."""


class TorqueMap(_Mapped, _Torque):
    """A torque: constant, sinusoidal, a pulse, from a table, or from a map."""

    pulse: float | None = _pulse("1 N m")


class ForceMap(_Mapped, _Force):
    """A force: constant, sinusoidal, a pulse, from a table, or from a map."""

    pulse: float | None = _pulse("20 N")
