"""Rack and pinion: the rack slides as the pitch circle of the pinion rolls on it.

With the axis z of the pinion, the direction e of the rack and the signed pitch radius r, the teeth meet at
r e × z from the centre of the pinion, and

    e·d_rack − (e·d_pinion + r θ) = constant.

The multiplier is the force on the rack along its axis. With backlash, its flanks push along this axis alone.
"""

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from tribodyn.cases.case import demand
from tribodyn.cases.fields import names, quantity
from tribodyn.kernels import dense
from tribodyn.mechanism.elements import element as base
from tribodyn.mechanism.elements.teeth import Teeth


class Rack(Teeth):
    """A rack and pinion: the rack slides by the pitch radius times the angle of the pinion."""

    TABLE: ClassVar[str] = "racks"
    METHOD: ClassVar[str] = "rack"
    FORCE: ClassVar[str] = "force of the teeth on the rack, along the axis of its joint"
    MOMENT: ClassVar[str] = "torque of the teeth on the pinion, about its axis"
    MOMENT_OF: ClassVar[int] = 0
    EXAMPLE: ClassVar[str] = """
case = "mechanism"
run.duration = "50 ms"
[bodies]
pinion = { mass = "1 kg", centre = "0, 0, 0 mm", inertia = "3e-4, 3e-4, 5e-4 kg m^2" }
rack = { mass = "2 kg", centre = "0, -20, 0 mm", inertia = "1e-4, 5e-3, 5e-3 kg m^2" }
[joints]
bearing = { type = "revolute", between = ["ground", "pinion"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
guide = { type = "prismatic", between = ["ground", "rack"], point = "0, -20, 0 mm", axis = [1, 0, 0] }
[racks.mesh]
joints = ["bearing", "guide"]
radius = "20 mm"
[drives.motor]
joint = "bearing"
torque = "0.2 N m"
"""

    joints: tuple[str, str] = names(
        "the bearing of the pinion and the guide of the rack", "", length=2, example='["pinion", "guide"]'
    )
    radius: float = quantity(
        None,
        "pitch radius: displacement of the rack along its axis for 1 rad of the pinion about its own; "
        "negative where the rack is on the other side",
        "",
        unit="mm",
        example="20 mm",
        required=True,
    )

    def equations(self, joints: base.Joints) -> tuple[base.Equation, ...]:
        """Return the constraint or the contacts of teeth with backlash, and the friction of losses."""
        return tuple(self.meshing(self.legs(joints), None))

    def legs(self, joints: base.Joints) -> tuple[base.Leg, ...]:
        """Return the leg of the pinion and that of the rack."""
        bearing, guide = (joints[name] for name in self.joints)
        demand(
            self.radius != 0.0,
            "radius",
            "the pitch radius is 0; give the way of the rack for 1 rad of the pinion",
        )
        base.require_type(self.joints[0], bearing, ("revolute", "cylindrical"), "the pinion of a rack")
        base.require_type(self.joints[1], guide, ("prismatic",), "a rack")
        carrier = base.carrier(self.joints, joints)
        axis, along = base.axis_of(bearing), base.axis_of(guide)
        words = "the axis of the pinion and that of the rack must be at right angles"
        demand(abs(float(dense.product(axis, along))) < base.PARALLEL, "joints", words)
        centre = base.origin(bearing, carrier)
        teeth = centre[0] + self.radius * np.cross(along, axis)
        # A gap in the drawing of the guide stays one.
        gap = base.origin(guide, carrier) - base.origin(guide, carrier)[0]
        return (
            base.leg((carrier, base.other_body(bearing, carrier)), centre, axis, -along, -self.radius),
            base.leg((carrier, base.other_body(guide, carrier)), teeth + gap, axis, along, 0.0),
        )

    def outlines(self, joints: base.Joints) -> Iterable[base.Outline]:
        """Return the pitch circle and a turn of it on the pitch line of the rack."""
        pinion, rack = self.legs(joints)
        yield ((pinion.bodies[1], base.circle(pinion.points[1], pinion.axes[:, 2], abs(self.radius))),)
        half = np.pi * abs(self.radius) * base.axis_of(joints[self.joints[1]])
        yield ((rack.bodies[1], rack.points[1] + np.array([-half, half])),)
