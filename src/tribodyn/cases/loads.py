"""Loads on a body: keys that all mechanisms share, with their cross-checks; loads as Python functions.

A load is a force and a moment, given by their size along a direction or by components. Each is a signal: a
number, a sinusoid, a table over time, an angle, a position or a speed, or a map over two of them. A frame
says whether it is fixed in space, fixed in the body (follower), or opposes the motion.
"""

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Final, Literal, Protocol, TypeVar, runtime_checkable

from tribodyn.cases.case import Case, NamedGroup, demand, unit, with_entries
from tribodyn.cases.columns import KNOTS, VALUES
from tribodyn.cases.fields import Vector, choice, quantity, vector
from tribodyn.cases.signals import ForceMap, LineLoadTable, TorqueMap
from tribodyn.core.errors import InputError

FORCES: Final = ("force_x", "force_y", "force_z")
MOMENTS: Final = ("moment_x", "moment_y", "moment_z")
SIZES: Final = ("force", "moment")
_GIVEN: Final = (*SIZES, *FORCES, *MOMENTS)
_CANCELLED: Final = 1.0e-9


class BodyLoad(NamedGroup):
    """A force and a moment on a body."""

    #: Quantity of a table over the speed that a force or a moment opposes.
    SPEED_OF: ClassVar = {"force": "velocities", "moment": "speeds"}

    force: ForceMap | None = None
    moment: TorqueMap | None = None
    force_x: ForceMap | None = None
    force_y: ForceMap | None = None
    force_z: ForceMap | None = None
    moment_x: TorqueMap | None = None
    moment_y: TorqueMap | None = None
    moment_z: TorqueMap | None = None
    direction: Vector | None = vector(
        None, "of force and moment; against the motion: only along it", example="[-1, 0, 0]"
    )
    frame: Literal["ground", "body", "motion"] = choice(
        "ground", "fixed in space, fixed in the body (follower), or opposing the motion", "assumed"
    )
    span: LineLoadTable | None = None
    slip_velocity: float = quantity(
        "1 mm/s", "speed below which a force against the motion fades", "assumed", gt=0
    )
    slip_rate: float = quantity(
        "1 mrad/s", "angular speed below which a moment against the motion fades", "assumed", gt=0
    )

    @property
    def given(self) -> dict[str, ForceMap | TorqueMap]:
        """Its forces and moments, as far as it has them; of a span alone the force that it adds up to."""
        found = {key: getattr(self, key) for key in _GIVEN}
        here = {key: signal for key, signal in found.items() if signal is not None}
        if self.span is not None and not any(key.startswith("force") for key in here):
            return {"force": ForceMap.model_validate({"value": self._resultant()[0]}), **here}
        return here

    def shares(self, key: str) -> tuple[float, ...]:
        """Return force and moment, three components each, of one newton or newton metre under a key."""
        if key in SIZES:
            axis: Vector = (1.0, 0.0, 0.0) if self.direction is None else unit(self.direction, "direction")
        else:
            axis = float(key[-1] == "x"), float(key[-1] == "y"), float(key[-1] == "z")
        nothing = (0.0, 0.0, 0.0)
        return (*nothing, *axis) if key.startswith("moment") else (*axis, *nothing)

    @property
    def slip(self) -> float:
        """Speed below which a load against the motion fades [m/s]; of a moment [rad/s]."""
        return self.slip_rate if "moment" in self.given else self.slip_velocity

    @property
    def centroid(self) -> float:
        """Position at which the force of the span acts [m]."""
        whole, moment = self._resultant()
        largest = max(map(abs, self.span.values or (0.0,))) * self._length() if self.span else 0.0
        words = "its parts cancel: such a load has no centre of pressure"
        demand(abs(whole) > _CANCELLED * largest, "span.values", words)
        return moment / whole

    def _length(self) -> float:
        knots = self.span.knots if self.span is not None else (0.0,)
        return knots[-1] - knots[0]

    def _resultant(self) -> tuple[float, float]:
        """Return force of the span [N] and its moment about position zero [N m]."""
        from scipy.interpolate import PPoly

        assert self.span is not None
        curve = self.span.curve()
        total = PPoly(curve.coefficients, curve.knots).antiderivative()
        # ∫ z q dz = [z Q] − ∫ Q dz with Q' = q.
        first, last = curve.knots[0], curve.knots[-1]
        moment = last * total(last) - first * total(first) - total.integrate(first, last)
        return float(total(last) - total(first)), float(moment)

    def check_given(self, example: str) -> None:
        """Refuse a table without a load, and a size without a direction."""
        key = example.partition(" ")[0]
        demand(bool(self.given), key, f"a load needs a force or a moment, such as {example}")
        needs = any(self._needs_direction(key) for key in self.given)
        words = "a load needs its direction, such as direction = [-1, 0, 0]"
        demand(not needs or self.direction is not None, "direction", words)
        if self.direction is not None:
            unit(self.direction, "direction")

    def _needs_direction(self, key: str) -> bool:
        return key in SIZES and self.frame != "motion"

    def check_opposing(self) -> None:
        """Refuse a load against the motion of a point or body that has more than one size."""
        words = "against the motion acts a force or a moment; write two loads"
        demand(self.frame != "motion" or len(self.given) == 1, "frame", words)
        words = 'against the motion a load has one size, such as force = "10 N"; a direction restricts it'
        sized = all(key in SIZES for key in self.given)
        demand(self.frame != "motion" or sized, "frame", words)

    def check_followed(self, allowed: Iterable[str], words: str) -> None:
        """Refuse tables over what this load cannot follow."""
        allowed = tuple(allowed)
        for key, signal in self.given.items():
            opposed = self.SPEED_OF.get(key) if self.frame == "motion" else None
            for over in signal.axes:
                demand(over in allowed or over == opposed, f"{key}.{over}", words)


#: Takes arrays of times [s] or angles [rad] by their names and returns as many values, SI units.
OwnFunction = Callable[..., Any]

_FIRST: Final = 33
_MOST: Final = {1: 4097, 2: 193}  #: Rows of the first trial, and at most over each of one or two arguments.
#: Of the largest value: what the curve or surface may miss half way between rows.
_CLOSE: Final = {1: 1.0e-6, 2: 1.0e-5}


@dataclass(frozen=True)
class Doors:
    """Keys of a kind of case that take functions."""

    #: Table that a drive fills, such as ``drive.angle``, and its unit; None where there is not just one.
    drive: tuple[str, str] | None
    loads: Mapping[str, tuple[str, str]]  #: Tables that loads fill, by the names of loads, and their units.
    #: Keys that a load of that name takes the place of, with their value then.
    overridden: Mapping[str, tuple[str, str]]
    #: Names that arguments may have, with the key of what they stand for and its range in a case [s, rad].
    arguments: Mapping[str, tuple[str, tuple[float, float]]]
    #: Keys of the table of the load that go with an argument.
    beside: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    around: tuple[str, ...] = ()  #: Arguments that are angles over one turn, after which a function repeats.


@runtime_checkable
class Controlled(Protocol):
    """A case that takes functions in the place of controllers."""

    def with_controllers(self, functions: Mapping[str, OwnFunction]) -> Case:
        """Return the case with functions by the names of controllers; refuse those that do not fit."""


_Any = TypeVar("_Any", bound=Case)


def with_functions(case: _Any, drive: OwnFunction | None, loads: Mapping[str, OwnFunction] | None) -> _Any:
    """Return a case with tables of functions for its drive and loads.

    ``drive``: crank angle [rad], or speed of a shaft [rad/s], as a function of ``t`` [s]; ``loads``: forces
    [N] and moments [N m] by name, as functions of ``t`` or an angle, or of both. Raises InputError if a
    function takes or returns something else, or is not smooth.
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
