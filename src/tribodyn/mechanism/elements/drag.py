"""Aerodynamic drag: a force against the velocity v of a point, in air at rest, F = ½ ρ c_d A v²."""

from typing import Any, ClassVar

import numpy as np

from tribodyn.cases.fields import Vector, name, number, quantity, vector
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements import element as base
from tribodyn.mechanism.model.parts import POINT


@force_law("density", "drag_coefficient", "area")
def quadratic(body: Any, law: Any) -> None:
    """Fill the drag along the path of a point."""
    factor = 0.5 * body.density * body.drag_coefficient * body.area
    law.force = -factor * law.rate * law.rate
    law.in_rate = -2.0 * factor * law.rate
    law.friction = -law.force * law.rate


class Drag(base.ElementKeys):
    """Aerodynamic drag on a point of a body, against its velocity in air at rest."""

    TABLE: ClassVar[str] = "drags"
    METHOD: ClassVar[str] = "drag"
    FORCE: ClassVar[str] = "force on the body along the velocity of its point: below zero"
    MOMENT: ClassVar[str] = "none"
    LAW: ClassVar = quadratic
    EXAMPLE: ClassVar[str] = (
        base.ARM.replace("[0, 0, 1] }", '[0, 0, 1], start_speed = "300 rpm" }')
        + """[drags.vane]
body = "arm"
point = "0, 100, 0 mm"
drag_coefficient = 1.2
area = "200 cm^2"
"""
        + base.DRIVE
    )

    body: str = name(None, "body that it acts on", example="arm", required=True)
    point: Vector = vector(None, "centre of pressure", unit="mm", example=POINT, required=True)
    drag_coefficient: float = number(None, "drag coefficient c_d", ge=0, example="1.2", required=True)
    area: float = quantity(None, "reference area", unit="cm^2", gt=0, example="200 cm^2", required=True)
    density: float = quantity("1.2 kg/m^3", "density of the air, at 20 degC and 1 bar", "assumed", gt=0)

    def legs(self, joints: base.Joints) -> tuple[base.Leg, ...]:
        """Return the leg of the path of the point."""
        points = np.array([self.point, self.point])
        return (base.of_points(("ground", self.body), points, "path"),)
