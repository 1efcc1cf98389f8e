"""Bodies, joints, springs and pairs of surfaces of a mechanism: their keys and their cross-checks."""

from __future__ import annotations

import math
from itertools import combinations
from typing import TYPE_CHECKING, Any, Final, Literal, Self

from tribodyn.cases.case import NamedGroup, demand, dot, unit
from tribodyn.cases.fields import Vector, choice, count, name, names, number, quantity, switch, vector
from tribodyn.cases.groups import AsperityKeys, Contact, Surfaces
from tribodyn.cases.joint_keys import (
    CONFORMAL,
    NOTHING,
    SLEEVE,
    SURFACE,
    FilmKeys,
    FormKeys,
    LinerKeys,
    SurfaceWear,
)
from tribodyn.cases.keys import ASSUMED
from tribodyn.cases.temperature import Temperature
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.joints.joint_type import AT_POINT, JointType
from tribodyn.mechanism.members import foreign_keys, with_own_keys
from tribodyn.mechanism.shapes import SHAPES, shapes_of

if TYPE_CHECKING:
    from tribodyn.contact import SurfacePair


def friction_of(which: str) -> Any:
    """Return the key of the coefficient of friction of some joints."""
    return number(
        0.1, f"coefficient of friction mu_f of {which}, unless a joint says otherwise", ASSUMED, ge=0, le=2
    )


class PairWear(SurfaceWear):
    """Wear of the surfaces of a pair; that of the case without a material of their own."""


class PairKeys(NamedGroup):
    """Surfaces, contact law, friction and wear of joints that name them."""

    surfaces: Surfaces = Surfaces()
    asperities: AsperityKeys = AsperityKeys()
    contact: Contact = Contact()
    friction_coefficient: float = friction_of("the joints of this pair")
    wear: PairWear = PairWear()

    @property
    def surface_pair(self) -> SurfacePair:
        """The two surfaces in contact, as contact laws take them."""
        return self.surfaces.pair(self.asperities)

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        self.contact.check(self.surface_pair)


def check_film(joint: Any) -> None:
    """Refuse an oil film that the kernels of the film do not describe; the keys are those of its joint.

    Raises InputError if the joint is not a pin that turns in a round bore.
    """
    key, clearance = "film.viscosity", joint.clearance
    words = "an oil film is in the bore of a pin: a clearance with radius, radial and length is needed"
    demand(clearance is not None and SHAPES[joint.shape].BORE, key, words)
    words = f"an oil film is that of a revolute joint; in a {joint.type} one oil would also resist sliding"
    demand("position" not in joint.kind.COORDINATES, key, words)
    words = "an oil film is as long as its bore: leave pin_length out"
    demand(clearance.pin_length is None, "clearance.pin_length", words)
    words = "an oil film is between round surfaces: leave form or film out"
    demand(clearance.form == FormKeys(), "clearance.form", words)
    words = "an oil film has one viscosity and one clearance: give constant temperatures"
    demand(not clearance.temperature.tables, "clearance.temperature.over_time", words)


POINT: Final = '["0 mm", "0 mm", "170 mm"]'
_LEAST_ANGLE: Final = 1e-3  #: Sine of the least angle between two axes that must not be parallel.
_MOST_TILT: Final = math.radians(10.0)
OFF_DRAWING: Final = ("deviation", "tilt")  #: Keys of a joint that the ideal counterpart has not.


class _Sizes(NamedGroup):
    """The sizes that several shapes have."""

    radius: float | None = quantity(None, "radius of the pin or ball", gt=0, example="9.5 mm")
    radial: float | None = quantity(
        None,
        "radial clearance: radius of the bore minus radius of the pin; gap at each flat wall, centred",
        gt=0,
        example="20 um",
    )
    length: float | None = quantity(
        None,
        "length of the bore of a cylinder, of the block of a guide, of the pin in a slot",
        gt=0,
        example="20 mm",
    )


if TYPE_CHECKING:
    _OfAllShapes = _Sizes
else:
    _OfAllShapes = with_own_keys(_Sizes, SHAPES.values())


class ClearanceKeys(_OfAllShapes):
    """Clearance of a joint; without this table it is ideal."""

    shape: str | None = choice(
        None,
        "shape of the surfaces, if not the default of the joint type",
        family="tribodyn.mechanism.shapes:SHAPES",
        example="mesh",
    )
    socket: str | None = name(None, "body that carries the bore; by default the first one", example="rod")
    friction_coefficient: float = number(
        0.1,
        "coefficient of friction mu_f; without it that of its pair, or of the case",
        "assumed",
        ge=0,
        le=2,
    )
    slip_velocity: float = quantity(
        "1 mm/s", "slip at which traction is fully developed u_s", "assumed", gt=0
    )
    contact: str = choice(
        SURFACE, "over the surface, or at a point", "assumed", family="tribodyn.joints:CONTACTS"
    )
    pair: str | None = name(
        None, "its surfaces and contact law, of [pairs]; those of the case without it", example="steel-ptfe"
    )
    bulk: Literal["conformal", "sleeve", "none"] | None = choice(
        None,
        "what yields under the asperities: both bodies, the sleeve of liner, or nothing; without it the "
        "sleeve where liner has a thickness, else nothing, or both where asperities do not carry",
        example="conformal",
    )
    liner: LinerKeys = LinerKeys()
    form: FormKeys = FormKeys()
    temperature: Temperature = Temperature()
    ideal: bool = switch(False, "treat the joint as ideal and ignore this table", "assumed")
    nodes_around: int | None = count(
        None, "nodes around; without it solver.grid.theta", ge=12, le=4096, example="96"
    )
    nodes_along: int | None = count(None, "nodes along; without it solver.grid.z", ge=2, le=256, example="16")

    def model_post_init(self, context: object, /) -> None:
        """Check sizes against each other."""
        super().model_post_init(context)
        self.liner.check_contact(self.contact, "")
        self._check_bulk()
        if self.radius is not None and self.radial is not None:
            words = "the clearance must not exceed a tenth of the radius"
            demand(self.radial <= 0.1 * self.radius, "radial", words)

    @property
    def under(self) -> str:
        """Kind of body under the asperities."""
        default = NOTHING if self.liner.thickness is None else SLEEVE
        return NOTHING if self.contact != SURFACE else self.bulk or default

    @property
    def may_yield(self) -> bool:
        """Whether there may be elastic bodies under its asperities."""
        return self.contact == SURFACE and self.liner.thickness is None

    def _check_bulk(self) -> None:
        words = f'a sleeve needs its thickness, such as liner.thickness = "1 mm"; or bulk = "{CONFORMAL}"'
        demand(self.bulk != SLEEVE or self.liner.thickness is not None, "liner.thickness", words)
        words = f'liner.thickness makes a sleeve: leave it out, or bulk = "{SLEEVE}"'
        demand(self.bulk in (None, SLEEVE) or self.liner.thickness is None, "bulk", words)
        words = f'a contact at points is elastic by itself: leave bulk out, or contact = "{SURFACE}"'
        demand(self.bulk in (None, NOTHING) or self.contact == SURFACE, "bulk", words)

    def with_nodes(self, around: int, along: int) -> Self:
        """Return the clearance with so many nodes, or with its own where those are fewer."""
        fewer = {
            "nodes_around": min(self.nodes_around or around, around),
            "nodes_along": min(self.nodes_along or along, along),
        }
        return self.model_copy(update=fewer)


class _Joint(NamedGroup):
    """The keys of joints of all types."""

    type: str = choice(
        None,
        "what it lets move",
        family="tribodyn.mechanism.joints:JOINTS",
        example="revolute",
        required=True,
    )
    between: tuple[str, str] = names("the two bodies, or ground", length=2, example='["ground", "crank"]')
    point: Vector = vector(None, "position of the joint", unit="mm", example=POINT, required=True)
    other_point: Vector | None = vector(
        None, "position on the second body, if the model has a gap to be closed", unit="mm", example=POINT
    )
    deviation: Vector = vector(
        "0, 0, 0 mm",
        "how far it is made off point on the first body; not so in the ideal counterpart",
        "assumed",
        unit="mm",
    )
    tilt: Vector = vector(
        "0, 0, 0 deg",
        "small turns about x, y and z by which its axes are made off on the first body; not so in the ideal "
        "counterpart",
        "assumed",
        unit="deg",
    )
    axis: Vector | None = vector(
        None,
        "its direction, of any length; of the race of a ball joint with clearance, without it "
        "normal to the plane of the joint and the mass centres of both bodies",
        example="[0, 0, 1]",
    )
    second_axis: Vector | None = vector(
        None, "the other one of a universal joint; the direction of angle zero of others", example="[1, 0, 0]"
    )
    start_speed: float | None = quantity(
        None,
        "angular speed at the start, where nothing drives it; without it that of least kinetic energy",
        unit="rpm",
        example="100 rpm",
    )
    start_velocity: float | None = quantity(
        None,
        "speed along the axis at the start, where nothing drives it; without it that of least kinetic energy",
        unit="m/s",
        example="1 m/s",
    )


if TYPE_CHECKING:
    _OfAllTypes = _Joint
else:
    _OfAllTypes = with_own_keys(_Joint, JOINTS.values())


class JointKeys(_OfAllTypes):
    """A joint of two bodies."""

    clearance: ClearanceKeys | None = None
    film: FilmKeys | None = None

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        # A type that counts as zero is refused as such, by the check of its family.
        if self.type not in JOINTS:
            return
        demand(self.between[0] != self.between[1], "between", "a joint connects two different bodies")
        self._check_axes()
        self._check_own()
        self._check_clearance()
        if self.film is not None:
            check_film(self)

    def _check_axes(self) -> None:
        kind = self.kind
        words = f"{self.kind.named} needs the {kind.AXIS}, such as axis = [0, 0, 1]"
        demand(not kind.AXIS or self.axis is not None, "axis", words)
        words = f"{self.kind.named} needs the {kind.SECOND_AXIS}, such as second_axis = [1, 0, 0]"
        demand(not kind.SECOND_AXIS or self.second_axis is not None, "second_axis", words)
        for first, second in combinations(("axis", "second_axis"), 2):
            _check_directions(getattr(self, first), getattr(self, second))
        for key, coordinate in (("start_speed", "angle"), ("start_velocity", "position")):
            words = f"{self.kind.named} has no {coordinate} of its own"
            demand(getattr(self, key) is None or coordinate in kind.COORDINATES, key, words)
        words = f"{kind.named} without a clearance holds no direction that could be off: leave it out"
        demand(kind.ROWS != AT_POINT or self.clearance is not None or not any(self.tilt), "tilt", words)
        words = "a tilt is of tolerances, at most 10 deg: draw the joint along another axis"
        demand(math.hypot(*self.tilt) <= _MOST_TILT, "tilt", words)

    def _check_own(self) -> None:
        """Check the keys of single types."""
        for kind, key in foreign_keys(self, self.kind, JOINTS.values()):
            demand(False, key, f"this belongs to a {kind.NAME}, not {self.kind.named}")
        self.kind.check(self)

    def _check_clearance(self) -> None:
        clearance = self.clearance
        if clearance is None:
            return
        shapes = shapes_of(self.kind)
        real = ", ".join(name for name, kind in JOINTS.items() if kind.SHAPE)
        words = f"{self.kind.named} is always ideal; clearance is for: {real}"
        demand(bool(shapes), "clearance.radial", words)
        shape = self.shape
        words = f"{self.kind.named} has the shape {' or '.join(shapes)}"
        demand(shape in shapes, "clearance.shape", words)
        about = SHAPES[shape]
        for key, size in about.NEEDED.items():
            words = f"a joint of the shape {shape} needs {size}"
            demand(getattr(clearance, key) is not None, f"clearance.{key}", words)
        for kind, key in foreign_keys(clearance, about, SHAPES.values()):
            demand(False, f"clearance.{key}", f"this belongs to the shape {kind.NAME}, not to {shape}")
        words = f"a form is that of a shaft in a bore, not of the shape {shape}"
        demand(about.BORE or clearance.form == FormKeys(), "clearance.form", words)
        about.check(self.kind, clearance)
        words = f"a bonded sleeve is that of a shaft in a bore, not of the shape {shape}"
        bonded = clearance.temperature.fit == "bonded"
        demand(about.BORE or not bonded, "clearance.temperature.fit", words)
        words = f"this is neither {self.between[0]} nor {self.between[1]}"
        demand(clearance.socket in (None, *self.between), "clearance.socket", words)

    @property
    def kind(self) -> JointType:
        """Its type."""
        return JOINTS[self.type]

    @property
    def real(self) -> ClearanceKeys | None:
        """Its clearance, if it is not ideal."""
        return None if self.clearance is None or self.clearance.ideal else self.clearance

    @property
    def ideal(self) -> str:
        """Type of the ideal joint that it becomes as its clearance vanishes."""
        return SHAPES[self.shape].ideal(self.type, self.clearance)

    @property
    def sign(self) -> float:
        """−1 where the second body carries the socket, so that its motion is against that of the shaft."""
        return -1.0 if self.real is not None and self.real.socket == self.between[1] else 1.0

    @property
    def points(self) -> tuple[Vector, Vector]:
        """Places on the first and on the second body, as in the model [m]."""
        (x, y, z), off, other = self.point, self.deviation, self.other_point or self.point
        return (x + off[0], y + off[1], z + off[2]) if any(off) else self.point, other

    @property
    def off_drawing(self) -> list[str]:
        """The keys by which it is made off the drawing."""
        return [key for key in OFF_DRAWING if any(getattr(self, key))]

    @property
    def shape(self) -> str:
        """Shape of its clearance."""
        chosen = None if self.clearance is None else self.clearance.shape
        return chosen or self.kind.SHAPE


class SpringKeys(NamedGroup):
    """A spring and damper between two points."""

    between: tuple[str, str] = names("the two bodies, or ground", length=2, example='["ground", "rod"]')
    first_point: Vector = vector(
        None, "position of its end on the first body", unit="mm", example=POINT, required=True
    )
    second_point: Vector = vector(
        None, "position of its end on the second body", unit="mm", example=POINT, required=True
    )
    stiffness: float = quantity("0 N/mm", "force over elongation", "assumed", ge=0, example="2 N/mm")
    damping: float = quantity("0 N s/m", "force over speed", "assumed", ge=0, example="5 N s/m")
    length: float | None = quantity(
        None, "length without force; by default the distance of its ends", ge=0, example="80 mm"
    )

    def model_post_init(self, context: object, /) -> None:
        """Check two keys against each other."""
        demand(self.between[0] != self.between[1], "between", "a spring connects two different bodies")
        demand(self.drawn_length > 0.0, "second_point", "the two ends of a spring must stand apart")

    @property
    def points(self) -> tuple[Vector, Vector]:
        """Its ends as drawn [m]."""
        return self.first_point, self.second_point

    @property
    def drawn_length(self) -> float:
        """Length in the drawing [m]."""
        return math.dist(*self.points)


def _check_directions(axis: Vector | None, second: Vector | None) -> None:
    if axis is not None:
        unit(axis, "axis")
    if axis is None or second is None:
        return
    parallel = abs(dot(unit(axis, "axis"), unit(second, "second_axis")))
    demand(parallel < math.sqrt(1.0 - _LEAST_ANGLE**2), "second_axis", "it must not be parallel to axis")
