"""Friction in an ideal joint by its reaction or a stated load: Coulomb, Stribeck and viscous parts.

With the sliding speed v, at a radius where the joint turns, and the normal load N, which is stated or the
size of the joint's own reaction across its axis,

    F = N (μ + (μ_s − μ) exp(−(v/v_s)²)) v/√(v² + u_s²) + c v

against the motion. It is the law of ``tribodyn.friction`` with the regularisation of joints with clearance:
what sticks creeps, by less than the slip velocity u_s.
"""

import math
from typing import Any, ClassVar, Self

from mebdf.kernels.elementary import exp
from tribodyn.cases.case import demand
from tribodyn.cases.fields import number, quantity
from tribodyn.kernels.mechanism.law import followed_load, force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, ForceLaw, Joints, Leg, OfJointKeys


@force_law(
    "normal_load",
    "friction_coefficient",
    "breakaway",
    "stribeck_velocity",
    "slip_velocity",
    "viscous",
    "extrapolates",
    "backward",
    "reverse",
)
def regularised(joint: Any, law: Any) -> None:
    """Fill the friction force at a sliding speed."""
    v, slip = law.rate, joint.slip_velocity
    followed = followed_load(law, joint.extrapolates, joint.backward, v)
    gain = law.held if joint.extrapolates > 0.0 else 0.0
    square = v * v + slip * slip
    direction = v / math.sqrt(square)
    share = exp(-((v / joint.stribeck_velocity) ** 2))
    load = (joint.normal_load + followed) * (joint.reverse if v < 0.0 else 1.0)
    moving, sticking = joint.friction_coefficient * load, joint.breakaway * load
    limit = moving + sticking * share
    fall = -2.0 * v / (joint.stribeck_velocity * joint.stribeck_velocity) * sticking * share
    law.force = -limit * direction - joint.viscous * v
    steep = fall * direction + limit * slip * slip / (square * math.sqrt(square))
    law.in_rate = -steep / (1.0 - gain) - joint.viscous
    law.friction = limit * direction * v
    law.damping = joint.viscous * v * v


def friction_law(
    coefficient: float,
    slip_velocity: float,
    *,
    normal_load: float = 0.0,
    breakaway: float = 0.0,
    stribeck_velocity: float = 1.0,
    viscous: float = 0.0,
    load_of: str = "",
    load_leg: int | None = None,
    backward: float = 1.0,
    reverse: float = 1.0,
) -> ForceLaw:
    """Return the law of friction, Coulomb's by default; ``breakaway`` is what μ_s is above μ.

    ``backward`` is the friction over that number where the force that it follows drives the motion,
    ``reverse`` where the coordinate falls.
    """
    parameters = {
        "normal_load": normal_load,
        "friction_coefficient": coefficient,
        "breakaway": breakaway,
        "stribeck_velocity": stribeck_velocity,
        "slip_velocity": slip_velocity,
        "viscous": viscous,
        "extrapolates": 0.0 if load_leg is None else 1.0,
        "backward": backward,
        "reverse": reverse,
    }
    return ForceLaw(regularised, parameters, load_of=load_of, load_leg=load_leg)


class JointFriction(OfJointKeys):
    """Friction in an ideal joint, by its reaction or a stated load: Coulomb, Stribeck and viscous parts."""

    TABLE: ClassVar[str] = "frictions"
    METHOD: ClassVar[str] = "friction"
    FORCE: ClassVar[str] = "friction force on the second body along the axis; none where the joint turns"
    MOMENT: ClassVar[str] = "friction torque on the second body about the axis; none where it slides"
    LAW: ClassVar = regularised
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[frictions.bearing]
joint = "input"
radius = "10 mm"
normal_load = "40 N"
friction_coefficient = 0.1
static_coefficient = 0.15
viscous = "5 N s/m"
"""
        + DRIVE
    )

    normal_load: float | None = quantity(
        None,
        "load N on the sliding surfaces; the reaction of the joint across its axis without it",
        ge=0,
        example="40 N",
    )
    radius: float | None = quantity(
        None, "radius at which a turning joint slides; a sliding joint has none", gt=0, example="10 mm"
    )
    friction_coefficient: float = number(0.1, "of sliding, mu", "assumed", ge=0, le=2)
    static_coefficient: float | None = number(
        None, "of breakaway, mu_s; that of sliding without it", ge=0, le=2, example="0.15"
    )
    backward_coefficient: float | None = number(
        None,
        "of sliding where the coordinate falls; that of friction_coefficient without it",
        ge=0,
        le=2,
        example="0.12",
    )
    stribeck_velocity: float = quantity("10 mm/s", "speed at which it has fallen by 63 %", "assumed", gt=0)
    viscous: float = quantity("0 N s/m", "force over sliding speed", "assumed", ge=0, example="5 N s/m")
    slip_velocity: float = quantity("1 mm/s", "speed at which friction is developed, u_s", "assumed", gt=0)

    @property
    def without_friction(self) -> Self:
        """The viscous part alone."""
        none = {"friction_coefficient": 0.0, "static_coefficient": None, "backward_coefficient": None}
        return self.model_copy(update=none)

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg of the sliding distance: radius times angle, or position."""
        static = self.static_coefficient
        words = "the static coefficient is below that of sliding; friction cannot grow with speed here"
        demand(static is None or static >= self.friction_coefficient, "static_coefficient", words)
        turns = "angle" in joints[self.joint].kind.COORDINATES
        if self.radius is None:
            words = "a joint that turns needs the radius at which it slides"
            demand(not turns, "radius", words)
            return (self.leg_of(joints, "position", "friction without a radius"),)
        return (self.leg_of(joints, "angle", "friction at a radius", self.radius),)

    def force_law(self, joints: Joints) -> ForceLaw:
        """Return the law, with what the static coefficient is above that of sliding."""
        static = self.friction_coefficient if self.static_coefficient is None else self.static_coefficient
        joint, own = joints[self.joint], self.normal_load is None
        words = f"{self.joint} has clearance, and with it friction of its own: leave out this friction"
        demand(not own or joint.real is None, "joint", words)
        words = f"{joint.kind.named} has no reaction across its axis: give normal_load"
        demand(not own or joint.kind.holds_across, "normal_load", words)
        backward, mu = self.backward_coefficient, self.friction_coefficient
        words = "give the friction of the other direction above 0, over which this one is counted"
        demand(backward is None or mu > 0.0, "friction_coefficient", words)
        return friction_law(
            mu,
            self.slip_velocity,
            normal_load=self.normal_load or 0.0,
            breakaway=static - self.friction_coefficient,
            stribeck_velocity=self.stribeck_velocity,
            viscous=self.viscous,
            load_of=self.joint if own else "",
            reverse=1.0 if backward is None else backward / mu,
        )
