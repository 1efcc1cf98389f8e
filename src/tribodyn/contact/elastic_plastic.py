"""Elastic-plastic contact of rough surfaces after Kogut and Etsion, and after Jackson and Green.

Each asperity of interference s·σ carries a load that is a power of s, different in four regimes: elastic
up to the critical interference δ_c, elastic-plastic up to 6 δ_c and up to 110 δ_c, fully plastic beyond.
Gaussian heights make the pressure the sum of four integrals. Source: Kogut, L. and Etsion, I. (2003), A
finite element based elastic-plastic model for the contact of rough surfaces, Tribology Transactions 46,
383-390. The fully plastic part has s¹, not the printed s⁻¹.

Valid for spherical, independent asperities of one radius under moderate load, h* > -4. The published load of
an asperity jumps by up to 8 % from one regime to the next; the pressure, an integral over heights, does not.

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
from typing import ClassVar, Final, NamedTuple

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact.asperities import AsperityLaw, Regime
from tribodyn.contact.contact_law import height_integral


class Regimes(NamedTuple):
    """The four regimes in the order of growing interference."""

    elastic: Regime
    elastic_plastic_1: Regime
    elastic_plastic_2: Regime
    plastic: Regime


@dataclass(frozen=True)
class KogutEtsion(AsperityLaw):
    """The Kogut-Etsion law; without a damping factor it stores and returns all energy."""

    name: ClassVar[str] = "ke"
    title: ClassVar[str] = "Kogut-Etsion: elastic to plastic asperities, fitted to finite elements"
    source: ClassVar[str] = "Kogut and Etsion, Tribology Transactions 46 (2003) 383-390"
    validity: ClassVar[str] = "plasticity index 0.5 to 8; real area below a few percent"

    @property
    def regimes(self) -> Regimes:
        """The four integrals of Eqs. 2-4."""
        pair, d = self.summits, self.summits.critical_interference_star
        plastic = 2.0 * math.pi * pair.hardness * pair.asperity_parameter
        yielding = plastic * pair.hardness_coefficient / 3.0
        return Regimes(
            Regime(yielding * portable.power(d, -0.5), 1.5, 0.0, d),
            Regime(yielding * 1.03 * portable.power(d, -0.425), 1.425, d, 6.0 * d),
            Regime(yielding * 1.40 * portable.power(d, -0.263), 1.263, 6.0 * d, 110.0 * d),
            Regime(plastic, 1.0, 110.0 * d, math.inf),
        )

    @property
    def area_regimes(self) -> Regimes:
        """Areas over πβδ_c: w, 0.93 w^1.136, 0.94 w^1.146 and 2w of an asperity with w = δ/δ_c."""
        pair, d = self.summits, self.summits.critical_interference_star
        flat = math.pi * pair.asperity_parameter
        return Regimes(
            Regime(flat, 1.0, 0.0, d),
            Regime(0.93 * flat * portable.power(d, -0.136), 1.136, d, 6.0 * d),
            Regime(0.94 * flat * portable.power(d, -0.146), 1.146, 6.0 * d, 110.0 * d),
            Regime(2.0 * flat, 1.0, 110.0 * d, math.inf),
        )


@dataclass(frozen=True)
class ChangEtsionBogy(AsperityLaw):
    """Elastic asperities, and plastic ones that keep their volume."""

    name: ClassVar[str] = "ceb"
    title: ClassVar[str] = "Chang-Etsion-Bogy: elastic asperities, plastic ones keep their volume"
    source: ClassVar[str] = "Chang, Etsion and Bogy, J. Tribol. 109 (1987) 257-263; K of 1988"
    validity: ClassVar[str] = "no elastic-plastic stage; real area below a few percent"

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """The load of Hertz, then KH times the area."""
        pair, d = self.summits, self.summits.critical_interference_star
        elastic = 4.0 / 3.0 * pair.composite_modulus * pair.asperity_parameter
        elastic *= math.sqrt(pair.roughness_rms / pair.asperity_radius)
        mean = pair.hardness_coefficient * pair.hardness
        plastic = (regime._replace(stress=mean * regime.stress) for regime in self._plastic_area(d))
        return (Regime(elastic, 1.5, 0.0, d), *plastic)

    @property
    def area_regimes(self) -> tuple[Regime, ...]:
        """The area of Hertz, then that of conserved volume."""
        d = self.summits.critical_interference_star
        return (Regime(math.pi * self.summits.asperity_parameter, 1.0, 0.0, d), *self._plastic_area(d))

    def _plastic_area(self, d: float) -> tuple[Regime, Regime]:
        """Return πβδ(2 − δ_c/δ) as two powers of the interference."""
        flat = math.pi * self.summits.asperity_parameter
        return Regime(2.0 * flat, 1.0, d, math.inf), Regime(-flat * d, 0.0, d, math.inf)


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
