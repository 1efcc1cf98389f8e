"""Linear contact pressure (penalty), the baseline of multibody programs.

The surfaces are taken as smooth: P = κ·(penetration of the mean planes), nothing before they meet at h = 0.
The corner there is rounded over a tenth of σ, as if the roughness were that small:

    P = κσw F_1(h*/w),   w = 0.1,   F_1(x) = ∫_0^∞ s Φ(x + s) ds → −x for x ≪ 0.
"""

import math
from dataclasses import KW_ONLY, dataclass
from typing import ClassVar, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.contact_law import ContactLaw, asperity_integral, exceedance
from tribodyn.contact.parameter import parameter

CORNER: Final = 0.1  #: w, in units of σ; the table of the law has 13 nodes on it.


@dataclass(frozen=True)
class LinearContact(ContactLaw):
    """A bed of equal springs.

    ``pair``, ``damping_factor``, ``restitution``, ``design_pressure``: see :class:`ContactLaw`;
    ``penalty_stiffness``: pressure per penetration κ [Pa/m].
    """

    name: ClassVar[str] = "linear"
    title: ClassVar[str] = "linear (penalty): smooth surfaces on springs"
    source: ClassVar[str] = "common in multibody programs; its stiffness is a choice"
    validity: ClassVar[str] = "none: a baseline that knows nothing of the roughness"

    _: KW_ONLY
    penalty_stiffness: float = parameter(
        5.0e13, "MPa/um", "pressure per penetration of the law linear", above=0.0
    )

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the pressure [Pa], shape of ``h_star`` [1]."""
        x = np.asarray(h_star, dtype=np.float64) / CORNER
        stress = self.penalty_stiffness * self.pair.roughness_rms * CORNER
        # Far inside the integral is −x to rounding, and its quadrature is not made for that.
        inside = np.maximum(-x, 0.0)
        return np.asarray(stress * np.where(x < -8.0, inside, asperity_integral(x, 1.0, 0.0, math.inf)))

    def touching_share(self, h_star: FloatArray) -> FloatArray:
        """Return the share of springs that touch [1]: a rounded step at h* = 0, shape of ``h_star``."""
        return exceedance(np.asarray(h_star, dtype=np.float64) / CORNER)
