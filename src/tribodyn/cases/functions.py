"""Drives and loads given as Python functions: tabulated, so that a case holds their numbers."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Protocol, TypeVar, runtime_checkable

from tribodyn.cases.case import Case, with_entries
from tribodyn.cases.columns import KNOTS, VALUES
from tribodyn.core.errors import InputError

OwnFunction = Callable[..., Any]
"""Takes arrays of times [s] or angles [rad] by their names and returns as many values, SI units."""

_FIRST: Final = 33
_MOST: Final = {1: 4097, 2: 193}
"""Rows of the first trial, and at most over each of one or two arguments."""
_CLOSE: Final = {1: 1.0e-6, 2: 1.0e-5}
"""Of the largest value: what the curve or surface may miss half way between rows."""


@dataclass(frozen=True)
class Doors:
    """Keys of a kind of case that take functions.

    Attributes
    ----------
    drive
        Table that a drive fills, such as ``drive.angle``, and its unit; None where there is not just one.
    loads
        Tables that loads fill, by the names of loads, and their units.
    overridden
        Keys that a load of that name takes the place of, with their value then.
    arguments
        Names that arguments may have, with the key of what they stand for and its range in a case [s, rad].
    beside
        Keys of the table of the load that go with an argument.
    around
        Arguments that are angles over one turn, after which a function repeats.
    """

    drive: tuple[str, str] | None
    loads: Mapping[str, tuple[str, str]]
    overridden: Mapping[str, tuple[str, str]]
    arguments: Mapping[str, tuple[str, tuple[float, float]]]
    beside: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    around: tuple[str, ...] = ()


@runtime_checkable
class Controlled(Protocol):
    """A case that takes functions in the place of controllers."""

    def with_controllers(self, functions: Mapping[str, OwnFunction]) -> Case:
        """Return the case with functions by the names of controllers; refuse those that do not fit."""


_Any = TypeVar("_Any", bound=Case)


def with_functions(case: _Any, drive: OwnFunction | None, loads: Mapping[str, OwnFunction] | None) -> _Any:
    """Return a case with tables of functions for its drive and loads.

    Parameters
    ----------
    case
        The case.
    drive
        Crank angle [rad], or speed of a shaft [rad/s], as a function of ``t`` [s].
    loads
        Forces [N] and moments [N m] by name, as functions of ``t`` or an angle, or of both.

    Raises
    ------
    InputError
        A function takes or returns something else, or is not smooth.
    """
    if drive is None and not loads:
        return case
    if not hasattr(case, "doors"):
        key = "loads" if drive is None else "drive"
        raise InputError(f'a case of the kind "{case.kind()}" takes no functions', key=key)
    doors: Doors = case.doors()
    if drive is not None:
        if doors.drive is None:
            raise InputError("a function can be the drive of a case with one drive alone", key="drive")
        if _arguments(drive, doors, "drive") != ["t"]:
            raise InputError("a drive is a function of the time t", key="drive")
        case = with_entries(case, _table(doors.drive, drive, ["t"], doors, "drive"), "function")
        doors = case.doors()
    values: dict[str, object] = {}
    for name, function in (loads or {}).items():
        if name not in doors.loads:
            raise InputError(f"there is no load {name!r}; allowed: {', '.join(doors.loads)}", key="loads")
        key = f"loads.{name}"
        arguments = _arguments(function, doors, key)
        values |= _table(doors.loads[name], function, arguments, doors, key)
        values |= dict([doors.overridden[name]]) if name in doors.overridden else {}
        table = doors.loads[name][0].rpartition(".")[0]
        values |= {f"{table}.{key}": text for a in arguments for key, text in doors.beside.get(a, {}).items()}
    return with_entries(case, values, "function")


def _arguments(function: OwnFunction, doors: Doors, key: str) -> list[str]:
    """Return the names of the arguments of a function."""
    if not callable(function):
        raise InputError(f"given {type(function).__name__}; a function is needed", key=key)
    try:
        found = list(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        found = []
    of = {doors.arguments[name][0] for name in found if name in doors.arguments}
    if not 0 < len(found) == len(of) <= 2:
        allowed = ", ".join(doors.arguments)
        raise InputError(f"its arguments are {', '.join(found)}; allowed are {allowed}", key=key)
    return found


def _table(
    table: tuple[str, str], function: OwnFunction, arguments: Sequence[str], doors: Doors, key: str
) -> dict[str, object]:
    """Return the keys of a table with the values of a function."""
    import numpy as np

    # Times go down a map.
    ordered = sorted(arguments, key=lambda name: list(KNOTS).index(doors.arguments[name][0]))
    most, n = _MOST[len(ordered)], _FIRST
    while True:
        places = [np.linspace(*doors.arguments[name][1], n) for name in ordered]
        values = _called(function, arguments, ordered, places, key)
        missed = _missed(function, arguments, ordered, places, values, key)
        if missed <= _CLOSE[len(ordered)]:
            _check_turns(ordered, values, doors, key)
            break
        if 2 * n - 1 > most:
            raise InputError(
                f"{n} rows miss it by {missed:.1e} of its largest value: a smoother function is needed, or a "
                "table with a row twice where it kinks",
                key=key,
            )
        n = 2 * n - 1
    knots = {doors.arguments[name][0]: of for name, of in zip(ordered, places, strict=True)}
    path, unit = table
    written = {f"{path}.{name}": _written(of, KNOTS[name]) for name, of in knots.items()}
    return {**written, f"{path}.{VALUES}": _written(values.ravel(), unit)}


def _check_turns(ordered: Sequence[str], values: Any, doors: Doors, key: str) -> None:
    """Refuse a function of an angle of whole turns that does not repeat after them."""
    import numpy as np

    for axis, name in enumerate(ordered):
        if name in doors.around:
            jump = np.abs(np.take(values, -1, axis) - np.take(values, 0, axis)).max()
            if jump > _CLOSE[len(ordered)] * np.abs(values).max():
                raise InputError(
                    f"as a function of {name} it must repeat after a whole turn, and it jumps by {jump:.3g} "
                    "there; give a table over the angles that the joint reaches instead",
                    key=key,
                )


def _called(
    function: OwnFunction, arguments: Sequence[str], ordered: Sequence[str], places: Sequence[Any], key: str
) -> Any:
    """Return the values of a function on the grid of some places."""
    import numpy as np

    grid = dict(zip(ordered, np.meshgrid(*places, indexing="ij"), strict=True))
    shape = tuple(of.size for of in places)
    found = np.asarray(function(*(grid[name] for name in arguments)), dtype=np.float64)
    if found.shape not in (shape, ()) or not np.isfinite(found).all():
        raise InputError(f"it must return a finite number for each of {' x '.join(map(str, shape))}", key=key)
    return np.broadcast_to(found, shape)


def _missed(
    function: OwnFunction,
    arguments: Sequence[str],
    ordered: Sequence[str],
    places: Sequence[Any],
    values: Any,
    key: str,
) -> float:
    """Return the error of the spline half way between rows, over the largest value."""
    import numpy as np
    from scipy.interpolate import CubicSpline

    between = [0.5 * (of[1:] + of[:-1]) for of in places]
    found = values
    for axis, (of, halfway) in enumerate(zip(places, between, strict=True)):
        found = CubicSpline(of, found, axis=axis)(halfway)
    largest = float(np.abs(values).max())
    missed = float(np.abs(found - _called(function, arguments, ordered, between, key)).max())
    return missed / largest if largest > 0.0 else missed


def _written(numbers: Any, unit: str) -> str:
    return f"{', '.join(map(repr, numbers.tolist()))} {unit}"
