"""The journal of the paper's section 4, dry or in oil: keys, cross-checks, and the mechanism that it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, ClassVar, Final, Literal

from tribodyn.cases.beyond import FollowedTable, followed
from tribodyn.cases.case import Group, demand
from tribodyn.cases.fields import Vector, choice, number, quantity, switch, tables, text, vector
from tribodyn.cases.groups import Solver, Tolerances, check_output_interval
from tribodyn.cases.joint_keys import FilmKeys, FormKeys, OptionalFilmKeys, PlainJoint
from tribodyn.cases.keys import ASSUMED, Value
from tribodyn.cases.loads import Doors, ShaftLoad
from tribodyn.cases.messages import Remarks
from tribodyn.cases.rough import BushingCase, of_choice
from tribodyn.cases.signals import SpeedTable
from tribodyn.mechanism.mechanism_case import MechanismCase

SECTION_4 = "paper, section 4.1"
_FRICTION = "joint.friction_coefficient"
#: Defaults with oil, where the journal sinks through the film first.
_LUBRICATED: dict[str, Value] = {
    "title": "Journal bearing, rough contact in oil",
    "run.duration": 0.05,
    "run.output_interval": 5e-5,
}


class JournalJoint(PlainJoint):
    """The clearance joint: a journal in a bushing."""

    friction_coefficient: float = number(
        0.0, "coefficient of friction mu_f; the paper's section 4 names none", ASSUMED, ge=0, le=2
    )
    friction: Literal["traction"] = choice("traction", "traction along the actual slip", ASSUMED)


class Shaft(Group):
    """The rigid journal and its rotation."""

    mass: float = quantity("0.253 kg", "mass; in the paper that of the vane", "paper, Table 1", gt=0)
    speed: float = quantity("0 rad/s", "speed of rotation, kept by a drive", SECTION_4)
    tilt: bool = switch(False, "whether the journal can tilt in the bushing", SECTION_4)
    transverse_inertia: float = quantity(
        "5.41e-4 kg m^2", "moment of inertia across the axis, about the centre; used with tilt", ASSUMED, gt=0
    )
    spin_inertia: float = quantity(
        "4.55e-6 kg m^2", "moment of inertia about the axis; used with tilt and rotation", ASSUMED, ge=0
    )


class JournalDriveKeys(Group):
    """Drive of the journal."""

    speed: SpeedTable | None = None


class JournalLoadKeys(Group):
    """Loads on the centre of the journal."""

    force_x: float = quantity("200 N", "load W_x", SECTION_4)
    force_y: float = quantity("100 N", "load W_y", SECTION_4)
    moment_x: float = quantity("0 N m", "moment about X, right-handed; used with tilt", ASSUMED)
    moment_y: float = quantity("0 N m", "moment about Y, left-handed; used with tilt", ASSUMED)
    more: Mapping[str, JournalLoad] = tables("loads from tables, beside these")


_COMPONENTS: Final = {"force_x": "N", "force_y": "N", "moment_x": "N m", "moment_y": "N m"}


class JournalLoad(ShaftLoad):
    """A load on the journal from tables over time, angle or speed of rotation; of no size along its axis."""

    point: Vector | None = vector(
        None,
        "where forces act on the axis, from the centre; the centre without it",
        ASSUMED,
        unit="mm",
        example='["0 mm", "0 mm", "5 mm"]',
    )

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        self.check_given('force_x = "100 N"')
        self.check_opposing()
        self.check_followed(("times", "angles", "speeds"), "a load on the journal follows time or its angle")
        for key in ("force_z", "moment_z"):
            words = "bearing and drive hold the journal along Z: give loads across its axis"
            demand(key not in self.given, key, words)
        opposing = self.frame == "motion"
        words = "against the motion acts a force on the centre of the journal"
        demand(not opposing or "force" in self.given, "moment", words)
        placed = self.direction is not None or self.point is not None or self.span is not None
        demand(not opposing or not placed, "frame", f"{words}, with no direction, point or span")
        words = "a force on the journal acts on its axis: the first two of three lengths are zero"
        demand(self.point is None or self.point[:2] == (0.0, 0.0), "point", words)
        words = "it follows from the span"
        demand(self.point is None or self.span is None, "point", words)

    @property
    def height(self) -> float:
        """Height of the forces along Z, from the centre [m]."""
        if self.span is not None:
            return self.centroid
        return 0.0 if self.point is None else self.point[2]


class TightTolerances(Tolerances):
    """Absolute tolerance of each kind of state; the undamped rebounds need them."""

    position: float = quantity("1e-11 m", "for e_x and e_y", ASSUMED, gt=0)
    tilt: float = quantity("1e-9 rad", "for phi_x and phi_y", ASSUMED, gt=0)
    velocity: float = quantity("1e-7 m/s", "for the rates of e_x and e_y", ASSUMED, gt=0)
    tilt_rate: float = quantity("1e-5 rad/s", "for the rates of phi_x and phi_y", ASSUMED, gt=0)


class Tight(Solver):
    """The time integration."""

    rtol: float = number(
        1e-5, "relative tolerance; undamped rebounds need it to keep their energy", ASSUMED, ge=1e-12, le=0.1
    )
    atol: TightTolerances = TightTolerances()


class JournalRunKeys(Group):
    """Duration, start and outputs."""

    duration: float = quantity("10 ms", "simulated time", "depends on film.lubricated", gt=0)
    start: Literal["offset", "equilibrium"] = choice(
        "offset", "start at rest at start_x, start_y, or in static equilibrium", ASSUMED
    )
    start_x: float = quantity("0 um", "e_x at the start", ASSUMED)
    start_y: float = quantity("0 um", "e_y at the start", ASSUMED)
    output_interval: float = quantity("5 us", "time between rows", "depends on film.lubricated", gt=0)


class JournalCase(BushingCase):
    """The journal of the paper's section 4 unless keys say otherwise."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = tuple(
        ("journal.speed", f"drive.speed.{key}") for key in SpeedTable.model_fields
    )

    case: Literal["journal"] = choice("journal", "the kind of system", "")
    title: str = text("Journal bearing, dry rough contact", "heading of figures and report")
    joint: JournalJoint = JournalJoint()
    journal: Shaft = Shaft()
    drive: JournalDriveKeys = JournalDriveKeys()
    loads: JournalLoadKeys = JournalLoadKeys()
    film: OptionalFilmKeys = OptionalFilmKeys()
    solver: Tight = Tight()
    run: JournalRunKeys = JournalRunKeys()

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from the contact law, and from whether there is oil."""
        found = super().resolve(given)
        if not given.get("film.lubricated"):
            return found
        # What the library has is dry friction.
        return {path: value for path, value in found.items() if path != _FRICTION} | _LUBRICATED

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        return self.run.duration

    def followed(self) -> Iterable[FollowedTable]:
        """Return the tables that the speed and loads follow."""
        loads = {
            f"loads.more.{name}.{key}": signal
            for name, load in self.loads.more.items()
            for key, signal in load.given.items()
        }
        drives = {} if self.drive.speed is None else {"drive.speed": self.drive.speed}
        follows = dict.fromkeys(loads, "the journal")
        return followed(drives | loads, self.duration, follows=follows)

    def remarks(self) -> Remarks:
        """Return remarks on the two surfaces and on tables."""
        return super().remarks() + of_choice(self, ("",))

    def idle(self) -> tuple[str, ...]:
        """Return the speed where a table takes its place."""
        return () if self.drive.speed is None else ("journal.speed",)

    def doors(self) -> Doors:
        """Return the keys for functions of speed and loads."""
        overridden = {name: f"0 {unit}" for name, unit in _COMPONENTS.items()}
        turned = self._turned()
        return Doors(
            drive=("drive.speed", "rad/s"),
            loads={name: (f"loads.more.function-{name}.{name}", unit) for name, unit in _COMPONENTS.items()},
            overridden={name: (f"loads.{name}", zero) for name, zero in overridden.items()},
            arguments={"t": ("times", (0.0, self.duration)), "angle": ("angles", turned)},
        )

    def _turned(self) -> tuple[float, float]:
        """Return the smallest and the largest angle of rotation in the run [rad]."""
        if self.drive.speed is None:
            return min(0.0, self.journal.speed * self.duration), max(0.0, self.journal.speed * self.duration)
        from scipy.interpolate import PPoly

        curve = self.drive.speed.curve()
        angle = PPoly(curve.coefficients, curve.knots).antiderivative()(curve.knots)
        return float(angle.min()), float(angle.max())

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the cross-checks of keys."""
        return (*super().checks(), self._check_run, self._check_form, self._check_loads)

    def _check_loads(self) -> None:
        """Check that loads against the motion fade at one speed."""
        slips = {name: load.slip_velocity for name, load in self.loads.more.items() if load.frame == "motion"}
        for name, slip in slips.items():
            words = "loads against the motion of a journal share one slip_velocity"
            demand(slip == self.slip_velocity, f"loads.more.{name}.slip_velocity", words)

    @property
    def slip_velocity(self) -> float:
        """Speed of the centre below which loads against its motion fade [m/s]."""
        opposing = (load.slip_velocity for load in self.loads.more.values() if load.frame == "motion")
        return next(opposing, 0.0)

    def _check_form(self) -> None:
        demand(
            not self.film.lubricated or self.joint.form == FormKeys(),
            "joint.form",
            "the oil film knows no form: film.lubricated = false is needed",
        )

    def _check_run(self) -> None:
        run, clearance = self.run, self.joint.clearance
        if self.temperature.changes:
            clearance = self.temperature.dimensions(self.joint, self.surfaces).clearance
        e = math.hypot(run.start_x, run.start_y)
        demand(
            run.start == "equilibrium" or e < clearance,
            "run.start_x",
            f"the journal would start outside the bushing, {e * 1e6:.4g} um off its axis with a clearance "
            f"of {clearance * 1e6:.4g} um",
        )
        check_output_interval(run.output_interval, run.duration)


BODY: Final = "journal"
BEARING: Final = "bearing"
_CENTRE: Final = (0.0, 0.0, 0.0)
_ALONG: Final = (0.0, 0.0, 1.0)
#: Directions of loads; moments about Y are left-handed.
_CONSTANT: Final = {
    "force_x": (1.0, 0.0, 0.0),
    "force_y": (0.0, 1.0, 0.0),
    "moment_x": (1.0, 0.0, 0.0),
    "moment_y": (0.0, -1.0, 0.0),
}
_LEAST_SPIN: Final = 1.0e-9  #: Least moment of inertia about the axis over that across it: no body has none.


def mechanism_of(case: JournalCase) -> MechanismCase:
    """Return the mechanism that a journal is.

    ``case``: the journal, its joint, drive and loads. Returns one body, the joint ``bearing`` with its
    clearance and its film, and, without tilt, a planar joint.
    """
    held = {"between": ("ground", BODY), "point": _CENTRE, "axis": _ALONG}
    joints: dict[str, Any] = {BEARING: {**held, "type": "revolute", "clearance": _clearance(case)}}
    if case.film.lubricated:
        joints[BEARING]["film"] = {key: getattr(case.film, key) for key in FilmKeys.model_fields}
    if not case.journal.tilt:
        joints["plane"] = {**held, "type": "planar"}
    return MechanismCase.model_validate(
        {
            "case": MechanismCase.kind(),
            "title": case.title,
            "surfaces": case.surfaces,
            "asperities": case.asperities,
            "contact": case.contact,
            "bodies": {BODY: {"mass": case.journal.mass, "centre": _CENTRE, "inertia": inertia(case)}},
            "joints": joints,
            "drives": {"motor": {"joint": BEARING, "speed": _speed(case)}},
            "loads": {name: load for name, load in _loads(case)},
            "solver": {"name": case.solver.name, "rtol": case.solver.rtol, "grid": _of(case.solver.grid)},
            "run": {
                "duration": case.run.duration,
                "output_interval": case.run.output_interval,
                "start": "centred",
                "step_rows": 0,
            },
        }
    )


def inertia(case: JournalCase) -> tuple[float, float, float]:
    """Return the moments of inertia of the body [kg m²]; without tilt the one about the axis does nothing."""
    across, spin = case.journal.transverse_inertia, case.journal.spin_inertia
    return across, across, max(spin, _LEAST_SPIN * across) if case.journal.tilt else across


def _clearance(case: JournalCase) -> dict[str, Any]:
    joint, temperature = case.joint, case.temperature
    same = ("radius", "length", "contact", "friction_coefficient", "slip_velocity", "liner", "form")
    # What the material does over the temperature is in the surfaces already.
    warm = {key: value for key, value in _of(temperature).items() if key != "properties"}
    found = {"radial": joint.clearance, "temperature": warm, **{key: getattr(joint, key) for key in same}}
    return found if joint.bulk is None else found | {"bulk": joint.bulk}


def _of(group: Any) -> dict[str, Any]:
    """Return the keys of a table that have a value."""
    values = {key: getattr(group, key) for key in type(group).model_fields}
    return {key: value for key, value in values.items() if value is not None}


def _speed(case: JournalCase) -> dict[str, Any]:
    return {"value": case.journal.speed} if case.drive.speed is None else _of(case.drive.speed)


def _loads(case: JournalCase) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the loads by name, each a force or a moment."""
    for key, direction in _CONSTANT.items():
        size = {"value": getattr(case.loads, key)}
        yield f"constant-{key}", {"body": BODY, "direction": direction, key.partition("_")[0]: size}
    for name, load in case.loads.more.items():
        for key, signal in load.given.items():
            yield f"{name}-{key}", _load(load, key, signal)


def _load(load: JournalLoad, key: str, signal: Any) -> dict[str, Any]:
    """Return one size of a load."""
    size, _, component = key.partition("_")
    found: dict[str, Any] = {"body": BODY, "frame": load.frame, size: signal}
    direction = _CONSTANT[key] if component else load.direction
    found |= {} if direction is None else {"direction": direction}
    if load.frame == "motion":
        return {**found, "slip_velocity": load.slip_velocity}
    if size == "force":
        found["point"] = (0.0, 0.0, load.height)
    if any(over != "times" for over in signal.axes):
        found["along"] = BEARING
    return found
