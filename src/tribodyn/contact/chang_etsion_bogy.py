"""Elastic-plastic contact of rough surfaces after Chang, Etsion and Bogy (CEB).

An asperity is Hertzian up to the critical interference δ_c. Beyond, the volume of its tip is conserved: its
area is πβδ(2 − δ_c/δ), and it carries KH on all of it.

As published, the mean pressure of an asperity jumps from (2/3)KH to KH where it yields; the pressure of the
surface, an integral over heights, is smooth.
"""

import math
from dataclasses import dataclass
from typing import ClassVar

from tribodyn.contact.asperities import AsperityLaw, Regime


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
