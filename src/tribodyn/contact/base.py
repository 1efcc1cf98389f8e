"""What a contact law is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class ContactLaw(ABC):
    """Two functions of the separation h* = h/σ; nothing else is asked of a law.

    Both take an array of any shape and return an array of that shape. A law is evaluated when it is
    tabulated and where a user plots it, never inside a simulation.

    Parameters
    ----------
    pair
        The surfaces in contact.
    """

    name: ClassVar[str]
    pair: SurfacePair

    @abstractmethod
    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the pressure P_k(h*) [Pa] of the surfaces at rest."""

    @abstractmethod
    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the coefficient C(h*) [Pa] of the damping pressure P_d = C·δ̇/δ̇₋, zeros for no damping."""

    def pressure(self, gap: FloatArray) -> FloatArray:
        """Return the pressure P_k [Pa] of the surfaces at rest, shape of ``gap`` [m]."""
        return self.stiffness_pressure(np.asarray(gap, dtype=np.float64) / self.pair.roughness_rms)
