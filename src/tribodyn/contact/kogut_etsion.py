"""Elastic-plastic contact after Chang, Etsion and Bogy (CEB) and Kogut and Etsion, Eqs. 2-4 of the paper.

Each asperity of interference s·σ carries a load that is a power of s, different in four regimes: elastic
up to the critical interference δ_c, elastic-plastic up to 6 δ_c and up to 110 δ_c, fully plastic beyond.
Gaussian heights make the pressure the sum of four integrals. Source: Kogut, L. and Etsion, I. (2003), A
finite element based elastic-plastic model for the contact of rough surfaces, Tribology Transactions 46,
383-390. The fully plastic part has s¹, not the printed s⁻¹.

Valid for spherical, independent asperities of one radius under moderate load, h* > -4. The published load of
an asperity jumps by up to 8 % from one regime to the next; the pressure, an integral over heights, does not.
"""

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from mebdf.kernels.elementary import portable
from tribodyn.contact.asperities import AsperityLaw, Regime


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
