"""Published damping factors of impact: from the restitution e meant to the ratio a of damping to stiffness.

A force K δⁿ (1 + a δ̇/δ̇₋) rebounds with a restitution that follows from ``a`` alone, for any K, mass and n,
and that is not the e given to the factor unless e is close to 1: see :func:`rebound`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.special import lambertw

from tribodyn.core.arrays import FloatArray


def hunt_crossley(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e)/2 (Hunt and Crossley 1975), shape of ``restitution`` [1]."""
    return 1.5 * (1.0 - restitution)


def lankarani_nikravesh(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e²)/4 (Lankarani and Nikravesh 1990), shape of ``restitution`` [1]."""
    return 0.75 * (1.0 - restitution**2)


def gonthier(restitution: FloatArray) -> FloatArray:
    """Return a = (1 − e²)/e (Gonthier et al. 2004), shape of ``restitution`` [1]."""
    return (1.0 - restitution**2) / restitution


def flores(restitution: FloatArray) -> FloatArray:
    """Return a = 8(1 − e)/(5e) (Flores et al. 2011), shape of ``restitution`` [1]."""
    return 1.6 * (1.0 - restitution) / restitution


DAMPING_FACTORS: dict[str, Callable[[FloatArray], FloatArray]] = {
    "lankarani-nikravesh": lankarani_nikravesh,
    "hunt-crossley": hunt_crossley,
    "gonthier": gonthier,
    "flores": flores,
}


def rebound(ratio: FloatArray) -> FloatArray:
    """Return the restitution that a ratio a > 0 of damping to stiffness really gives, shape of ``ratio`` [1].

    The motion m dv/dt = −K δⁿ (1 + a v/v₀) has the integral a v/v₀ − ln(1 + a v/v₀) + const·δⁿ⁺¹, the
    same at both ends of the contact: a − ln(1 + a) = −x − ln(1 − x), x = a·e. So 1 − x is minus the Lambert
    W function of −(1 + a) exp(−1 − a).
    """
    argument = -(1.0 + ratio) * np.exp(-1.0 - ratio)
    return np.asarray((1.0 + lambertw(argument, k=0).real) / ratio)
