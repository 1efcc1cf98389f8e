"""Nonlinear springs and dampers: between two points, and at the angle of a joint.

With the elongation x over its length without force, its rate, and a table T of forces over elongation,

    tension = F₀ + k x + T(x) + c ẋ,   energy = F₀ x + ½ k x² + ∫₀ˣ T.
"""

from typing import Any, ClassVar

from tribodyn.cases.case import demand
from tribodyn.cases.fields import quantity
from tribodyn.cases.signals import ForceSignal, TorqueSignal
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, Joints, Leg, OfJointKeys, PointsKeys


@force_law("preload", "stiffness", "damping")
def elastic(spring: Any, law: Any) -> None:
    """Fill the force of a spring with preload, stiffness, table and damper."""
    x, v = law.position, law.rate
    law.force = -(spring.preload + spring.stiffness * x + law.table[0] + spring.damping * v)
    law.in_position, law.in_rate = -(spring.stiffness + law.table_slope), -spring.damping
    law.stored = spring.preload * x + 0.5 * spring.stiffness * x * x + law.table[1]
    law.damping = spring.damping * v * v


class NonlinearSpring(PointsKeys):
    """A nonlinear spring and damper between two points: preload, stiffness and a table of its force."""

    TABLE: ClassVar[str] = "nonlinear_springs"
    METHOD: ClassVar[str] = "nonlinear_spring"
    FORCE: ClassVar[str] = "force that pushes the two points apart"
    MOMENT: ClassVar[str] = "none"
    LAW: ClassVar = elastic
    IS_SPRING: ClassVar[bool] = True
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[nonlinear_springs.rubber]
between = ["arm", "ground"]
first_point = "0, 60, 0 mm"
second_point = "100, 70, 20 mm"
preload = "2 N"
stiffness = "0.1 N/mm"
damping = "0.5 N s/m"
force = { positions = "-30, -10, 10, 30 mm", values = "-20, -2, 2, 20 N" }
"""
        + DRIVE
    )

    preload: float = quantity("0 N", "tension at its length", "assumed", example="20 N")
    stiffness: float = quantity("0 N/mm", "tension over elongation", "assumed", ge=0, example="2 N/mm")
    damping: float = quantity("0 N s/m", "tension over its rate", "assumed", ge=0, example="5 N s/m")
    force: ForceSignal | None = None

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg between its ends."""
        words = "a spring needs a stiffness, a preload, a damping or a table of its force over positions"
        demand(bool(self.stiffness or self.preload or self.damping or self.force), "stiffness", words)
        over = None if self.force is None else self.force.over
        demand(
            over in (None, "positions"),
            "force",
            "the table of a spring is one over positions: its elongation",
        )
        return super().legs(joints)


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
