"""Rough-surface damping contact (RSDC), Eqs. 5-10 of the source paper.

The stiffness is that of Kogut and Etsion. The damping follows from the work that the asperities take on
closing from far apart: what goes into plastic deformation is lost, which gives a restitution and by it a
damping factor. The elastic-plastic regimes count in both works, as printed.
"""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.contact_law import asperity_integral, exceedance
from tribodyn.contact.elastic_plastic import KogutEtsion


@dataclass(frozen=True)
class RSDC(KogutEtsion):
    """Kogut-Etsion stiffness with damping by the energy lost in plastic asperities.

    Parameters
    ----------
    pair, restitution, design_pressure, separation_from
        See the classes above; without a ``restitution`` the law takes that of its own energy balance.
    damping_factor
        Name of the factor that turns the restitution into damping, one of ``DAMPING_FACTORS``.
    """

    name: ClassVar[str] = "rsdc"
    title: ClassVar[str] = "the paper's: Kogut-Etsion with damping by the energy lost in plastic asperities"
    source: ClassVar[str] = "the source paper, Eqs. 2-10"
    knows_restitution: ClassVar[bool] = True

    damping_factor: str = "lankarani-nikravesh"

    def works(self, h_star: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the elastic and the plastic work per area on closing from far apart.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        elastic, plastic : numpy.ndarray
            W_e/σ and W_p/σ [Pa], shape of ``h_star``; σ is the spread of the asperities.
        """
        h = self.above_summits(h_star)
        parts = [regime.integral(h, exceedance) for regime in self.regimes]
        elastic, elastic_plastic_1, elastic_plastic_2, plastic = parts
        both = elastic_plastic_1 + elastic_plastic_2
        return elastic + both, plastic + both

    def loss_factor(self, h_star: FloatArray) -> FloatArray:
        """Return μ = W_p/W_e.

        Where both works underflow (h* above 35) it is their limit 0: so far apart contact is elastic.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1], shape of ``h_star``.
        """
        elastic, plastic = self.works(h_star)
        return np.divide(plastic, elastic, out=np.zeros_like(plastic), where=plastic > 0.0)

    def meant_restitution(self, h_star: FloatArray) -> FloatArray:
        """Return e = 1/√(μ + 1), or the restitution asked for.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1], shape of ``h_star``.
        """
        if self.restitution is not None:
            return super().meant_restitution(h_star)
        return np.asarray(1.0 / np.sqrt(self.loss_factor(h_star) + 1.0))

    def damping_for(self, ratio: FloatArray, h_star: FloatArray) -> FloatArray:
        """Return C = (4/3)a·Eξ√β σ^1.5 ∫_0^∞ s^1.5 Φ(h* + s) ds.

        With the Lankarani-Nikravesh factor (4/3)a = 1 − e² = μ/(μ + 1), which is Eq. 10.

        Parameters
        ----------
        ratio
            (4/3)a of the damping factor [1], shape of ``h_star``.
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [Pa], shape of ``h_star``.
        """
        pair = self.summits
        stress = pair.composite_modulus * pair.asperity_parameter
        stress *= math.sqrt(pair.roughness_rms / pair.asperity_radius)
        h = self.above_summits(h_star)
        return 4.0 / 3.0 * stress * ratio * asperity_integral(h, 1.5, 0.0, math.inf)
