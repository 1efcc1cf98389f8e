"""Elastic-plastic contact of rough surfaces after Kogut and Etsion, Eqs. 2-4 of the source paper.

Each asperity of interference s·σ carries a load that is a power of s, different in four regimes: elastic
up to the critical interference δ_c, elastic-plastic up to 6 δ_c and up to 110 δ_c, fully plastic beyond.
Gaussian heights make the pressure the sum of four integrals. Source: Kogut, L. and Etsion, I. (2003), A
finite element based elastic-plastic model for the contact of rough surfaces, Tribology Transactions 46,
383-390. The fully plastic part has s¹, not the printed s⁻¹.

Valid for spherical, independent asperities of one radius under moderate load, h* > -4. The published load of
an asperity jumps by up to 8 % from one regime to the next; the pressure, an integral over heights, does not.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from tribodyn.contact.base import ContactLaw
from tribodyn.contact.quadrature import asperity_integral, density
from tribodyn.core.arrays import FloatArray


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


class Regimes(NamedTuple):
    """The four regimes in the order of growing interference."""

    elastic: Regime
    elastic_plastic_1: Regime
    elastic_plastic_2: Regime
    plastic: Regime


@dataclass(frozen=True)
class KogutEtsion(ContactLaw):
    """The Kogut-Etsion law; it stores and returns all energy, so its damping is zero."""

    name: ClassVar[str] = "ke"

    @property
    def regimes(self) -> Regimes:
        """The four integrals of Eqs. 2-4."""
        pair, d = self.pair, self.pair.critical_interference_star
        plastic = 2.0 * math.pi * pair.hardness * pair.asperity_parameter
        yielding = plastic * pair.hardness_coefficient / 3.0
        return Regimes(
            Regime(yielding * d**-0.5, 1.5, 0.0, d),
            Regime(yielding * 1.03 * d**-0.425, 1.425, d, 6.0 * d),
            Regime(yielding * 1.40 * d**-0.263, 1.263, 6.0 * d, 110.0 * d),
            Regime(plastic, 1.0, 110.0 * d, math.inf),
        )

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return P_k = P_e + P_ep1 + P_ep2 + P_p [Pa], shape of ``h_star`` [1]."""
        return np.asarray(np.sum([regime.integral(h_star) for regime in self.regimes], axis=0))

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return zeros [Pa], shape of ``h_star`` [1]."""
        return np.zeros(np.shape(h_star))
