"""Roughness of the two surfaces of a film."""

from __future__ import annotations

import math
from dataclasses import dataclass

from tribodyn.core.errors import InputError


@dataclass(frozen=True)
class Roughness:
    """Rms roughness and lay of shaft (surface 1, which moves) and bushing (surface 2).

    Attributes
    ----------
    rms
        σ_1 and σ_2 [m]; both 0 for smooth surfaces.
    peklenik
        γ_1 and γ_2 [1]: correlation length along over across the sliding direction, 1 for isotropic surfaces.
    """

    rms: tuple[float, float] = (0.0, 0.0)
    peklenik: tuple[float, float] = (1.0, 1.0)

    def __post_init__(self) -> None:
        """Refuse a negative roughness."""
        if not all(0.0 <= rms < math.inf for rms in self.rms):
            raise InputError(
                f"rms roughness {self.rms}; give two values of 0 m or more", key="film.roughness"
            )

    @property
    def combined(self) -> float:
        """σ = √(σ_1² + σ_2²) [m]."""
        return math.hypot(*self.rms)

    @property
    def shares(self) -> tuple[float, float]:
        """Shares (σ_1/σ)² and (σ_2/σ)² of the variance [1]; halves for smooth surfaces."""
        if self.combined == 0.0:
            return 0.5, 0.5
        return (self.rms[0] / self.combined) ** 2, (self.rms[1] / self.combined) ** 2
