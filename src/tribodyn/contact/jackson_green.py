"""Elastic-plastic contact of rough surfaces after Jackson and Green.

Up to 1.9 times the critical interference δ_c = (πC S_y/2E)² β, with C = 1.295 exp(0.736 ν), an asperity is
Hertzian. Beyond, with w = δ/δ_c and the load and area at δ_c, finite elements gave

    F/F_c = exp(−w^(5/12)/4) w^1.5 + (4H_G/(C S_y)) [1 − exp(−w^(5/9)/25)] w,   A/A_c = w (w/1.9)^B,

with B = 0.14 exp(23 S_y/E). The hardness falls as the contact radius a grows towards that of the asperity:
H_G/S_y = 2.84 [1 − exp(−0.82 (a/β)^(−0.7))]. The yield strength is taken as S_y = H/2.8 (Tabor).

The load jumps by less than 1 % at w = 1.9, as published. B was fitted for S_y/E up to 0.014 and grows without
bound; here it does so up to S_y/E = 0.05 only.
"""

import math
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.contact.asperities import AsperityLaw, Regime
from tribodyn.contact.contact_law import height_integral
from tribodyn.core.arrays import FloatArray

ELASTIC: Final = 1.9  #: Interference over δ_c up to which an asperity is elastic.
LARGEST_STRAIN: Final = 0.05  #: S_y/E beyond which the exponent B grows no more.


@dataclass(frozen=True)
class JacksonGreen(AsperityLaw):
    """Elastic-plastic asperities whose hardness depends on how far they are flattened."""

    name: ClassVar[str] = "jg"
    title: ClassVar[str] = "Jackson-Green: elastic to plastic asperities, hardness falls with flattening"
    source: ClassVar[str] = "Jackson and Green, J. Tribol. 127 (2005) 343-354; Tribol. Int. 39 (2006) 906-914"
    validity: ClassVar[str] = "contact radius below 0.4 of the tip radius; real area below a few percent"

    @property
    def _yield_factor(self) -> float:
        """C [1], ν of the softer body."""
        return 1.295 * float(portable.exp(0.736 * self.pair.poisson_ratio[1]))

    @property
    def _yield_strain(self) -> float:
        """S_y/E [1]."""
        return self.pair.hardness / 2.8 / self.pair.composite_modulus

    @property
    def _growth(self) -> float:
        """B [1]."""
        return 0.14 * float(portable.exp(23.0 * min(self._yield_strain, LARGEST_STRAIN)))

    @property
    def _critical(self) -> float:
        """δ_c over the spread of the asperities [1]."""
        slope = 0.5 * math.pi * self._yield_factor * self._yield_strain
        return (slope * slope) * self.pair.asperity_radius / self.summits.roughness_rms

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """The load of Hertz; what is beyond is no power of the interference."""
        pair = self.summits
        stress = 4.0 / 3.0 * pair.composite_modulus * pair.asperity_parameter
        stress *= math.sqrt(pair.roughness_rms / pair.asperity_radius)
        return (Regime(stress, 1.5, 0.0, ELASTIC * self._critical),)

    @property
    def area_regimes(self) -> tuple[Regime, ...]:
        """The area of Hertz, then w (w/1.9)^B."""
        flat, edge = math.pi * self.summits.asperity_parameter, ELASTIC * self._critical
        return (
            Regime(flat, 1.0, 0.0, edge),
            Regime(flat * portable.power(edge, -self._growth), 1.0 + self._growth, edge, math.inf),
        )

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return P_k [Pa], shape of ``h_star`` [1]."""
        stress = self.regimes[0].stress * portable.power(self._critical, 1.5)
        beyond = height_integral(
            self.above_summits(h_star),
            lambda s: self._relative_load(s / self._critical),
            ELASTIC * self._critical,
            math.inf,
        )
        return np.asarray(super().stiffness_pressure(h_star) + stress * beyond)

    def _relative_load(self, w: FloatArray) -> FloatArray:
        """Return F/F_c [1] beyond the elastic range, shape of ``w`` [1]."""
        slope = 0.5 * math.pi * self._yield_factor * self._yield_strain
        flattening = slope * np.sqrt(w) * portable.power(w / ELASTIC, 0.5 * self._growth)
        hardness = 2.84 * -portable.expm1(-0.82 * portable.power(flattening, -0.7))
        plastic = (
            4.0 * hardness / self._yield_factor * -portable.expm1(-portable.power(w, 5.0 / 9.0) / 25.0) * w
        )
        return np.asarray(portable.exp(-0.25 * portable.power(w, 5.0 / 12.0)) * w * np.sqrt(w) + plastic)
