"""Common parts of the kinds of elements.

The equation of an element is a sum over *legs*,

    Σ (b·d + a θ) = constant  [m].

A leg is the motion of one body against another: the displacement d of its origin and the angle θ about its z
axis. The multiplier of the equation is a force λ [N]: a leg applies the force λ b and the moment λ a about z
to its second body, and the opposite to its first. A leg may also count the distance |d|, or the length of the
path of its origin; the force then acts along d, or along the velocity.

An element with a force law says what λ is, as a function of the sum q and its rate, and holds nothing.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Final, Literal, Self

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import NamedGroup, demand, unit
from tribodyn.cases.fields import Vector, name, names, quantity, vector
from tribodyn.cases.signals import ForceSignal, TorqueSignal
from tribodyn.core.signals import Signal
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.law import LawFunction
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.model.parts import POINT, JointKeys

PARALLEL: Final = 1.0e-6  #: Sine of the angle between two axes up to which they count as parallel.
_SIZE: Final = 0.1  #: Length [m] by which angles become lengths where all joints are at one point.

ARM: Final = """
case = "mechanism"
run.duration = "50 ms"
[bodies]
arm = { mass = "1 kg", centre = "0, 0, 0 mm", inertia = "3e-3, 3e-3, 5e-3 kg m^2" }
[joints]
input = { type = "revolute", between = ["ground", "arm"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
"""
#: Begin and end of a case file: examples of elements put their table between.
DRIVE: Final = """[drives.motor]
joint = "input"
torque = "0.2 N m"
"""

Joints = Mapping[str, JointKeys]  #: The joints of a case by their names.
#: A line: bodies, with the points as drawn that each carries [m], shape (n, 3).
Outline = tuple[tuple[str, FloatArray], ...]


@dataclass(frozen=True)
class Leg:
    """One term of the equation of an element."""

    bodies: tuple[str, str]  #: Names of the two bodies.
    points: FloatArray  #: Origin as drawn on the first and on the second body [m], shape (2, 3).
    axes: FloatArray  #: Columns x, y, z in the drawing, fixed to the first body, shape (3, 3).
    along: FloatArray  #: Coefficients b of the displacement [1], in these axes, shape (3,).
    about: float  #: Coefficient a of the angle about z [m/rad], or [1] where λ is a moment.
    #: ``coordinate`` for b·d + a θ, ``distance``, or ``path`` (for force laws).
    measure: Literal["coordinate", "distance", "path"] = "coordinate"
    length: float = 0.0  #: Distance that counts as zero [m].
    #: Direction of the force that results hold, in the same axes, shape (3,); None for that of ``along``.
    reported: FloatArray | None = None
    #: Force on the second body in the same axes over |λ|, beside that of λ, shape (3,); None for none.
    push: FloatArray | None = None
    tilt: Vector = (0.0, 0.0, 0.0)  #: Rotation vector by which these axes are off on the first body [rad].


@dataclass(frozen=True)
class ForceLaw:
    """Meaning of an element's multiplier."""

    function: LawFunction  #: A function with the decorator ``force_law``.
    parameters: Mapping[str, float]  #: Values of all parameters that it reads, and of others, by their names.
    table: Signal | None = None  #: A function of the coordinate, which the law finds evaluated.
    over_rate: bool = False  #: Whether it is a function of the rate of the coordinate instead.
    #: Ideal joint whose reaction across its axis the law finds as ``normal``; empty for none.
    load_of: str = ""
    #: Leg of the first equation of the same element whose force across its z is ``normal``; None for none.
    load_leg: int | None = None


@dataclass(frozen=True)
class Equation:
    """Statement of an element on the sum over some legs: that it is constant, or the force along it."""

    legs: tuple[Leg, ...]
    law: ForceLaw | None


def leg(
    bodies: tuple[str, str], points: FloatArray, axis: FloatArray, along: FloatArray, about: float
) -> Leg:
    """Return a leg about an axis; ``axis`` and ``along`` in the drawing, shape (3,)."""
    axes = frame(axis, np.zeros(3))
    return Leg(bodies, points, axes, dense.product(axes.T, along), about)


def of_points(
    bodies: tuple[str, str], points: FloatArray, measure: Literal["distance", "path"], length: float = 0.0
) -> Leg:
    """Return a leg that counts the distance between points as drawn (2, 3), or the path of the second."""
    return Leg(bodies, points, np.eye(3), np.zeros(3), 0.0, measure, length)


class ElementKeys(NamedGroup):
    """Base of the keys of an element; a member says all that is to be known of its kind."""

    TABLE: ClassVar[str]  #: Table of a case file that holds elements of this kind.
    METHOD: ClassVar[str]  #: Method of the builder that adds one.
    #: What the force and the moment are that results hold.
    FORCE: ClassVar[str]
    MOMENT: ClassVar[str]
    MOMENT_OF: ClassVar[int] = 0  #: Leg whose moment that is.
    #: A complete case file with one element of this kind, which holds for tests of all kinds.
    EXAMPLE: ClassVar[str]
    LAW: ClassVar[LawFunction | None] = None  #: Force law, see :class:`ForceLaw`; None for a constraint.
    IS_SPRING: ClassVar[bool] = False  #: Whether its outline is drawn as a coil.
    IS_DRIVE: ClassVar[bool] = False  #: Whether it gives the moment or force of its joint as a drive does.

    @property
    def named_joints(self) -> dict[str, tuple[str, ...]]:
        """The joints that it names, by key."""
        return _named(self, ("joints", "joint"))

    @property
    def named_bodies(self) -> dict[str, tuple[str, ...]]:
        """The bodies that it names, by key."""
        return _named(self, ("between", "body"))

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the legs of the equation; refuse joints that do not fit.

        Raises InputError with the reason; its key is the one of this table.
        """
        raise NotImplementedError

    def force_law(self, joints: Joints) -> ForceLaw | None:
        """Return the force law: its parameters are the keys that are numbers, its table that of these keys.

        None for a constraint.
        """
        law = type(self).LAW
        if law is None:
            return None
        table = next(
            (value.curve() for _, value in self if isinstance(value, ForceSignal | TorqueSignal)), None
        )
        return ForceLaw(law, {key: value for key, value in self if isinstance(value, float)}, table)

    @property
    def has_play(self) -> bool:
        """Whether it has play that the ideal counterpart of the mechanism has not; by default it has none."""
        return False

    @property
    def without_play(self) -> Self:
        """The element in the ideal counterpart of the mechanism; by default itself."""
        return self

    @property
    def without_friction(self) -> Self:
        """The element without friction but for its viscous part; by default itself."""
        return self

    def check_run(self, duration: float, *, dynamic: bool, campaign: bool) -> None:
        """Refuse a run over some time [s] that does not suit the element; by default none is refused."""

    def equations(self, joints: Joints) -> tuple[Equation, ...]:
        """Return the equations: one, unless a member says otherwise."""
        return (Equation(self.legs(joints), self.force_law(joints)),)

    def outlines(self, joints: Joints) -> Iterable[Outline]:
        """Return lines that show the element."""
        return ()


class PointsKeys(ElementKeys):
    """Base of the keys of an element between two points."""

    between: tuple[str, str] = names("the two bodies, or ground", length=2, example='["ground", "rod"]')
    first_point: Vector = vector(
        None, "position of its end on the first body", unit="mm", example=POINT, required=True
    )
    second_point: Vector = vector(
        None, "position of its end on the second body", unit="mm", example=POINT, required=True
    )
    length: float | None = quantity(
        None, "its length without force; by default the distance of its ends", ge=0, example="80 mm"
    )

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg from the first point to the second."""
        demand(self.between[0] != self.between[1], "between", "this is twice the same body; name two bodies")
        points = np.array([self.first_point, self.second_point])
        drawn = float(dense.norm(points[1] - points[0]))
        demand(drawn > 0.0, "second_point", "both ends are at one point; draw them apart")
        return (of_points(self.between, points, "distance", drawn if self.length is None else self.length),)

    def outlines(self, joints: Joints) -> Iterable[Outline]:
        """Return the line between its ends."""
        (first, second), ends = self.between, np.array([self.first_point, self.second_point])
        yield (first, ends[:1]), (second, ends[1:])


class OfJointKeys(ElementKeys):
    """Base of the keys of an element at the coordinate of one joint: of its second body against the first."""

    joint: str = name(None, "the joint it acts in", example="hinge", required=True)

    def leg_of(self, joints: Joints, coordinate: str, member: str, scale: float = 1.0) -> Leg:
        """Return the leg of an angle, times a scale, or of a position, as drawn zero."""
        joint = joints[self.joint]
        free = joint.kind.COORDINATES
        words = f"{self.joint} is {joint.kind.named}; {member} takes a joint with {article(coordinate)}"
        demand(coordinate in free, "joint", words)
        axis, turns = axis_of(joint), coordinate == "angle"
        points = origin(joint, joint.between[0])
        along = np.zeros(3) if turns else scale * axis
        return replace(leg(joint.between, points, axis, along, scale if turns else 0.0), tilt=joint.tilt)


def article(coordinate: str) -> str:
    """Return the name of a coordinate with its article."""
    return {"angle": "an angle", "position": "a position"}[coordinate]


def _named(keys: ElementKeys, fields: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """Return the names that these keys hold, as far as there are such keys."""
    found = {key: getattr(keys, key, None) for key in fields}
    return {key: (name,) if isinstance(name, str) else tuple(name) for key, name in found.items() if name}


def require_type(name: str, joint: JointKeys, kinds: Iterable[str], member: str) -> None:
    """Refuse a joint that is of none of these types."""
    allowed = " or ".join(kinds)
    demand(joint.type in kinds, "joints", f"{name} is {joint.kind.named}; {member} takes {allowed} joints")


def carrier(names: tuple[str, str], joints: Joints) -> str:
    """Return the body that two joints share: the one that carries both other bodies."""
    first, second = names
    demand(first != second, "joints", f"this is twice the joint {first}; name two joints")
    shared = set(joints[first].between) & set(joints[second].between)
    words = f"{first} and {second} share no body; both must join a body to the one that carries them"
    demand(bool(shared), "joints", words)
    words = f"{first} and {second} join the same two bodies; name joints of two bodies to a third"
    demand(len(shared) == 1, "joints", words)
    return shared.pop()


def other_body(joint: JointKeys, body: str) -> str:
    """Return the body that a joint joins to this one."""
    return joint.between[1 - joint.between.index(body)]


def origin(joint: JointKeys, body: str) -> FloatArray:
    """Return the point of a joint as drawn on this body, and on the other one [m], shape (2, 3)."""
    points = np.array(joint.points)
    return points if joint.between[0] == body else points[::-1]


def axis_of(joint: JointKeys) -> FloatArray:
    """Return the unit vector along the axis of a joint, shape (3,)."""
    return np.array(unit(joint.axis or (0.0, 0.0, 1.0), "axis"))


def are_parallel(first: FloatArray, second: FloatArray) -> bool:
    """Tell whether two axes are parallel, in whichever sense."""
    return float(dense.norm(np.cross(first, second))) < PARALLEL


def size_of(joints: Joints) -> float:
    """Return the distance over which joints are spread [m]."""
    points = np.array([joint.point for joint in joints.values()])
    return float(dense.norm(np.ptp(points, axis=0))) or _SIZE


def circle(centre: FloatArray, axis: FloatArray, radius: float) -> FloatArray:
    """Return points of a closed circle [m], shape (n, 3)."""
    axes, turn = frame(axis, np.zeros(3)), np.linspace(0.0, 2.0 * np.pi, 49)
    return np.asarray(
        centre
        + radius * (np.outer(portable.cos(turn), axes[:, 0]) + np.outer(portable.sin(turn), axes[:, 1]))
    )
