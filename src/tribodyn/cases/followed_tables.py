"""Values beyond the ends of a table that a case follows: it repeats, or its first and last value hold."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from pydantic import BaseModel

from tribodyn.cases.columns import KNOTS, VALUES
from tribodyn.cases.keys import keys_of
from tribodyn.cases.messages import Remarks
from tribodyn.cases.units import from_si, number_in

_TURN: Final = 2.0 * math.pi
_ROUNDED: Final = 1.0e-4  #: Share of a turn by which rounded angles may miss whole turns.
_SAME: Final = 1.0e-9  #: Share of a cycle, or of the length of a table, that counts as nothing.
_DIGITS: Final = 4
_SHOWN: Final = {"times": "s", "angles": "deg", "positions": "mm", "speeds": "rad/s", "velocities": "m/s"}


def whole_turns(angles: tuple[float, ...]) -> int:
    """Return the number of whole turns that a table over angles [rad] spans; 0 where they are not whole."""
    turns = (angles[-1] - angles[0]) / _TURN if angles else 0.0
    return round(turns) if abs(turns - round(turns)) < _ROUNDED else 0


def lasts_a_cycle(times: Sequence[float], cycle: float | None) -> bool:
    """Return whether a table over time [s] begins with the run and is as long as its cycle [s]."""
    if len(times) == 0 or cycle is None:
        return False
    return max(abs(times[0]), abs(times[-1] - cycle)) <= _SAME * cycle


@dataclass(frozen=True)
class FollowedTable:
    """A table that a load, a drive or a temperature of a case follows."""

    path: str  #: Of the table in the case: ``loads.gas.force``.
    over: str  #: What it runs over, one of :data:`~tribodyn.cases.columns.KNOTS`.
    knots: tuple[float, ...]  #: Where it has values [SI].
    ends: tuple[str, ...]  #: First and last value as text; empty for a map.
    follows: str  #: Name of the coordinate that it follows, such as that of a joint; empty for time.
    period: float  #: Distance after which it repeats [SI]; 0 where its first and last value hold beyond.
    duration: float  #: Time of the run [s].

    def note(self) -> str:
        """Return that it repeats, and where it jumps."""
        first, last = (*self.ends, "", "")[:2]
        jump = f"; it jumps from {last} to {first} there" if first != last else ""
        along = f" of {self.follows}" if self.follows else ""
        return f"The table {self.path} repeats every {self._text(self.period)}{along}{jump}."

    def warning(self, time: float, *, past: bool) -> str:
        """Return that a run leaves it at a time [s], past its end or before its beginning."""
        which = "last" if past else "first"
        value = f", {self.ends[-1 if past else 0]}," if self.ends else ""
        begin, end = self._text(self.knots[0]), self._text(self.knots[-1])
        return (
            f"At t = {time:.4g} s the run leaves the table {self.path}.{self.over} ({begin} to {end}): "
            f"beyond it the {which} value{value} holds. Extend the table if that is not meant."
        )

    def left_over_time(self) -> Iterator[str]:
        """Yield remarks on a table over time that does not reach over the run."""
        if self.over != "times" or self.period:
            return
        room = _SAME * self.duration
        if self.knots[0] > room:
            yield self.warning(0.0, past=False)
        if self.knots[-1] < self.duration - room:
            yield self.warning(self.knots[-1], past=True)

    @property
    def reach(self) -> tuple[float, float]:
        """Range of the coordinate in which a table has values [SI]; everywhere if it repeats."""
        if self.period:
            return -math.inf, math.inf
        room = _SAME * (self.knots[-1] - self.knots[0])
        return self.knots[0] - room, self.knots[-1] + room

    def _text(self, value: float) -> str:
        unit = _SHOWN[self.over]
        return f"{number_in(value, unit):.{_DIGITS}g} {unit}"


def followed(
    tables: Mapping[str, Any],
    duration: float,
    *,
    cycle: float | None = None,
    follows: Mapping[str, str] | None = None,
) -> Iterator[FollowedTable]:
    """Yield the tables that parts of a case follow, two for a map.

    ``tables``: members of :mod:`tribodyn.cases.signals`, with and without values, by their paths;
    ``duration``: of the run [s]; ``cycle``: time after which a table over time of that length repeats [s];
    None where none does; ``follows``: names of the coordinates that tables over angles or positions follow,
    by the paths of the tables.
    """
    names = follows or {}
    for path, table in tables.items():
        given = {over: tuple(getattr(table, over, None) or ()) for over in KNOTS}
        axes = {over: knots for over, knots in given.items() if knots}
        ends = _ends(table) if len(axes) == 1 else ()
        for over, knots in axes.items():
            along = "" if over == "times" else names.get(path, "")
            again = knots[-1] if over == "times" and getattr(table, "cyclic", False) else cycle
            yield FollowedTable(path, over, knots, ends, along, _period(over, knots, again), duration)


def _period(over: str, knots: tuple[float, ...], cycle: float | None) -> float:
    """Return the distance after which a table repeats; 0 where it does not."""
    if over == "times":
        return cycle or 0.0 if lasts_a_cycle(knots, cycle) else 0.0
    return _TURN * whole_turns(knots) if over == "angles" else 0.0


def _ends(table: Any) -> tuple[str, str]:
    model: type[BaseModel] = type(table)
    unit, ends = keys_of(model)[VALUES].unit, (table.values[0], table.values[-1])
    first, last = (from_si(float(f"{value:.{_DIGITS}g}"), unit) for value in ends)
    return first, last


def of_tables(tables: Iterable[FollowedTable]) -> Remarks:
    """Return the tables that repeat, and those over time that a run leaves."""
    tables = tuple(tables)
    left = tuple(text for table in tables for text in table.left_over_time())
    return Remarks(left, tuple(table.note() for table in tables if table.period))
