"""Screw: a nut moves along a thread by the lead for each turn against it.

With displacement and angle of the nut against the screw along and about the axis z,

    z·d − lead/(2π) θ = constant,

whichever way the axis is drawn. The multiplier λ is the axial part of the force across the flanks,
N = |λ|/cos φ with the lead angle φ, tan φ = lead/(2π r). Friction at the mean radius r acts along the helix,
on the coordinate

    s = r θ cos φ + z·d sin φ,

by the law of ``joint_friction`` with the load N. A nut that lifts a weight W takes the torque of textbooks,
W r tan(φ + ρ) with tan ρ = μ. With backlash the nut touches one flank or the other, each an elastic contact
with friction of its own.
"""

import math
from dataclasses import replace
from typing import ClassVar, Self

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import demand
from tribodyn.cases.fields import names, number, quantity
from tribodyn.mechanism.elements import element as base
from tribodyn.mechanism.elements.joint_friction import friction_law
from tribodyn.mechanism.elements.teeth import Flanks


class Screw(Flanks):
    """A screw: a thread between a screw and its nut, with friction or without."""

    TABLE: ClassVar[str] = "screws"
    METHOD: ClassVar[str] = "screw"
    FORCE: ClassVar[str] = "force of the thread on the nut, along the axis of the first joint"
    MOMENT: ClassVar[str] = "torque of the thread on the nut, about this axis"
    MOMENT_OF: ClassVar[int] = 0
    EXAMPLE: ClassVar[str] = """
case = "mechanism"
run.duration = "50 ms"
[bodies]
screw = { mass = "1 kg", centre = "0, 0, 50 mm", inertia = "1e-3, 1e-3, 2e-4 kg m^2" }
nut = { mass = "2 kg", centre = "0, 0, 30 mm", inertia = "1e-3, 1e-3, 1e-3 kg m^2" }
[joints]
bearing = { type = "revolute", between = ["ground", "screw"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
guide = { type = "prismatic", between = ["ground", "nut"], point = "40, 0, 30 mm", axis = [0, 0, 1] }
[screws.thread]
joints = ["bearing", "guide"]
lead = "5 mm"
[drives.motor]
joint = "bearing"
torque = "0.2 N m"
"""

    joints: tuple[str, ...] = names(
        "the cylindrical joint of the thread; or the bearing of the screw and the guide of the nut",
        length=0,
        example='["bearing", "guide"]',
    )
    lead: float = quantity(
        None,
        "displacement along the axis for one turn; positive for a right-handed thread",
        unit="mm",
        example="4 mm",
        required=True,
    )
    friction_coefficient: float = number(
        0.0,
        "of the thread, mu; over the cosine of the flank angle where flanks are inclined",
        "assumed",
        ge=0,
        le=2,
    )
    backward_coefficient: float | None = number(
        None,
        "likewise where the load turns the screw; that of friction_coefficient without it",
        ge=0,
        le=2,
        example="0.12",
    )
    radius: float | None = quantity(
        None, "mean radius of the thread, at which it slides; needed with friction", gt=0, example="8 mm"
    )
    slip_velocity: float = quantity("1 mm/s", "speed at which friction is developed, u_s", "assumed", gt=0)
    backlash: float | None = quantity(
        None, "play of the nut along the axis; none without it", ge=0, example="50 um"
    )
    stiffness: float | None = quantity(
        None, "axial force over indentation, of a thread with backlash", gt=0, example="100 N/um"
    )

    @property
    def without_friction(self) -> Self:
        """The screw whose thread has no friction."""
        return self.model_copy(update={"friction_coefficient": 0.0, "backward_coefficient": None})

    def equations(self, joints: base.Joints) -> tuple[base.Equation, ...]:
        """Return the constraint, or with backlash a contact for each flank, and the friction on each.

        Legs of both flanks have opposite signs, so that each contact pushes.
        """
        (thread,) = self.legs(joints)
        law, flanks = None, [thread]
        if self.has_play:
            demand(self.stiffness is not None, "stiffness", "a thread with backlash needs its stiffness")
            law = self.flank_law(self.stiffness or 0.0)
            other = replace(thread, along=-thread.along, about=-thread.about, reported=thread.along)
            flanks.append(other)
        mu = self.friction_coefficient
        backward = mu if self.backward_coefficient is None else self.backward_coefficient
        words = "give both coefficients above 0, or none"
        demand((mu > 0.0) == (backward > 0.0), "backward_coefficient", words)
        if mu == 0.0:
            return tuple(base.Equation((flank,), law) for flank in flanks)
        if self.radius is None:
            demand(False, "radius", "friction in a thread needs the mean radius at which it slides")
            raise AssertionError
        pitch = self.lead / (2.0 * math.pi)
        slope = float(portable.hypot(self.radius, pitch))
        cosine, sine = self.radius / slope, pitch / slope
        if self.lead > 0.0:  # the force across the flanks drives the nut where it has the sign of the sliding
            mu, backward = backward, mu
        found, lifted = [], _crosswise(thread).along
        for flank in flanks:
            lifting = replace(_crosswise(flank), reported=lifted)
            found.append(base.Equation((replace(flank, along=np.zeros(3)), lifting), law))
        for k, flank in enumerate(flanks):
            along, about = sine * flank.along, self.radius * cosine * flank.about / thread.about
            share = backward / mu
            rubbing = friction_law(mu / cosine, self.slip_velocity, load_leg=2 * k + 1, backward=share)
            sliding = replace(flank, along=along, about=about, reported=thread.along)
            found.append(base.Equation((sliding,), rubbing))
        return tuple(found)

    def legs(self, joints: base.Joints) -> tuple[base.Leg, ...]:
        """Return the leg from the screw to the nut."""
        demand(self.lead != 0.0, "lead", "the lead is 0; give the way of the nut for one turn")
        words = "name one cylindrical joint, or a revolute and a prismatic one"
        demand(len(self.joints) in (1, 2), "joints", words)
        bearing = joints[self.joints[0]]
        axis = base.axis_of(bearing)
        if len(self.joints) == 1:
            base.require_type(self.joints[0], bearing, ("cylindrical",), "a screw of one joint")
            bodies, points = bearing.between, base.origin(bearing, bearing.between[0])
        else:
            bodies, points = self._of_two(joints)
        return (base.leg(bodies, points, axis, axis, -self.lead / (2.0 * math.pi)),)

    def _of_two(self, joints: base.Joints) -> tuple[tuple[str, str], FloatArray]:
        """Return screw and nut, and where they are, for a bearing and a guide on one body."""
        bearing, guide = (joints[name] for name in self.joints)
        base.require_type(self.joints[0], bearing, ("revolute",), "the screw, named first,")
        base.require_type(self.joints[1], guide, ("prismatic",), "the nut, named second,")
        carrier = base.carrier((self.joints[0], self.joints[1]), joints)
        words = "the axes of the screw and of the guide of its nut must be parallel"
        demand(base.are_parallel(base.axis_of(bearing), base.axis_of(guide)), "joints", words)
        points = base.origin(bearing, carrier)[[1, 0]]
        return (base.other_body(bearing, carrier), base.other_body(guide, carrier)), points


def _crosswise(thread: base.Leg) -> base.Leg:
    """Return the displacement of a thread along x of other axes: its force is then one across their z."""
    turned = thread.axes[:, [2, 0, 1]]
    return replace(thread, axes=turned, along=thread.along[[2, 0, 1]], about=0.0)
