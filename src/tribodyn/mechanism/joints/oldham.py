"""Oldham coupling: two shafts stay parallel and turn alike, whatever the distance between their axes.

Its disc slides across one shaft in one direction and across the other in another. Without the mass of the
disc it leaves the two displacements across the axis free and transmits the torque.
"""

from typing import ClassVar

from tribodyn.mechanism.joints.joint_type import ALIGNED, AT_POINT, NO_TURN, JointType, Row


class Oldham(JointType):
    """A coupling of parallel shafts."""

    NAME: ClassVar[str] = "oldham"
    MEANING: ClassVar[str] = "slides across `axis` and does not turn"
    ROWS: ClassVar[tuple[Row, ...]] = (AT_POINT[2], *ALIGNED, NO_TURN)
    AXIS: ClassVar[str] = "axis of the shafts"
