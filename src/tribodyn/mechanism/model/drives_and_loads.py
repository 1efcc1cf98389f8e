"""Drives and loads of a mechanism: their keys and their cross-checks."""

import math
from collections.abc import Mapping
from typing import Final, TypeAlias

from tribodyn.cases.case import NamedGroup, demand, unit
from tribodyn.cases.columns import KNOTS
from tribodyn.cases.fields import Vector, name, quantity, vector
from tribodyn.cases.loads import BodyLoad, Doors
from tribodyn.cases.signals import (
    AngleSignal,
    ForceSignal,
    PositionSignal,
    SpeedSignal,
    TorqueSignal,
    VelocitySignal,
)
from tribodyn.mechanism.model.parts import POINT

AnySignal: TypeAlias = (
    AngleSignal | SpeedSignal | TorqueSignal | PositionSignal | VelocitySignal | ForceSignal
)

#: Quantities of a drive: a coordinate, and 0 for itself, 1 for its rate, 2 for its acceleration.
GIVEN: Final = {
    "angle": ("angle", 0),
    "speed": ("angle", 1),
    "torque": ("angle", 2),
    "position": ("position", 0),
    "velocity": ("position", 1),
    "force": ("position", 2),
}


def given_of(coordinate: str) -> str:
    """Return the quantities of a drive for a coordinate, in words."""
    *some, last = (given for given, (of, _) in GIVEN.items() if of == coordinate)
    return f"{', '.join(some)} or {last}"


#: Units of what drives give.
UNITS: Final = {
    "angle": "rad",
    "speed": "rad/s",
    "torque": "N m",
    "position": "m",
    "velocity": "m/s",
    "force": "N",
}
_ROUNDED: Final = 1.0e-9  #: Share of a turn by which rounded angles may miss whole turns.
#: Coordinate of a joint that a table follows, by what it stands over.
COORDINATE_OF: Final = {
    "angles": "angle",
    "speeds": "angle",
    "positions": "position",
    "velocities": "position",
}


class DriveKeys(NamedGroup):
    """Drive of the mechanism, at a joint: one of the tables below it."""

    joint: str = name(None, "which joint it moves", example="main", required=True)
    angle: AngleSignal | None = None
    speed: SpeedSignal | None = None
    torque: TorqueSignal | None = None
    position: PositionSignal | None = None
    velocity: VelocitySignal | None = None
    force: ForceSignal | None = None
    torque_limit: float | None = quantity(
        None, "most that the motor may give: results say which share it gives", gt=0, example="5 N m"
    )
    force_limit: float | None = quantity(
        None, "most that the actuator may give: results say which share it gives", gt=0, example="500 N"
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that it gives one thing, over time."""
        given = [key for key in GIVEN if getattr(self, key) is not None]
        words = f'a drive gives one of {", ".join(GIVEN)}, such as speed = "100 rpm"'
        demand(len(given) == 1, given[1] if given[1:] else "speed", words)
        demand(self.signal.over in ("", "times"), f"{given[0]}.{self.signal.over}", "a drive follows time")
        other, own = ("force", "torque") if GIVEN[self.gives][0] == "angle" else ("torque", "force")
        words = f"the limit of this drive is {own}_limit"
        demand(getattr(self, f"{other}_limit") is None, f"{other}_limit", words)
        self._check_cyclic()

    def _check_cyclic(self) -> None:
        """Refuse a cyclic motion that jumps; an angle may go on by whole turns."""
        level, values = GIVEN[self.gives][1], self.signal.values
        if not (self.signal.cyclic and values) or level > 1:
            return
        turns = (values[-1] - values[0]) / (2.0 * math.pi) if self.gives == "angle" else 0.0
        closes = abs(turns - round(turns)) < _ROUNDED if turns else values[-1] == values[0]
        words = "a cyclic motion ends where it begins" + (", or whole turns on" if turns else "")
        demand(closes, f"{self.gives}.values", words)

    @property
    def gives(self) -> str:
        """Member of :data:`GIVEN`."""
        return next(key for key in GIVEN if getattr(self, key) is not None)

    @property
    def signal(self) -> AnySignal:
        """Quantity that it prescribes."""
        found: AnySignal = getattr(self, self.gives)
        return found

    @property
    def period(self) -> float | None:
        """Time after which the drive comes again [s]; None for one that does not."""
        turning, signal = self.gives == "speed", self.signal
        if turning and signal.value and signal.period is None:
            return 2.0 * math.pi / abs(signal.value)
        return signal.period


class LoadKeys(BodyLoad):
    """A force and a moment on a body."""

    body: str = name(None, "which body it acts on", example="slider", required=True)
    point: Vector | None = vector(
        None, "point of application of the force; by default the mass centre", unit="mm", example=POINT
    )
    span_axis: Vector | None = vector(
        None, "direction of positions of a span, from the point", example="[0, 0, 1]"
    )
    along: str | None = name(
        None, "joint whose coordinate or speed a table follows; time without it", example="main"
    )

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        self.check_given('force = "100 N"')
        self.check_opposing()
        words = "a load along a joint's coordinate is a table over angles or positions"
        timed = any(signal.axes for signal in self.given.values())
        demand(self.along is None or any(self.joint_axes) or not timed, "along", words)
        over = ("times",) if self.along is None else KNOTS
        words = "a table over angles, positions or speeds needs the joint that it follows: along"
        self.check_followed(over, words)
        words = "a span needs the direction of its positions, such as span_axis = [0, 0, 1]"
        demand((self.span is None) == (self.span_axis is None), "span_axis", words)
        if self.span_axis is not None:
            unit(self.span_axis, "span_axis")
        words = "a load against the motion of one body cannot follow a joint's speed as well: write two loads"
        demand(self.along is None or not self.follows_own_speed, "along", words)

    @property
    def joint_axes(self) -> list[str]:
        """Tables over a coordinate or a speed, by what they stand over."""
        return [over for signal in self.given.values() for over in signal.axes if over != "times"]

    @property
    def follows_own_speed(self) -> bool:
        """Whether a table follows the speed that the load opposes."""
        return self.along is None and bool(self.joint_axes)

    def acts_at(self, centre: Vector) -> Vector:
        """Return the point of the force, as in the model [m], on a body with a mass centre there."""
        x, y, z = self.point or centre
        if self.span_axis is None:
            return x, y, z
        (a, b, c), s = unit(self.span_axis, "span_axis"), self.centroid
        return x + s * a, y + s * b, z + s * c


def doors_of(drives: Mapping[str, DriveKeys], loads: Mapping[str, LoadKeys], duration: float) -> Doors:
    """Return the keys for functions of the drive and of loads: ``gas``, or ``gas.force`` of several."""
    paths = {
        f"{name}.{key}": (f"loads.{name}.{key}", "N m" if key.startswith("moment") else "N")
        for name, load in loads.items()
        for key in load.given
    }
    single = {name: next(iter(load.given)) for name, load in loads.items() if len(load.given) == 1}
    of_drives = [(f"drives.{name}.{drive.gives}", UNITS[drive.gives]) for name, drive in drives.items()]
    return Doors(
        drive=of_drives[0] if len(of_drives) == 1 else None,
        loads={name: paths[f"{name}.{key}"] for name, key in single.items()} | paths,
        overridden={},
        arguments={"t": ("times", (0.0, duration)), "angle": ("angles", (0.0, 2.0 * math.pi))},
        around=("angle",),
    )
