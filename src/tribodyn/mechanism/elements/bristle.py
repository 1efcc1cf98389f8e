"""Friction that holds at rest: surfaces stick by an elastic displacement, up to their limit.

With the normal load N, the limit L = N (μ + (μ_s − μ) exp(−(v/v_s)²)) and the stiffness k of what sticks,

    ė = k v,   |e| ≤ L,   F = e + τ k v,   |F| ≤ L,

against the motion. k grows to N μ_s/δ at least, δ being the displacement at which it breaks away, and falls
back to that where it slides. What is stored, e²/2k, does not grow with N, so friction is passive for any
N(t) ≥ 0; and as k stays, a load that oscillates below the limit moves nothing for good. Under constant N this
is the bristle F = σ₀ z + σ₁ ż, which yields at its limit. Sliding is Coulomb's law. From one accepted step to
the next e follows from the displacement since then, without an equation of its own.
"""

import math
from dataclasses import replace
from typing import Any

from mebdf.kernels.elementary import exp
from tribodyn.cases.case import Group
from tribodyn.cases.fields import quantity, switch
from tribodyn.kernels.mechanism.law import followed_load, force_law
from tribodyn.mechanism.elements.element import ForceLaw
from tribodyn.mechanism.elements.joint_friction import regularised


class RestKeys(Group):
    """Friction at rest."""

    rest: bool = switch(
        False, "whether friction holds at rest; without it surfaces creep below the slip velocity", "assumed"
    )
    presliding: float = quantity("1 um", "displacement at which it breaks away", "assumed", gt=0, le="10 mm")
    settling: float = quantity("1 ms", "time constant of the damping of what sticks", "assumed", ge=0)


@force_law(
    "normal_load",
    "friction_coefficient",
    "breakaway",
    "stribeck_velocity",
    "viscous",
    "extrapolates",
    "backward",
    "reverse",
    "presliding",
    "settling",
)
def bristle(joint: Any, law: Any) -> None:
    """Fill the friction force at a displacement since the last accepted step, and at a sliding speed."""
    v, direction = law.rate, law.rate if law.elastic == 0.0 else law.elastic
    load = joint.normal_load + followed_load(law, joint.extrapolates, joint.backward, direction)
    load *= joint.reverse if direction < 0.0 else 1.0
    share = exp(-((v / joint.stribeck_velocity) ** 2))
    limit = load * (joint.friction_coefficient + joint.breakaway * share)
    fresh = load * (joint.friction_coefficient + joint.breakaway) / joint.presliding
    stiffness, moved = max(law.stiffness, fresh), law.position - law.anchor
    elastic = law.elastic
    if moved == moved:  # before the start there is no last step
        elastic += stiffness * moved
    bounded = min(max(elastic, -limit), limit)
    law.next_elastic, law.next_stiffness = bounded, stiffness
    if bounded != elastic:
        # What slips loses L (|e| − L)/k at least, and no more may become stored by a softer spring.
        slipped = (abs(elastic) - limit) / limit if limit > 0.0 else math.inf
        law.next_stiffness = max(fresh, stiffness / (1.0 + 2.0 * slipped))
    resisting = bounded + joint.settling * stiffness * v
    force = min(max(resisting, -limit), limit)
    law.force = -force - joint.viscous * v
    factor = -1.0 / (1.0 - law.held) if joint.extrapolates > 0.0 else -1.0
    if force == resisting:
        law.in_position = factor * stiffness if bounded == elastic else 0.0
        law.in_rate = factor * joint.settling * stiffness - joint.viscous
    else:
        fall = -2.0 * v / (joint.stribeck_velocity * joint.stribeck_velocity) * load * joint.breakaway * share
        law.in_rate = factor * math.copysign(fall, fall * force) - joint.viscous
    law.friction, law.damping = force * v, joint.viscous * v * v


def resting(law: ForceLaw, keys: RestKeys) -> ForceLaw:
    """Return a law of friction as one that holds at rest; other laws as they are."""
    if law.function is not regularised:
        return law
    added = {"presliding": keys.presliding, "settling": keys.settling}
    return replace(law, function=bristle, parameters={**law.parameters, **added})
