"""What a mechanism is made of, in SI units and in one drawing with global coordinates.

A case file and the builder of :mod:`tribodyn` both end here; assembly and equations begin here. Bodies are
counted from 0, ``GROUND`` is the body that never moves.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from tribodyn.contact import Liner
from tribodyn.contact.base import ContactLaw
from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal
from tribodyn.core.tables import ContactTable
from tribodyn.joints.form import Form
from tribodyn.mechanisms.general.elements.base import ElementKeys, Leg

GROUND: Final = -1
"""Number of the body that never moves."""


@dataclass(frozen=True)
class Body:
    """A rigid body as drawn.

    Attributes
    ----------
    name
        Its name, unique.
    mass
        [kg], above zero.
    centre
        Mass centre in the drawing [m], shape (3,).
    inertia
        About the mass centre, along the global axes of the drawing [kg m²], shape (3, 3).
    """

    name: str
    mass: float
    centre: FloatArray
    inertia: FloatArray


@dataclass(frozen=True)
class Clearance:
    """What makes an ideal joint a real one: two surfaces and what acts between them.

    Attributes
    ----------
    shape
        A name of ``joints.SHAPES``: ``cylinder``, ``annulus``, ``sphere`` or ``mesh``; a revolute joint with
        end faces is a ``cylinder`` and two faces.
    sizes
        Its dimensions by name [m], for example ``radius``, ``radial``, ``length``, ``axial``.
    grid
        Nodes along the two directions of the shape.
    roughness
        Combined rms roughness σ [m].
    law, table
        Contact law, and the same tabulated.
    liner
        What the asperities stand on; None where that is rigid.
    friction_coefficient, slip_velocity
        μ and its regularisation u_s [m/s].
    onset, minimum_velocity, tensile_clip
        See ``joints.EntryMemory``.
    contact
        ``surface``, or a point contact of ``joints.CONTACTS``.
    facets
        Triangles of a ``mesh`` in the socket's frame [m], shape (n, 3, 3); of no length for other shapes.
    form
        What a ``cylinder`` stands back from one.
    slides
        Whether the shaft is meant to slide along its axis, however far.
    """

    shape: str
    sizes: dict[str, float]
    grid: tuple[int, int]
    roughness: float
    law: ContactLaw
    table: ContactTable
    friction_coefficient: float
    slip_velocity: float
    onset: float
    minimum_velocity: float
    tensile_clip: bool
    contact: str
    facets: FloatArray
    form: Form = field(default_factory=Form)
    liner: Liner | None = None
    slides: bool = False


@dataclass(frozen=True)
class Joint:
    """A connection of two bodies as drawn.

    Attributes
    ----------
    name
        Its name, unique.
    kind
        ``fixed``, ``revolute``, ``spherical``, ``cylindrical``, ``prismatic``, ``universal``, ``pin-slot``,
        ``planar`` or ``spring-damper``.
    bodies
        Numbers of the two bodies, ``GROUND`` for the ground.
    points
        Where the joint is, as drawn on the first and on the second body [m], shape (2, 3): the same point
        unless the drawing has a gap that assembly is to close.
    axes
        Unit vectors in the drawing, shape (2, 3): the axis of a revolute, cylindrical, prismatic joint or
        slot, the normal of a planar one; the second is the other axis of a universal joint, fixed to the
        second body, and a direction of angle zero elsewhere.
    clearance
        None for an ideal joint.
    stiffness, damping
        Of a ``spring-damper``, along and about (axis, second axis, their cross product): [N/m] and [N m/rad],
        [N s/m] and [N m s/rad], shape (6,); of no length for others.
    socket
        Which of the two bodies carries the socket, in whose axes the joint is described: 0 or 1.
    """

    name: str
    kind: str
    bodies: tuple[int, int]
    points: FloatArray
    axes: FloatArray
    clearance: Clearance | None
    stiffness: FloatArray
    damping: FloatArray
    socket: int = 0

    @property
    def sign(self) -> float:
        """−1 where the second body carries the socket, so that its motion is against that of the shaft."""
        return -1.0 if self.socket == 1 else 1.0


@dataclass(frozen=True)
class Drive:
    """What moves the mechanism, at the free coordinate of a joint.

    Attributes
    ----------
    name
        Its name.
    joint
        Number of the joint: a revolute one turns, a prismatic one slides; of a cylindrical one ``coordinate``
        says which.
    coordinate
        ``angle`` or ``position``.
    level
        What is given: ``0`` the coordinate itself, ``1`` its speed, ``2`` the torque or force that acts along
        it.
    signal
        Over time.
    """

    name: str
    joint: int
    coordinate: str
    level: int
    signal: Signal


@dataclass(frozen=True)
class Load:
    """A force and a moment on a body.

    Attributes
    ----------
    name
        Its name.
    body
        Its number.
    point
        Where the force acts, as drawn [m], shape (3,).
    frame
        ``ground``: the components are global. ``body``: they turn with the body. ``motion``: the first is the
        size of a force against the velocity of the point, the fourth that of a moment against the angular
        velocity. ``line``: force and moment, global, act along a line each, against the velocity along it.
    signals
        Force [N] and moment [N m], six components.
    joint
        Number of the joint whose coordinate the signals follow; −1 for time.
    slip_velocity
        For ``motion`` and ``line``: speed [m/s], or [rad/s], below which the force grows in proportion.
    """

    name: str
    body: int
    point: FloatArray
    frame: str
    signals: tuple[Signal, ...]
    joint: int
    slip_velocity: float


@dataclass(frozen=True)
class Spring:
    """A spring and damper between two points.

    Attributes
    ----------
    name
        Its name.
    bodies
        Numbers of the two bodies.
    points
        Its ends as drawn [m], shape (2, 3).
    stiffness, damping
        [N/m], [N s/m].
    length
        Length without force [m].
    """

    name: str
    bodies: tuple[int, int]
    points: FloatArray
    stiffness: float
    damping: float
    length: float


@dataclass(frozen=True)
class Element:
    """A gear pair or another element whose constraint equation couples coordinates of joints.

    Attributes
    ----------
    name
        Its name, unique among all elements.
    kind
        A member of ``elements.ELEMENTS``.
    legs
        Terms of its equation.
    """

    name: str
    kind: type[ElementKeys]
    legs: tuple[Leg, ...]


@dataclass(frozen=True)
class Description:
    """A mechanism as drawn, with how fast it moves at the start.

    Attributes
    ----------
    bodies, joints, drives, loads, springs, elements
        Its parts.
    gravity
        [m/s²], shape (3,).
    speeds
        Speeds of free coordinates at the start, as (joint, coordinate, value in [rad/s] or [m/s]); see
        :mod:`tribodyn.mechanisms.general.speeds` for other freedoms.
    """

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    drives: tuple[Drive, ...]
    loads: tuple[Load, ...]
    springs: tuple[Spring, ...]
    gravity: FloatArray
    speeds: tuple[tuple[int, str, float], ...]
    elements: tuple[Element, ...] = ()

    @property
    def first_leg(self) -> int:
        """Number of the coupling that is the first leg of the first element: all legs come last."""
        return len(self.joints) + len(self.springs) + len(self.loads)

    def element_of(self, coupling: int) -> Element:
        """Return the element whose leg a coupling is."""
        return [element for element in self.elements for _ in element.legs][coupling - self.first_leg]

    def constraint(self, coupling: int) -> tuple[str, tuple[int, ...]]:
        """Return what a constraint equation of a coupling belongs to, ``joint NAME``, and its bodies."""
        if coupling < len(self.joints):
            joint = self.joints[coupling]
            return f"joint {joint.name}", joint.bodies
        element = self.element_of(coupling)
        names = dict.fromkeys(name for leg in element.legs for name in leg.bodies)
        return f"{element.kind.METHOD} {element.name}", tuple(number_of(self, name) for name in names)


def number_of(description: Description, name: str) -> int:
    """Return the number of a body by its name."""
    numbers = {body.name: number for number, body in enumerate(description.bodies)}
    return numbers.get(name, GROUND)


def name_of(description: Description, body: int) -> str:
    """Return the name of a body."""
    return "ground" if body == GROUND else description.bodies[body].name
