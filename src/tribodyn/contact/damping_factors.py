"""Damping factors of impact by name: from the restitution e meant to the strength of the damping.

A force K δⁿ (1 + a δ̇/δ̇₋) rebounds with a restitution that follows from ``a`` alone, for any K, mass and n;
it is not the e given to most published factors unless e is close to 1: see :func:`rebound`. ``calibrated``
is the inverse of that relation. ``kelvin-voigt`` is a dashpot beside the spring instead, K δ + D δ̇.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable


@dataclass(frozen=True)
class DampingFactor:
    """A way from restitution to damping."""

    #: Function e → a of arrays, in the damping a·K δⁿ δ̇/δ̇₋; for a dashpot e → 2ζ, in 2ζ·F_max δ̇/δ̇₋ with
    #: the largest force F_max that the undamped impact would reach.
    ratio: Callable[[FloatArray], FloatArray]
    source: str  #: Where it was published.
    dashpot: bool = False  #: Whether it is the constant dashpot of Kelvin and Voigt.

    def __call__(self, restitution: FloatArray) -> FloatArray:
        """Return the ratio of damping to stiffness [1], shape of ``restitution`` [1], 0 < e ≤ 1."""
        return self.ratio(np.asarray(restitution, dtype=np.float64))

    def realised(self, restitution: FloatArray) -> FloatArray:
        """Return the restitution that comes out of one impact of a point [1], shape of ``restitution``."""
        ratio = self(restitution)
        return dashpot_rebound(0.5 * ratio) if self.dashpot else rebound(ratio)

    @property
    def valid_from(self) -> float:
        """Least restitution, in steps of 0.01, from which on all come back within 0.05 of what was meant."""
        meant = np.linspace(0.01, 1.0, 100)
        right = np.abs(self.realised(meant) - meant) <= 0.05
        return float(meant[np.logical_and.accumulate(right[::-1])[::-1]][0])


def no_damping(restitution: FloatArray) -> FloatArray:
    """Return zeros, shape of ``restitution``: all energy comes back, whatever was meant."""
    return np.zeros_like(restitution)


def hunt_crossley(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e)/2, shape of ``restitution`` [1]."""
    return 1.5 * (1.0 - restitution)


def herbert_mcwhannell(restitution: FloatArray) -> FloatArray:
    """Return a = 6(1 − e)/((2e − 1)² + 3), shape of ``restitution`` [1]."""
    return 6.0 * (1.0 - restitution) / ((2.0 * restitution - 1.0) ** 2 + 3.0)


def lee_wang(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e)/4, shape of ``restitution`` [1]."""
    return 0.75 * (1.0 - restitution)


def lankarani_nikravesh(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e²)/4, shape of ``restitution`` [1]."""
    return 0.75 * (1.0 - restitution**2)


def gonthier(restitution: FloatArray) -> FloatArray:
    """Return a = (1 − e²)/e, shape of ``restitution`` [1]."""
    return (1.0 - restitution**2) / restitution


def zhiying_qishao(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e²) exp(2(1 − e))/4, shape of ``restitution`` [1]."""
    return np.asarray(lankarani_nikravesh(restitution) * portable.exp(2.0 * (1.0 - restitution)))


def flores(restitution: FloatArray) -> FloatArray:
    """Return a = 8(1 − e)/(5e), shape of ``restitution`` [1]."""
    return 1.6 * (1.0 - restitution) / restitution


def hu_guo(restitution: FloatArray) -> FloatArray:
    """Return a = 3(1 − e)/(2e), shape of ``restitution`` [1]."""
    return 1.5 * (1.0 - restitution) / restitution


def kelvin_voigt(restitution: FloatArray) -> FloatArray:
    """Return 2ζ of ln e = −πζ/√(1 − ζ²), half a period of damped oscillation, shape of ``restitution``."""
    logarithm = portable.log(restitution)
    return np.asarray(-2.0 * logarithm / portable.hypot(np.pi, logarithm))


def calibrated(restitution: FloatArray) -> FloatArray:
    """Return the a whose :func:`rebound` is the restitution asked for, shape of ``restitution`` [1].

    With t = a(1 + e) the energy balance reads 1 + a = t/(1 − exp(−t)) and 1 − ae = t/(exp(t) − 1), so that
    e(t) is explicit and falls from 1 to 0; t is found by bisection, below 1 + 1/e since a < 1/e.
    """
    low = np.full_like(restitution, 1.0e-12)
    high = 1.0 + 1.0 / restitution
    for _ in range(80):
        middle = 0.5 * (low + high)
        too_lively = _restitution_of(middle) > restitution
        low, high = np.where(too_lively, middle, low), np.where(too_lively, high, middle)
    return np.where(restitution < 1.0, -high / portable.expm1(-high) - 1.0, 0.0)


def _restitution_of(t: FloatArray) -> FloatArray:
    """Return e = (1 − t/(exp(t) − 1)) / (t/(1 − exp(−t)) − 1), shape of ``t`` > 0."""
    # The powers of −t alone: exp(t) overflows for the smallest restitutions.
    share = -t / portable.expm1(-t)
    return np.asarray((1.0 - share * portable.exp(-t)) / (share - 1.0))


DAMPING_FACTORS: dict[str, DampingFactor] = {
    "none": DampingFactor(no_damping, "no energy is lost"),
    "kelvin-voigt": DampingFactor(kelvin_voigt, "spring and dashpot; see Goldsmith 1960", dashpot=True),
    "hunt-crossley": DampingFactor(hunt_crossley, "Hunt and Crossley 1975"),
    "herbert-mcwhannell": DampingFactor(herbert_mcwhannell, "Herbert and McWhannell 1977"),
    "lee-wang": DampingFactor(lee_wang, "Lee and Wang 1983"),
    "lankarani-nikravesh": DampingFactor(lankarani_nikravesh, "Lankarani and Nikravesh 1990"),
    "gonthier": DampingFactor(gonthier, "Gonthier et al. 2004"),
    "zhiying-qishao": DampingFactor(zhiying_qishao, "Zhiying and Qishao 2006"),
    "flores": DampingFactor(flores, "Flores et al. 2011"),
    "hu-guo": DampingFactor(hu_guo, "Hu and Guo 2015"),
    "calibrated": DampingFactor(calibrated, "solved here from the energy balance"),
}


def rebound(ratio: FloatArray) -> FloatArray:
    """Return the restitution that a ratio a of damping to stiffness really gives, shape of ``ratio`` [1].

    The motion m dv/dt = −K δⁿ (1 + a v/v₀) has the integral a v/v₀ − ln(1 + a v/v₀) + const·δⁿ⁺¹, the
    same at both ends of the contact: a − ln(1 + a) = −x − ln(1 − x), x = a·e. So 1 − x is minus the Lambert
    W function of −(1 + a) exp(−1 − a).
    """
    from scipy.special import lambertw

    ratio = np.asarray(ratio, dtype=np.float64)
    damped = np.where(ratio > 0.0, ratio, 1.0)
    argument = -(1.0 + damped) * portable.exp(-1.0 - damped)
    return np.where(ratio > 0.0, (1.0 + lambertw(argument, k=0).real) / damped, 1.0)


def dashpot_rebound(damping_ratio: FloatArray) -> FloatArray:
    """Return the restitution exp(−πζ/√(1 − ζ²)) of a mass on spring and dashpot, shape of ``damping_ratio``.

    The contact ends where it began, at δ = 0, and the dashpot may pull before.
    """
    return np.asarray(portable.exp(-np.pi * damping_ratio / np.sqrt(1.0 - damping_ratio**2)))
