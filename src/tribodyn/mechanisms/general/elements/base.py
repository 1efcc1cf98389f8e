"""What the kinds of elements have in common.

The equation of an element is a sum over *legs*,

    Σ (b·d + a θ) = constant  [m].

A leg is the motion of one body against another: the displacement d of its origin and the angle θ about its z
axis. The multiplier of the equation is a force λ [N]: a leg applies the force λ b and the moment λ a about z
to its second body, and the opposite to its first.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.directions import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.general.joints import frame
from tribodyn.mechanisms.general.parts import JointKeys

PARALLEL: Final = 1.0e-6
"""Sine of the angle between two axes up to which they count as parallel."""
_SIZE: Final = 0.1
"""Length [m] by which angles become lengths where all joints are at one point."""

Joints = Mapping[str, JointKeys]
"""The joints of a case by their names."""


@dataclass(frozen=True)
class Leg:
    """One term of the equation of an element.

    Attributes
    ----------
    bodies
        Names of the two bodies.
    points
        Origin as drawn on the first and on the second body [m], shape (2, 3).
    axes
        Columns x, y, z in the drawing, fixed to the first body, shape (3, 3).
    along
        Coefficients b of the displacement [1], in these axes, shape (3,).
    about
        Coefficient a of the angle about z [m/rad].
    """

    bodies: tuple[str, str]
    points: FloatArray
    axes: FloatArray
    along: FloatArray
    about: float


def leg(
    bodies: tuple[str, str], points: FloatArray, axis: FloatArray, along: FloatArray, about: float
) -> Leg:
    """Return a leg about an axis; ``axis`` and ``along`` in the drawing, shape (3,)."""
    axes = frame(axis, np.zeros(3))
    return Leg(bodies, points, axes, axes.T @ along, about)


class ElementKeys(NamedGroup):
    """Base of the keys of an element; a member says all that is to be known of its kind.

    Attributes
    ----------
    TABLE
        Table of a case file that holds elements of this kind.
    METHOD
        Method of the builder that adds one.
    FORCE, MOMENT
        What the force and the moment are that results hold.
    MOMENT_OF
        Leg whose moment that is.
    EXAMPLE
        A complete case file with one element of this kind, which holds for tests of all kinds.
    """

    TABLE: ClassVar[str]
    METHOD: ClassVar[str]
    FORCE: ClassVar[str]
    MOMENT: ClassVar[str]
    MOMENT_OF: ClassVar[int]
    EXAMPLE: ClassVar[str]

    joints: tuple[str, ...]

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the legs of the equation; refuse joints that do not fit.

        Raises
        ------
        InputError
            With the reason; its key is the one of this table.
        """
        raise NotImplementedError

    def outlines(self, joints: Joints) -> Iterable[tuple[str, FloatArray]]:
        """Return lines that show the element: a body, and points as drawn that it carries [m], (n, 3)."""
        return ()


def require_type(name: str, joint: JointKeys, kinds: Iterable[str], member: str) -> None:
    """Refuse a joint that is of none of these types."""
    allowed = " or ".join(kinds)
    demand(joint.type in kinds, "joints", f"{name} is a {joint.type} joint; {member} takes {allowed} joints")


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
    return float(np.linalg.norm(np.cross(first, second))) < PARALLEL


def size_of(joints: Joints) -> float:
    """Return the distance over which joints are spread [m]."""
    points = np.array([joint.point for joint in joints.values()])
    return float(np.linalg.norm(np.ptp(points, axis=0))) or _SIZE


def circle(centre: FloatArray, axis: FloatArray, radius: float) -> FloatArray:
    """Return points of a closed circle [m], shape (n, 3)."""
    axes, turn = frame(axis, np.zeros(3)), np.linspace(0.0, 2.0 * np.pi, 49)
    return np.asarray(
        centre + radius * (np.outer(np.cos(turn), axes[:, 0]) + np.outer(np.sin(turn), axes[:, 1]))
    )
