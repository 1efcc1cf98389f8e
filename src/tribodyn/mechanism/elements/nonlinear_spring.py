"""Nonlinear spring and damper between two points.

With the elongation x over its length without force, its rate, and a table T of forces over elongation,

    tension = F₀ + k x + T(x) + c ẋ,   energy = F₀ x + ½ k x² + ∫₀ˣ T.
"""

from typing import Any, ClassVar

from tribodyn.cases.case import demand
from tribodyn.cases.fields import quantity
from tribodyn.cases.signals import ForceSignal
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, Joints, Leg, PointsKeys


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
