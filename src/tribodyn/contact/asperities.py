"""Common parts of laws that sum over Gaussian asperities: regimes, contact count, and origin of h.

Separations are counted from the mean of the asperity heights, whose spread is the σ of the surfaces, unless
``separation_from`` is ``"surface"``: then h is counted from the mean of the *surface* heights, which
lies y_s below, and the asperities spread by σ_s < σ. With ξβσ of the surface, y_s = 0.045944 σ/(ξβσ) and
(σ_s/σ)² = 1 − 3.717e-4/(ξβσ)² (Kogut and Etsion 2003, after Bush, Gibson and Keogh, and Nayak).
"""

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.contact_law import ContactLaw, asperity_integral, density, exceedance
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.core.errors import InputError

#: Origins of h.
SEPARATIONS: Final = {
    "asperities": "from the mean of the asperity heights, which spread by sigma",
    "surface": "from the mean of the surface heights; the asperities spread by less",
}


class Regime(NamedTuple):
    """Pressure ``stress``·∫_lower^upper s^power Φ(h* + s) ds of the asperities in one regime."""

    stress: float
    power: float
    lower: float
    upper: float

    def integral(
        self, h_star: FloatArray, weight: Callable[[FloatArray], FloatArray] = density
    ) -> FloatArray:
        """Return the regime's pressure [Pa], or with another weight its integral, shape of ``h_star``."""
        return self.stress * asperity_integral(h_star, self.power, self.lower, self.upper, weight)


def total(regimes: tuple[Regime, ...], h_star: FloatArray) -> FloatArray:
    """Return the sum of the integrals of all regimes, shape of ``h_star``."""
    return np.asarray(np.sum([regime.integral(h_star) for regime in regimes], axis=0))


@dataclass(frozen=True)
class AsperityLaw(ContactLaw):
    """One rough surface of spherical asperities against a smooth plane, each alone.

    A law of this kind gives the ``regimes`` of its pressure [Pa] and the ``area_regimes`` of its real
    area fraction [1], both for asperity heights of the spread of :attr:`summits`.

    ``pair``, ``damping_factor``, ``restitution``, ``design_pressure``: see :class:`ContactLaw`;
    ``separation_from``: one of :data:`SEPARATIONS`.
    """

    _: KW_ONLY
    separation_from: str = "asperities"

    def __post_init__(self) -> None:
        """Refuse a reference that does not exist or surfaces that have none."""
        super().__post_init__()
        if self.separation_from not in SEPARATIONS:
            raise InputError(
                f"given {self.separation_from!r}; allowed: {', '.join(SEPARATIONS)}",
                key="contact.separation_from",
            )
        if self.separation_from == "surface" and self.pair.asperity_parameter <= 0.0193:
            raise InputError(
                "the asperities would have no spread left: the product of asperity density, radius and "
                f"roughness must exceed 0.0193, not {self.pair.asperity_parameter:.3g}",
                key="contact.separation_from",
            )

    @property
    @abstractmethod
    def regimes(self) -> tuple[Regime, ...]:
        """Pressure of each regime of interference."""

    @property
    @abstractmethod
    def area_regimes(self) -> tuple[Regime, ...]:
        """Share of real contact area of each regime of interference."""

    @cached_property
    def summits(self) -> SurfacePair:
        """The surfaces, with the spread of the asperity heights for a roughness."""
        if self.separation_from == "asperities":
            return self.pair
        eta = self.pair.asperity_parameter
        share = math.sqrt(1.0 - 3.717e-4 / (eta * eta))
        first, second = self.pair.roughness
        return replace(self.pair, roughness=(share * first, share * second))

    def above_summits(self, h_star: FloatArray) -> FloatArray:
        """Return the separation from the mean of the asperity heights over their spread [1]."""
        h = np.asarray(h_star, dtype=np.float64)
        if self.separation_from == "asperities":
            return h
        spread = self.summits.roughness_rms / self.pair.roughness_rms
        return np.asarray((h - 0.045944 / self.pair.asperity_parameter) / spread)

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return P_k, the sum over the regimes [Pa], shape of ``h_star`` [1]."""
        return total(self.regimes, self.above_summits(h_star))

    def real_area_fraction(self, h_star: FloatArray) -> FloatArray:
        """Return the real contact area over the nominal one [1], shape of ``h_star`` [1]."""
        return total(self.area_regimes, self.above_summits(h_star))

    def touching_share(self, h_star: FloatArray) -> FloatArray:
        """Return the share of asperities that touch [1], shape of ``h_star`` [1]."""
        return exceedance(self.above_summits(h_star))

    def contact_count(self, h_star: FloatArray) -> FloatArray:
        """Return the number of asperities in contact per area [1/m²], shape of ``h_star`` [1]."""
        return self.pair.asperity_density * self.touching_share(h_star)
