"""Torsion spring and damper at the angle of a joint, linear or by a table; the law of a nonlinear spring."""

from typing import ClassVar

from tribodyn.cases.case import demand
from tribodyn.cases.fields import quantity
from tribodyn.cases.signals import TorqueSignal
from tribodyn.mechanism.elements.element import ARM, DRIVE, Joints, Leg, OfJointKeys
from tribodyn.mechanism.elements.nonlinear_spring import elastic


class TorsionSpring(OfJointKeys):
    """A torsion spring and damper at the angle of a joint: preload, stiffness and a table of its torque."""

    TABLE: ClassVar[str] = "torsion_springs"
    METHOD: ClassVar[str] = "torsion_spring"
    FORCE: ClassVar[str] = "none"
    MOMENT: ClassVar[str] = "torque on the second body of the joint, about its axis"
    LAW: ClassVar = elastic
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[torsion_springs.coil]
joint = "input"
preload = "0.1 N m"
stiffness = "2 N m/rad"
damping = "0.02 N m s/rad"
torque = { angles = "-60, -20, 20, 60 deg", values = "-3, -0.5, 0.5, 3 N m" }
"""
        + DRIVE
    )

    preload: float = quantity(
        "0 N m",
        "torque at angle 0 against a growing angle; below zero it makes the angle grow",
        "assumed",
        example="2 N m",
    )
    stiffness: float = quantity("0 N m/rad", "torque over angle", "assumed", ge=0, example="5 N m/rad")
    damping: float = quantity("0 N m s/rad", "torque over its rate", "assumed", ge=0, example="1 N m s/rad")
    torque: TorqueSignal | None = None

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg of the angle."""
        words = (
            "a torsion spring needs a stiffness, a preload, a damping or a table of its torque over angles"
        )
        demand(bool(self.stiffness or self.preload or self.damping or self.torque), "stiffness", words)
        over = None if self.torque is None else self.torque.over
        demand(over in (None, "angles"), "torque", "the table of a torsion spring is one over angles")
        return (self.leg_of(joints, "angle", "a torsion spring"),)
