"""From spectral moments to the asperities of contact laws.

A random surface of Gaussian heights is known by m0, m2, m4 (Nayak, P. R. (1971), Random process model of
rough surfaces, Journal of Lubrication Technology 93, 398-407). Its summits, as the laws of Greenwood and
Williamson's kind need them, follow as in McCool, J. I. (1986), Comparison of models for the contact of
rough surfaces, Wear 107, 37-60. Valid for isotropic Gaussian surfaces, whose α is at least 1.5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from tribodyn.surfaces.moments import Moments

LEAST_BANDWIDTH: Final = 1.5
"""α of an isotropic Gaussian surface with a single wavelength; none is below it."""


@dataclass(frozen=True)
class Asperities:
    """The equivalent sphere-tipped asperities of a random surface.

    Attributes
    ----------
    density
        Summits per area ξ = m4/(6π√3 m2) [1/m²].
    radius
        Radius β = ⅜√(π/m4) of the mean curvature of the summits [m].
    bandwidth
        α = m0 m4/m2² [1].
    summit_rms
        Standard deviation of summit heights σ_s = √((1 − 0.8968/α) m0) [m].
    summit_offset
        Mean height of the summits above the mean plane 4√(m0/(πα)) [m].
    """

    density: float
    radius: float
    bandwidth: float
    summit_rms: float
    summit_offset: float

    def plasticity_index(self, modulus: float, hardness: float) -> float:
        """Return ψ = (E/H)√(σ_s/β) [1] (Greenwood and Williamson 1966): below 0.6 elastic, above 1 plastic.

        Parameters
        ----------
        modulus
            Composite modulus E of both bodies [Pa].
        hardness
            H of the softer body [Pa].

        Returns
        -------
        float
            ψ [1].
        """
        return modulus / hardness * math.sqrt(self.summit_rms / self.radius)


def asperities(moments: Moments) -> Asperities:
    """Return the asperities of a surface with these moments.

    Parameters
    ----------
    moments
        Of the spectrum of a profile, m2 and m4 above zero.

    Returns
    -------
    Asperities
        Density [1/m²], radius and spread of the heights [m].

    Raises
    ------
    ZeroDivisionError
        The surface is flat: m2 or m4 is zero.
    """
    alpha = moments.m0 * moments.m4 / moments.m2**2
    return Asperities(
        density=moments.m4 / (6.0 * math.pi * math.sqrt(3.0) * moments.m2),
        radius=0.375 * math.sqrt(math.pi / moments.m4),
        bandwidth=alpha,
        summit_rms=math.sqrt(max(1.0 - 0.8968 / alpha, 0.0) * moments.m0),
        summit_offset=4.0 * math.sqrt(moments.m0 / (math.pi * alpha)),
    )
