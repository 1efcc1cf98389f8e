"""Limit stop: an elastic contact of one side at an angle or a position, with any damping factor.

With the indentation δ past the stop, and the ratio a that a damping factor makes of the restitution meant
(``contact.DAMPING_FACTORS``, each with its source),

    F = K δⁿ (1 + a δ̇/δ̇₋),   never a pull,

where δ̇₋ is the speed at which contact began, as in joints with clearance: it is kept from the end of the
first accepted step in contact on. Before that the speed itself takes its place, and ``least_rate`` if that is
more.
"""

from typing import Any, ClassVar, Final, Literal

import numpy as np

from mebdf.kernels.elementary import portable, power
from tribodyn.cases.case import demand
from tribodyn.cases.fields import choice, number, quantity
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, ForceLaw, Joints, Leg, OfJointKeys

#: Coefficient of restitution of hardened steel on steel in slow impacts, where a case does not say it [1].
RESTITUTION: Final = 0.7
#: Least speed at which contact begins, where a case does not say it [m/s] or [rad/s].
LEAST_RATE: Final = 1.0e-3


@force_law("at", "side", "exponent", "scale", "damping", "least_rate")
def one_sided(stop: Any, law: Any) -> None:
    """Fill the force of a contact that is closed where side·(position − at) is above zero."""
    depth, speed = stop.side * (law.position - stop.at), stop.side * law.rate
    if not depth > 0.0:
        return
    law.touching = 1.0
    elastic = stop.scale * power(depth, stop.exponent)
    law.stored = elastic * depth / (stop.exponent + 1.0)
    known = law.entry_rate
    entry = max(known if known > 0.0 else abs(speed), stop.least_rate)
    share = 1.0 + stop.damping * speed / entry
    if share <= 0.0:
        law.damping = -elastic * speed
        return
    law.force = -stop.side * elastic * share
    law.in_position = -stop.exponent * elastic / depth * share
    if known > 0.0 or entry > abs(speed):
        law.in_rate = -elastic * stop.damping / entry
    law.damping = elastic * stop.damping * speed * speed / entry


def damping_of(factor: str, restitution: float) -> float:
    """Return the ratio a of a damping factor that is no dashpot [1]."""
    # Imported here: reading a case needs no SciPy.
    from tribodyn.contact import DAMPING_FACTORS

    words = "this is a dashpot, which needs a mass; choose another damping factor"
    demand(not DAMPING_FACTORS[factor].dashpot, "damping_factor", words)
    return float(DAMPING_FACTORS[factor](np.array(restitution)))


class Stop(OfJointKeys):
    """A limit stop of a joint: an elastic contact of one side at an angle or a position."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        ("angle", "position"),
        ("angular_stiffness", "stiffness"),
    )
    TABLE: ClassVar[str] = "stops"
    METHOD: ClassVar[str] = "stop"
    FORCE: ClassVar[str] = "force on the second body along the axis; none for a stop of an angle"
    MOMENT: ClassVar[str] = "torque on the second body about the axis; none for a stop of a position"
    LAW: ClassVar = one_sided
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[stops.end]
joint = "input"
angle = "-0.2 deg"
side = "above"
angular_stiffness = "100 N m/rad"
restitution = 0.6
"""
        + DRIVE
    )

    angle: float | None = quantity(
        None, "angle at which it begins; zero in the model", unit="deg", example="60 deg"
    )
    position: float | None = quantity(
        None, "position along the axis at which it begins", unit="mm", example="20 mm"
    )
    side: Literal["above", "below"] = choice("above", "side of the joint values that it blocks", "assumed")
    stiffness: float | None = quantity(
        None, "force over indentation, of a stop of a position", gt=0, example="1000 N/mm"
    )
    angular_stiffness: float | None = quantity(
        None, "torque over indentation, of a stop of an angle", gt=0, example="100 N m/rad"
    )
    exponent: float = number(1.0, "n, of the indentation", "assumed", ge=1, le=4)
    depth: float = number(
        1.0e-3, "indentation at which the stiffness is force over indentation, in m or rad", "assumed", gt=0
    )
    damping_factor: str = choice(
        "calibrated",
        "how damping follows from restitution",
        "assumed",
        family="tribodyn.contact:DAMPING_FACTORS",
    )
    restitution: float = number(RESTITUTION, "coefficient of restitution", "manual, elements", gt=0, le=1)
    least_rate: float = number(
        LEAST_RATE, "least speed at which contact begins, in m/s or rad/s", "assumed", gt=0
    )

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg of the angle or the position."""
        turns = self.angle is not None
        words = "say where it begins: give an angle or a position"
        demand(turns or self.position is not None, "angle", words)
        key = "angular_stiffness" if turns else "stiffness"
        words = f"a stop of {'an angle' if turns else 'a position'} needs its {key}"
        demand(getattr(self, key) is not None, key, words)
        return (self.leg_of(joints, "angle" if turns else "position", "this stop"),)

    def force_law(self, joints: Joints) -> ForceLaw:
        """Return the law of contact on one side."""
        stiffness = self.stiffness if self.angular_stiffness is None else self.angular_stiffness
        at = self.position if self.angle is None else self.angle
        assert stiffness is not None
        assert at is not None
        return ForceLaw(
            one_sided,
            {
                "at": at,
                "side": 1.0 if self.side == "above" else -1.0,
                "exponent": self.exponent,
                "scale": stiffness * portable.power(self.depth, 1.0 - self.exponent),
                "damping": damping_of(self.damping_factor, self.restitution),
                "least_rate": self.least_rate,
            },
        )
