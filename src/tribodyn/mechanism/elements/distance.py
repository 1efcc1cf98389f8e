"""Distance joint: two points stay at a fixed distance, as at the ends of a rod without mass.

With the displacement d of the second point against the first,

    |d| − L = 0.

The multiplier is the force that pushes the points apart: above zero in compression.
"""

from typing import ClassVar

from tribodyn.cases.case import demand
from tribodyn.mechanism.elements.element import Joints, Leg, PointsKeys


class Distance(PointsKeys):
    """A distance joint: two points of two bodies stay at a fixed distance."""

    TABLE: ClassVar[str] = "distances"
    METHOD: ClassVar[str] = "distance"
    FORCE: ClassVar[str] = "force that pushes the two points apart"
    MOMENT: ClassVar[str] = "none"
    EXAMPLE: ClassVar[str] = """
case = "mechanism"
run.duration = "50 ms"
[bodies]
crank = { mass = "1 kg", centre = "0, 0, 0 mm", inertia = "3e-4, 3e-4, 5e-4 kg m^2" }
rocker = { mass = "2 kg", centre = "100, 0, 20 mm", inertia = "5e-3, 5e-3, 9e-3 kg m^2" }
[joints]
input = { type = "revolute", between = ["ground", "crank"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
output = { type = "revolute", between = ["ground", "rocker"], point = "100, 0, 20 mm", axis = [0, 0, 1] }
[distances.rod]
between = ["crank", "rocker"]
first_point = "0, 30, 0 mm"
second_point = "100, 60, 20 mm"
[drives.motor]
joint = "input"
torque = "0.2 N m"
"""

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg from the first point to the second."""
        words = "points at no distance are held by a spherical joint; give a length above zero"
        demand(self.length is None or self.length > 0.0, "length", words)
        return super().legs(joints)
