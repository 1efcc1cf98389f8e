"""Drives and loads of the vane mechanism beside the loads of the paper: keys and cross-checks."""

import itertools
from typing import ClassVar, Final, Literal

from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.fields import Vector, choice, number, quantity, switch, vector
from tribodyn.cases.keys import ASSUMED
from tribodyn.cases.loads import FORCES, BodyLoad
from tribodyn.cases.signals import AngleTable, PositionTable, SpeedTable

DRIVE: Final = "paper, section 5.1"
DRIVE_TABLES: Final = ("angle", "speed", "stroke")
_SIZES: Final = (*FORCES, "moment")


def _keys_of_tables(*names: str) -> list[str]:
    """Return the paths of all keys of some tables."""
    return [f"{name}.{key}" for name in names for key in AngleTable.model_fields]


class CrankKeys(Group):
    """Motion of the crank: start + amplitude/frequency (1 - cos(frequency t)), or a table over time."""

    start_angle: float = quantity("-16 deg", "crank angle at the start", DRIVE, ge="-180 deg", le="180 deg")
    speed_amplitude: float = quantity(
        "20 deg/s", "largest angular speed of the crank; negative: it sets out backwards", DRIVE
    )
    angular_frequency: float = quantity("1 rad/s", "of the sinusoidal crank speed", DRIVE, gt=0)
    corner_time: float = quantity("20 ms", "over which corners of a ramp are rounded", ASSUMED, gt=0)
    actuator_arm: float | None = quantity(
        None, "arm on the crank over which a stroke turns it", ASSUMED, gt=0, example="50 mm"
    )
    angle: AngleTable | None = None
    speed: SpeedTable | None = None
    stroke: PositionTable | None = None

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        *itertools.product(_keys_of_tables(*DRIVE_TABLES), ("speed_amplitude", "angular_frequency")),
        *itertools.product(_keys_of_tables("angle"), ("start_angle",)),
        *(
            pair
            for one, other in itertools.combinations(DRIVE_TABLES, 2)
            for pair in itertools.product(_keys_of_tables(one), _keys_of_tables(other))
        ),
    )

    @property
    def table(self) -> tuple[str, AngleTable | SpeedTable | PositionTable] | None:
        """Signal of the crank, with its name; None for the sinusoid."""
        return next(
            ((name, found) for name in DRIVE_TABLES if (found := getattr(self, name)) is not None), None
        )


#: Names of loads that Python functions give, with their units.
COMPONENTS: Final = {
    "force_x": "N",
    "force_y": "N",
    "force_z": "N",
    "moment": "N m",
    "moment_x": "N m",
    "moment_y": "N m",
}


class VaneLoad(BodyLoad):
    """A load on the vane, added to those of the paper."""

    SPEED_OF: ClassVar = {}

    along: Literal["vane", "crank"] = choice(
        "vane", "whose angle or speed a table over angles or speeds follows", ASSUMED
    )
    against_motion: bool = switch(
        False, "whether it opposes the motion of the vane, as with frame = motion", ASSUMED
    )
    point: Vector | None = vector(
        None,
        "where forces act, from the trunnion centre, X along the lever, Z up; the vane's centre without",
        ASSUMED,
        unit="mm",
        example='["20 mm", "0 mm", "-85 mm"]',
    )
    centre_of_pressure: float | None = quantity(
        None,
        "from the trunnion centre down to where force_x and force_y act; the vane's centre without",
        ASSUMED,
        ge=0,
        example="85 mm",
    )

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        demand(
            self.span is None or self.centre_of_pressure is None,
            "centre_of_pressure",
            "it follows from the span",
        )
        places = (self.point, self.centre_of_pressure, self.span)
        words = "give one of point, centre_of_pressure and span"
        demand(self.point is None or sum(place is not None for place in places) == 1, "point", words)
        self.check_given('moment = "1 N m"')
        self.check_followed(("times", "angles", "speeds"), "a load on the vane follows time or an angle")

    def shares(self, key: str) -> tuple[float, ...]:
        """Return force and moment of one unit; one without direction is about Z, ``moment_y`` left-handed."""
        found = super().shares("moment_z" if self._is_about_z(key) else key)
        return tuple(-share for share in found) if key == "moment_y" else found

    def _needs_direction(self, key: str) -> bool:
        return key == "force" or (key == "moment" and not self._is_about_z(key))

    def _is_about_z(self, key: str) -> bool:
        return key == "moment" and self.direction is None

    @property
    def opposes(self) -> bool:
        """Whether it opposes the motion of the vane."""
        return self.against_motion or self.frame == "motion"

    @property
    def arm(self) -> float | None:
        """From the trunnion centre down to where forces act [m]; None for the vane's centre."""
        if self.point is not None:
            return -self.point[2]
        return self.centre_of_pressure if self.span is None else self.centroid


class _Shaken(NamedGroup):
    """Forces and a moment by their size."""

    SIZE: ClassVar[str]  #: Key of a signal that holds the sizes.

    force_x: float | None = quantity(None, "force along X", example="0.5 N")
    force_y: float | None = quantity(None, "force along Y", example="0.5 N")
    force_z: float | None = quantity(None, "force along Z", example="0.5 N")
    moment: float | None = quantity(None, "moment about Z", example="0.02 N m")

    def model_post_init(self, context: object, /) -> None:
        """Check that there is a load."""
        words = 'a load needs a force or a moment, such as moment = "0.02 N m"'
        demand(any(getattr(self, key) is not None for key in _SIZES), "moment", words)

    @property
    def load(self) -> VaneLoad:
        """The same with the keys that loads of all models share."""
        given = {key: getattr(self, key) for key in type(self).model_fields}
        course = {key: value for key, value in given.items() if key not in _SIZES}
        sizes = {key: given[key] for key in _SIZES if given[key] is not None}
        return VaneLoad.model_validate({key: {self.SIZE: size, **course} for key, size in sizes.items()})


class VanePassing(_Shaken):
    """Excitation by the blades beside the vane: amplitudes of a sinusoid."""

    SIZE: ClassVar[str] = "amplitude"

    order: float = number(1.0, "waves in a turn of the shaft, such as the number of blades", ASSUMED, gt=0)
    shaft_speed: float = quantity("12000 rpm", "speed of the shaft", ASSUMED, gt=0)
    phase: float = quantity("0 deg", "at the start", ASSUMED)


class Surge(_Shaken):
    """A pulse of the flow: largest values of a squared sine."""

    SIZE: ClassVar[str] = "pulse"

    begin: float = quantity("0 s", "when it begins", ASSUMED, ge=0)
    length: float = quantity("50 ms", "how long it lasts", ASSUMED, gt=0)
