"""Contact factor of Wu and Zheng.

φ_c = ∂h_T/∂h is the share of the gap's change that the mean gap h_T follows: it multiplies ∂h/∂θ and
∂h/∂t. Wu, C. and Zheng, L., ASME J. Tribology 111 (1989) 188-191; coefficients as in shared reference data.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.optimize import brentq

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quadrature import gauss_legendre

COEFFICIENTS: Final = (-0.6912, 0.782, -0.304, 0.0401)
"""ln φ_c as a cubic of H = h/σ, 0 ≤ H < 3."""
_INTERVALS: Final = 128


def contact_factor(separation: FloatArray) -> FloatArray:
    """Return φ_c at H = h/σ; its value at 0 below, 1 above.

    The published exponential passes 1 by 0.15 % just before H = 3, where it ends: φ_c stops at 1 instead, so
    that it has no jump.
    """
    h = np.clip(separation, 0.0, 3.0)
    return np.minimum(np.exp(np.polynomial.polynomial.polyval(h, COEFFICIENTS)), 1.0)


def reach() -> float:
    """Return the separation from which φ_c is 1."""
    return float(brentq(lambda h: np.polynomial.polynomial.polyval(h, COEFFICIENTS), 2.5, 3.0, xtol=1e-15))


def mean_gap_nodes() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return H, h_T/σ = reach − ∫ φ_c dH and φ_c at the ends of equal intervals from 0 to :func:`reach`."""
    h = np.linspace(0.0, reach(), _INTERVALS + 1)
    points, weights = gauss_legendre(8)
    half = 0.5 * (h[1] - h[0])
    samples = contact_factor((h[:-1] + half)[:, None] + half * points)
    pieces = half * samples @ weights
    above = np.append(np.cumsum(pieces[::-1])[::-1], 0.0)
    return h, h[-1] - above, contact_factor(h)
