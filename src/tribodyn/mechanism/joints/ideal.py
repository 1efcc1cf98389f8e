"""Joints that are only their constraint equations: lower pairs, a ball on a pin, universal, rigid.

Its disc slides across one shaft in one direction and across the other in another. Without the mass of the
disc it leaves the two displacements across the axis free and transmits the torque.
"""

from typing import ClassVar

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels.mechanism.data import DIRECTION
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.joints.joint_type import ALIGNED, AT_POINT, NO_TURN, ON_AXIS, JointType, Row


class Fixed(JointType):
    """Two bodies in one piece."""

    NAME: ClassVar[str] = "fixed"
    MEANING: ClassVar[str] = "nothing moves"
    ROWS: ClassVar[tuple[Row, ...]] = (*AT_POINT, *ALIGNED, NO_TURN)


class Revolute(JointType):
    """A hinge."""

    NAME: ClassVar[str] = "revolute"
    MEANING: ClassVar[str] = "turns about `axis`"
    ROWS: ClassVar[tuple[Row, ...]] = (*AT_POINT, *ALIGNED)
    AXIS: ClassVar[str] = "axis"
    COORDINATES: ClassVar[tuple[str, ...]] = ("angle",)
    SHAPE: ClassVar[str] = "cylinder"
    FACES: ClassVar[bool] = True
    CLEARANCE: ClassVar[str] = "pin in a bore, with end faces where `axial` is given"


class Spherical(JointType):
    """A ball joint."""

    NAME: ClassVar[str] = "spherical"
    MEANING: ClassVar[str] = "turns about `point`"
    ROWS: ClassVar[tuple[Row, ...]] = AT_POINT
    SHAPE: ClassVar[str] = "sphere"
    CLEARANCE: ClassVar[str] = "ball in a race around `axis`"


class Cylindrical(JointType):
    """A pin that turns and slides in a sleeve."""

    NAME: ClassVar[str] = "cylindrical"
    MEANING: ClassVar[str] = "turns about and slides along `axis`"
    ROWS: ClassVar[tuple[Row, ...]] = (*ON_AXIS, *ALIGNED)
    AXIS: ClassVar[str] = "axis"
    COORDINATES: ClassVar[tuple[str, ...]] = ("angle", "position")
    SHAPE: ClassVar[str] = "cylinder"
    CLEARANCE: ClassVar[str] = "pin in a bore"


class Prismatic(JointType):
    """A slide."""

    NAME: ClassVar[str] = "prismatic"
    MEANING: ClassVar[str] = "slides along `axis`"
    ROWS: ClassVar[tuple[Row, ...]] = (*ON_AXIS, *ALIGNED, NO_TURN)
    AXIS: ClassVar[str] = "axis"
    COORDINATES: ClassVar[tuple[str, ...]] = ("position",)
    SHAPE: ClassVar[str] = "square"
    CLEARANCE: ClassVar[str] = (
        'block in a channel; `shape = "dovetail"`, or `"cylinder"` for a round bar, which also turns'
    )


class PinSlot(JointType):
    """A ball of the second body on a pin of the first."""

    NAME: ClassVar[str] = "pin-slot"
    MEANING: ClassVar[str] = "a ball of the second body slides along a pin of the first"
    ROWS: ClassVar[tuple[Row, ...]] = ON_AXIS
    AXIS: ClassVar[str] = "axis of the pin"
    COORDINATES: ClassVar[tuple[str, ...]] = ("position",)
    SHAPE: ClassVar[str] = "ball"
    CLEARANCE: ClassVar[str] = 'ball in a bore; `shape = "cylinder"` for a pin that does not tilt in it'


class Slotted(JointType):
    """A round pin of the second body in a slot of the first."""

    NAME: ClassVar[str] = "slot"
    MEANING: ClassVar[str] = (
        "a pin of the second body, along `second_axis`, slides along `axis` between flat walls"
    )
    ROWS: ClassVar[tuple[Row, ...]] = (AT_POINT[1], (DIRECTION, 1, 0))
    AXIS: ClassVar[str] = "direction of the slot"
    SECOND_AXIS: ClassVar[str] = "axis of the pin"
    COORDINATES: ClassVar[tuple[str, ...]] = ("position",)
    SHAPE: ClassVar[str] = "slot"
    CLEARANCE: ClassVar[str] = "pin between two flat walls"


class Planar(JointType):
    """A plate on a plane."""

    NAME: ClassVar[str] = "planar"
    MEANING: ClassVar[str] = "slides and turns across `axis`"
    ROWS: ClassVar[tuple[Row, ...]] = (AT_POINT[2], *ALIGNED)
    AXIS: ClassVar[str] = "normal of the plane"
    COORDINATES: ClassVar[tuple[str, ...]] = ("angle",)


class Universal(JointType):
    """A cross of two axes."""

    NAME: ClassVar[str] = "universal"
    MEANING: ClassVar[str] = (
        "turns about `axis`, held by the first body, and `second_axis`, held by the second"
    )
    ROWS: ClassVar[tuple[Row, ...]] = (*AT_POINT, (DIRECTION, 2, 0))
    AXIS: ClassVar[str] = "axis"
    SECOND_AXIS: ClassVar[str] = "axis that the second body holds"

    def shaft_axes(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the axes of the second body: x is the axis that it holds."""
        across = frame(second, first)
        return np.column_stack([across[:, 2], -across[:, 1], across[:, 0]])


class Oldham(JointType):
    """A coupling of parallel shafts."""

    NAME: ClassVar[str] = "oldham"
    MEANING: ClassVar[str] = "slides across `axis` and does not turn"
    ROWS: ClassVar[tuple[Row, ...]] = (AT_POINT[2], *ALIGNED, NO_TURN)
    AXIS: ClassVar[str] = "axis of the shafts"
