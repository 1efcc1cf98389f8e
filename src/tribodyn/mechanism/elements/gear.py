"""Gear pairs, and a rack and its pinion.

On parallel axes a distance D apart, pitch circles of the ratio i touch at P, at D i/(i − 1) from the first
axis towards the second. With the angles θ against the carrier, the direction n in which the teeth move, and
the displacements d of the wheels in their bearings at O,

    n·(d_2 + θ_2 × (P − O_2)) − n·(d_1 + θ_1 × (P − O_1)) = 0.

The multiplier is the tangential tooth force. Nothing acts on the carrier but the bearings.

The normal of a flank with backlash is turned by the pressure angle α: the tooth force F pushes the wheels
apart with F tan α; nearer to each other they have less play. Teeth without backlash push the wheels apart
with |λ| tan α where the pressure angle is given. A worm, whose lead angle is φ, has the losses

    η = tan φ/tan(φ + ρ) forward,   tan(φ − ρ)/tan φ backward,   tan ρ = μ.

With the axis z of the pinion, the direction e of the rack and the signed pitch radius r, the teeth meet at
r e × z from the centre of the pinion, and

    e·d_rack − (e·d_pinion + r θ) = constant.

The multiplier is the force on the rack along its axis. With backlash, its flanks push along this axis alone.
"""

import math
from collections.abc import Iterable
from typing import ClassVar, Self

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import demand
from tribodyn.cases.fields import names, number, quantity
from tribodyn.kernels import dense
from tribodyn.mechanism.elements import element as base
from tribodyn.mechanism.elements.teeth import Teeth, pushing

PRESSURE_ANGLE = math.radians(20.0)  #: Of teeth with backlash, where a case does not say it [rad].
#: Distance between parallel axes, over that between all joints, up to which they are one axis.
_OFFSET = 1.0e-9


class Gear(Teeth):
    """A gear pair: two wheels, each in a bearing of the same carrier, turn in a fixed ratio."""

    TABLE: ClassVar[str] = "gears"
    METHOD: ClassVar[str] = "gear"
    FORCE: ClassVar[str] = "tangential tooth force on the second wheel; none where axes are not parallel"
    MOMENT: ClassVar[str] = "torque of the teeth on the second wheel, about its axis"
    MOMENT_OF: ClassVar[int] = 1
    EXAMPLE: ClassVar[str] = """
case = "mechanism"
run.duration = "50 ms"
[bodies]
pinion = { mass = "1 kg", centre = "0, 0, 0 mm", inertia = "3e-4, 3e-4, 5e-4 kg m^2" }
wheel = { mass = "4 kg", centre = "90, 0, 0 mm", inertia = "5e-3, 5e-3, 9e-3 kg m^2" }
[joints]
input = { type = "revolute", between = ["ground", "pinion"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
output = { type = "revolute", between = ["ground", "wheel"], point = "90, 0, 0 mm", axis = [0, 0, 1] }
[gears.mesh]
joints = ["input", "output"]
ratio = -0.5
[drives.motor]
joint = "input"
torque = "0.2 N m"
"""

    joints: tuple[str, str] = names(
        "the bearings of the two wheels in the body that carries both",
        length=2,
        example='["input", "output"]',
    )
    ratio: float = number(
        None,
        "turns of the second wheel for one of the first, seen from the carrier; negative for external gears",
        example="-2.5",
        required=True,
    )

    pressure_angle: float | None = quantity(
        None,
        "pressure angle, by which teeth push the wheels apart; without it 20 deg with backlash, else none",
        ge=0,
        lt="60 deg",
        example="20 deg",
    )

    friction_coefficient: float | None = number(
        None, "of a worm, which is the first wheel, instead of both efficiencies", gt=0, le=2, example="0.05"
    )
    lead_angle: float | None = quantity(
        None, "lead angle of a worm; needed with its friction", gt=0, lt="90 deg", example="10 deg"
    )

    @property
    def without_play(self) -> Self:
        """The gear without backlash, which pushes its wheels apart by the same angle."""
        if self.backlash is None:
            return self
        angle = PRESSURE_ANGLE if self.pressure_angle is None else self.pressure_angle
        return self.model_copy(update={"backlash": None, "pressure_angle": angle})

    @property
    def without_friction(self) -> Self:
        """The gear without losses."""
        return self.model_copy(update={"efficiency": None, "friction_coefficient": None})

    def equations(self, joints: base.Joints) -> tuple[base.Equation, ...]:
        """Return the constraint or the contacts of teeth with backlash, and the friction of losses."""
        if self.ideal and self.backlash is not None:
            return self.without_play.equations(joints)
        legs, angle = self.legs(joints), self.pressure_angle
        if self.has_play and angle is None:
            angle = PRESSURE_ANGLE
        words = "gears whose axes are not parallel, or are one axis, have no pitch circles"
        key = "backlash" if self.has_play else "pressure_angle"
        demand(not (angle or self.has_play) or self._pitch(joints) is not None, key, words)
        return tuple(self.meshing(legs, pushing(legs, angle) if angle else None))

    def losses(self) -> tuple[float, float]:
        """Return torque against the first wheel over that of the teeth, where it drives and is driven."""
        if self.friction_coefficient is None:
            return super().losses()
        demand(self.lead_angle is not None, "lead_angle", "friction of a worm needs its lead angle")
        words = "a worm has its friction or efficiencies: leave one of them out"
        demand(self.efficiency is None and self.backward_efficiency is None, "efficiency", words)
        mu, slope = self.friction_coefficient, portable.tan(self.lead_angle or 0.0)
        words = "a worm cannot turn with this friction: lead angle and angle of friction exceed 90 deg"
        demand(mu * slope < 1.0, "friction_coefficient", words)
        steeper, flatter = (slope + mu) / (1.0 - mu * slope), (slope - mu) / (1.0 + mu * slope)
        return steeper / slope - 1.0, 1.0 - flatter / slope

    def legs(self, joints: base.Joints) -> tuple[base.Leg, ...]:
        """Return one leg for each wheel."""
        carrier = self._carrier(joints)
        first, second = (joints[name] for name in self.joints)
        axis, other = base.axis_of(first), base.axis_of(second)
        if base.are_parallel(axis, other):
            other = axis
        points = [base.origin(joint, carrier) for joint in (first, second)]
        wheels = [base.other_body(joint, carrier) for joint in (first, second)]
        pitch = self._pitch(joints)
        if pitch is None:
            size = base.size_of(joints)
            none = np.zeros(3)
            return (
                base.leg((carrier, wheels[0]), points[0], axis, none, -self.ratio * size),
                base.leg((carrier, wheels[1]), points[1], other, none, size),
            )
        # Both wheels are held where the plane of the teeth, that of the first joint, meets their axes.
        points[1] = points[1] + axis * (dense.product(points[0][0] - points[1][0], axis))
        arms = [pitch - point[0] for point in points]
        teeth = np.cross(axis, arms[0]) / dense.norm(arms[0])
        lever = [float(dense.product(np.cross(axis, arm), teeth)) for arm in arms]
        return (
            base.leg((carrier, wheels[0]), points[0], axis, -teeth, -lever[0]),
            base.leg((carrier, wheels[1]), points[1], axis, teeth, lever[1]),
        )

    def outlines(self, joints: base.Joints) -> Iterable[base.Outline]:
        """Return the pitch circles, where axes are parallel."""
        pitch = self._pitch(joints)
        for one in self.legs(joints) if pitch is not None else ():
            yield ((one.bodies[1], base.circle(one.points[1], one.axes[:, 2], abs(one.about))),)

    def _carrier(self, joints: base.Joints) -> str:
        """Return the body that carries both wheels, after checks of joints and ratio."""
        demand(
            self.ratio != 0.0,
            "ratio",
            "the ratio is 0; give the turns of the second wheel for one of the first",
        )
        for name in self.joints:
            base.require_type(name, joints[name], ("revolute", "cylindrical"), "a gear pair")
        return base.carrier(self.joints, joints)

    def _pitch(self, joints: base.Joints) -> FloatArray | None:
        """Return the pitch point as drawn [m], shape (3,); None for gears that transmit a torque only."""
        first, second = (joints[name] for name in self.joints)
        axis = base.axis_of(first)
        points = [base.origin(joint, self._carrier(joints))[0] for joint in (first, second)]
        apart = points[1] - points[0]
        apart = apart - axis * (dense.product(axis, apart))
        if base.are_parallel(axis, base.axis_of(second)) and dense.norm(apart) > _OFFSET * base.size_of(
            joints
        ):
            words = "wheels of a ratio of 1 on two axes have no pitch point; external gears have one below 0"
            demand(self.ratio != 1.0, "ratio", words)
            return np.asarray(points[0] + self.ratio / (self.ratio - 1.0) * apart)
        for name in self.joints:
            words = (
                f"{name} has clearance, and gears whose axes are not parallel, or are one axis, transmit a "
                "torque only: its bearing would lack the force of the teeth; make it ideal"
            )
            demand(joints[name].real is None, "joints", words)
        return None


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
        "the bearing of the pinion and the guide of the rack", length=2, example='["pinion", "guide"]'
    )
    radius: float = quantity(
        None,
        "pitch radius: displacement of the rack along its axis for 1 rad of the pinion about its own; "
        "negative where the rack is on the other side",
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
