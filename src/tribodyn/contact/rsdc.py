"""Rough-surface damping contact (RSDC), Eqs. 5-10 of the source paper.

The stiffness is that of Kogut and Etsion. The damping follows from the work that the asperities take on closing
from far apart: what goes into plastic deformation is lost, which gives a restitution and by it a damping
factor. The elastic-plastic regimes count in both works, as printed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from tribodyn.contact.kogut_etsion import KogutEtsion
from tribodyn.contact.quadrature import asperity_integral, exceedance
from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class RSDC(KogutEtsion):
    """Kogut-Etsion stiffness with the damping of the energy lost in plastic asperities."""

    name: ClassVar[str] = "rsdc"

    def works(self, h_star: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return W_e/σ and W_p/σ [Pa], works per area on closing from far apart (Eqs. 5-6).

        Both have the shape of ``h_star`` [1].
        """
        parts = (regime.integral(h_star, exceedance) for regime in self.regimes)
        elastic, elastic_plastic_1, elastic_plastic_2, plastic = parts
        both = elastic_plastic_1 + elastic_plastic_2
        return elastic + both, plastic + both

    def loss_factor(self, h_star: FloatArray) -> FloatArray:
        """Return μ = W_p/W_e [1], shape of ``h_star``; NaN where both works underflow (h* above 35)."""
        elastic, plastic = self.works(h_star)
        with np.errstate(invalid="ignore"):
            return np.asarray(plastic / elastic)

    def restitution(self, h_star: FloatArray) -> FloatArray:
        """Return e = 1/√(μ + 1) [1], shape of ``h_star``."""
        return np.asarray(1.0 / np.sqrt(self.loss_factor(h_star) + 1.0))

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return C = Eξ√β σ^1.5 · μ/(μ + 1) · ∫_0^∞ s^1.5 Φ(h* + s) ds [Pa], shape of ``h_star`` [1]."""
        pair = self.pair
        stress = pair.composite_modulus * pair.asperity_parameter
        stress *= math.sqrt(pair.roughness_rms / pair.asperity_radius)
        elastic, plastic = self.works(h_star)
        total = np.maximum(elastic + plastic, np.finfo(np.float64).tiny)  # far apart both underflow to 0
        return stress * plastic / total * asperity_integral(h_star, 1.5, 0.0, math.inf)
