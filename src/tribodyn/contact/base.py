"""What a contact law is."""

from __future__ import annotations

from typing import Protocol

from tribodyn.core.arrays import FloatArray


class ContactLaw(Protocol):
    """Two functions of the separation h* = h/σ; nothing else is asked of a law.

    Both take an array of any shape and return an array of that shape. A law is evaluated when it is
    tabulated and by its users' plots, never inside a simulation.
    """

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the pressure P_k(h*) [Pa] of the surfaces at rest."""
        ...

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the coefficient C(h*) [Pa] of the damping pressure P_d = C·δ̇/δ̇₋, zeros for no damping."""
        ...
