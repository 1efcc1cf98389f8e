"""The two rough surfaces in contact, the numbers that follow from them, and their flash temperature.

A round spot of radius a, over which the flux q is spread evenly, moves at the speed V over a half-space of
conductivity k and diffusivity κ. At rest its centre is q a/k warmer; where it passes faster than heat spreads
sideways, V a/κ ≫ 1, its end is (2 q/k) √(2 a κ/(π V)) warmer, as a surface heated for the time 2 a/V
(Carslaw and Jaeger, Conduction of heat in solids, 1959; Jaeger, Moving sources of heat and the temperature at
sliding contacts, J. Proc. R. Soc. N. S. W. 76 (1942) 203-224). Between them the reciprocals of the squares
add up, within 3 % of Jaeger's integral at any speed:

    ΔT = q a/(k √(1 + π Pe/4)),  Pe = V a/(2 κ).
"""

import math
from dataclasses import dataclass, fields

from tribodyn.core.errors import InputError


@dataclass(frozen=True)
class SurfacePair:
    """Two rough surfaces; the first of each pair of numbers is the trunnion, the second the bushing.

    Parameters
    ----------
    young_modulus
        E₁, E₂ [Pa].
    poisson_ratio
        ν₁, ν₂ [1].
    roughness
        Root-mean-square roughness σ₁, σ₂ [m].
    hardness
        H of the softer body, the bushing [Pa].
    asperity_density
        Asperities per area ξ of the equivalent rough surface [1/m²].
    asperity_radius
        Mean radius β of the asperity tips [m].
    loss_factor
        η₁, η₂ of the bodies, tan δ [1].
    """

    young_modulus: tuple[float, float]
    poisson_ratio: tuple[float, float]
    roughness: tuple[float, float]
    hardness: float
    asperity_density: float
    asperity_radius: float
    loss_factor: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        """Refuse surfaces for which the laws have no meaning."""
        for entry in fields(self):
            if entry.name not in ("poisson_ratio", "roughness", "loss_factor"):
                _require_positive(entry.name, getattr(self, entry.name))
        if min(self.roughness) < 0.0 or not 0.0 < math.hypot(*self.roughness) < math.inf:
            raise InputError(f"must not be negative nor both zero, not {self.roughness}", key="roughness")
        if not all(-1.0 < nu <= 0.5 for nu in self.poisson_ratio):
            raise InputError(f"must lie in (-1, 0.5], not {self.poisson_ratio}", key="poisson_ratio")

    @property
    def composite_modulus(self) -> float:
        """E = 1/[(1 − ν₁²)/E₁ + (1 − ν₂²)/E₂] [Pa]."""
        return 1.0 / sum(self._compliances)

    @property
    def composite_loss(self) -> float:
        """η of both bodies in series, each in proportion to its compliance [1]."""
        lost = zip(self.loss_factor, self._compliances, strict=True)
        return self.composite_modulus * sum(eta * compliance for eta, compliance in lost)

    @property
    def _compliances(self) -> tuple[float, ...]:
        """(1 − ν²)/E of each body [1/Pa]."""
        both = zip(self.young_modulus, self.poisson_ratio, strict=True)
        return tuple((1.0 - (nu * nu)) / modulus for modulus, nu in both)

    @property
    def roughness_rms(self) -> float:
        """σ = √(σ₁² + σ₂²) [m]."""
        return math.hypot(*self.roughness)

    @property
    def hardness_coefficient(self) -> float:
        """K = 0.454 + 0.41 ν₂ [1], ν of the softer body."""
        return 0.454 + 0.41 * self.poisson_ratio[1]

    @property
    def critical_interference(self) -> float:
        """δ_c = (πKH/2E)² β [m], at which an asperity begins to yield."""
        ratio = math.pi * self.hardness_coefficient * self.hardness / (2.0 * self.composite_modulus)
        return (ratio * ratio) * self.asperity_radius

    @property
    def critical_interference_star(self) -> float:
        """δ_c* = δ_c/σ [1]."""
        return self.critical_interference / self.roughness_rms

    @property
    def asperity_parameter(self) -> float:
        """ξβσ [1]."""
        return self.asperity_density * self.asperity_radius * self.roughness_rms


def _require_positive(name: str, value: float | tuple[float, float]) -> None:
    numbers = value if isinstance(value, tuple) else (value,)
    if not all(0.0 < number < math.inf for number in numbers):
        raise InputError(f"must be positive and finite, not {value}", key=name)


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
