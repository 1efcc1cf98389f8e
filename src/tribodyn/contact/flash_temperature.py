"""Flash temperature: the rise of a sliding contact of asperities above its surroundings, an estimate.

A round spot of radius a, over which the flux q is spread evenly, moves at the speed V over a half-space of
conductivity k and diffusivity κ. At rest its centre is q a/k warmer; where it passes faster than heat spreads
sideways, V a/κ ≫ 1, its end is (2 q/k) √(2 a κ/(π V)) warmer, as a surface heated for the time 2 a/V
(Carslaw and Jaeger, Conduction of heat in solids, 1959; Jaeger, Moving sources of heat and the temperature at
sliding contacts, J. Proc. R. Soc. N. S. W. 76 (1942) 203-224). Between them the reciprocals of the squares
add up, within 3 % of Jaeger's integral at any speed:

    ΔT = q a/(k √(1 + π Pe/4)),  Pe = V a/(2 κ).
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Conductor:
    """Thermal properties of a body."""

    conductivity: float  #: k [W/(m K)].
    diffusivity: float  #: κ [m²/s].


def resistance(body: Conductor, radius: float, speed: float) -> float:
    """Return ΔT/q of a spot of a radius [m] that moves over a body at a speed [m/s] [m² K/W]."""
    peclet = speed * radius / (2.0 * body.diffusivity)
    return radius / (body.conductivity * math.sqrt(1.0 + 0.25 * math.pi * peclet))


def flash_temperature(
    flux: float, radius: float, speed: float, standing: Conductor, passing: Conductor
) -> float:
    """Return the temperature rise of a spot above the surfaces around it [K].

    The heat goes into both bodies as their largest temperatures are the same. Valid where spots are far apart
    and each lasts longer than heat takes to spread in it, a²/κ: for shorter ones this is an upper bound.

    ``flux``: heat of friction over the area of the spot [W/m²]; ``radius``, ``speed``: of the spot [m], and
    of sliding [m/s]; ``standing``, ``passing``: the body that the spot belongs to, and the one it moves over.
    """
    into = 1.0 / resistance(standing, radius, 0.0) + 1.0 / resistance(passing, radius, speed)
    return flux / into
