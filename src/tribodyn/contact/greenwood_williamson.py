"""Elastic contact of a rough surface with a plane after Greenwood and Williamson.

Hertzian asperities of one radius: load (4/3)E√β δ^1.5, area πβδ. With F_n(h*) = ∫_0^∞ s^n Φ(h* + s) ds

    P = (4/3) E ξβσ √(σ/β) F_{3/2}(h*),   A/A_n = π ξβσ F_1(h*),   contacts = ξ F_0(h*).
"""

import math
from dataclasses import dataclass
from typing import ClassVar

from tribodyn.contact.asperities import AsperityLaw, Regime


@dataclass(frozen=True)
class GreenwoodWilliamson(AsperityLaw):
    """The limit that every elastic-plastic law here has for hard, smooth surfaces."""

    name: ClassVar[str] = "gw"
    title: ClassVar[str] = "Greenwood-Williamson: elastic asperities against a plane"
    source: ClassVar[str] = "Greenwood and Williamson, Proc. R. Soc. A 295 (1966) 300-319"
    validity: ClassVar[str] = "plasticity index below 0.6; real area below a few percent"

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """The load of Hertz at every interference."""
        pair = self.summits
        stress = 4.0 / 3.0 * pair.composite_modulus * pair.asperity_parameter
        stress *= math.sqrt(pair.roughness_rms / pair.asperity_radius)
        return (Regime(stress, 1.5, 0.0, math.inf),)

    @property
    def area_regimes(self) -> tuple[Regime, ...]:
        """The area of Hertz at every interference."""
        return (Regime(math.pi * self.summits.asperity_parameter, 1.0, 0.0, math.inf),)
