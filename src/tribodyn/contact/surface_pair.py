"""The two rough surfaces in contact and the numbers that follow from them."""

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
