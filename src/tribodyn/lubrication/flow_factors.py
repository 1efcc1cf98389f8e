"""Flow factors of Patir and Cheng for any Peklenik number between 1/9 and 9.

Patir, N. and Cheng, H. S., ASME J. Lubrication Technology 100 (1978) 12-17 and 101 (1979) 220-230. H = h/σ;
the Peklenik number γ is the ratio of the correlation lengths along and across the sliding direction.

    φ_x = 1 − C exp(−r H)  (γ ≤ 1),   1 + C H^−r  (γ > 1),   φ_z(H, γ) = φ_x(H, 1/γ)
    Φ_s = A_1 H^α1 exp(−α2 H + α3 H²)  (H ≤ 5),   A_2 exp(−H/4)  (H > 5)

Between the published γ the factors, not their coefficients, are interpolated linearly in ln γ, because the
two formulas for φ_x have no coefficients in common. The branch of Φ_s above H = 5 is joined to the one below
(the published A_2 leave a jump of up to 2e-4).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError

PEKLENIK: Final = (1 / 9, 1 / 6, 1 / 3, 1.0, 3.0, 6.0, 9.0)

PRESSURE: Final = (
    (1.48, 0.42, 1.0),
    (1.38, 0.42, 1.0),
    (1.18, 0.42, 0.75),
    (0.90, 0.56, 0.5),
    (0.225, 1.5, 0.5),
    (0.520, 1.5, 0.5),
    (0.870, 1.5, 0.5),
)
"""C, r and the least H of validity, one row a γ."""

SHEAR: Final = (
    (2.046, 1.12, 0.78, 0.03, 1.856),
    (1.962, 1.08, 0.77, 0.03, 1.754),
    (1.858, 1.01, 0.76, 0.03, 1.561),
    (1.899, 0.98, 0.92, 0.05, 1.126),
    (1.560, 0.85, 1.13, 0.08, 0.556),
    (1.290, 0.62, 1.09, 0.08, 0.388),
    (1.011, 0.54, 1.07, 0.08, 0.295),
)
"""A_1, α_1, α_2, α_3 and the published A_2, one row a γ."""

BRANCH: Final = 5.0
"""H at which Φ_s changes its formula."""


def pressure_factor(separation: FloatArray, peklenik: float) -> FloatArray:
    """Return φ_x at H = h/σ for a Peklenik number; φ_z is that of its inverse."""
    return _between(_pressure_row, np.asarray(separation, dtype=np.float64), peklenik)


def shear_factor(separation: FloatArray, peklenik: float) -> FloatArray:
    """Return Φ_s at H = h/σ of one surface that moves against a smooth one at rest."""
    return _between(_shear_row, np.asarray(separation, dtype=np.float64), peklenik)


def _pressure_row(h: FloatArray, row: int) -> FloatArray:
    c, r, _ = PRESSURE[row]
    return np.asarray(1.0 - c * np.exp(-r * h) if PEKLENIK[row] <= 1.0 else 1.0 + c * h**-r)


def _shear_row(h: FloatArray, row: int) -> FloatArray:
    a, alpha_1, alpha_2, alpha_3, _ = SHEAR[row]
    low = np.minimum(h, BRANCH)
    below = a * low**alpha_1 * np.exp(-alpha_2 * low + alpha_3 * low**2)
    return np.asarray(below * np.exp(-0.25 * np.maximum(h - BRANCH, 0.0)))


def _between(rows: Callable[[FloatArray, int], FloatArray], h: FloatArray, peklenik: float) -> FloatArray:
    """Interpolate linearly in ln γ between the two published Peklenik numbers around ``peklenik``."""
    if not PEKLENIK[0] * (1.0 - 1e-12) <= peklenik <= PEKLENIK[-1] * (1.0 + 1e-12):
        raise InputError(
            f"a Peklenik number of {peklenik:g}; the flow factors are known from 1/9 to 9",
            key="film.peklenik",
        )
    place = float(np.interp(np.log(peklenik), np.log(PEKLENIK), np.arange(len(PEKLENIK))))
    row = min(int(place), len(PEKLENIK) - 2)
    share = place - row
    if share == 0.0:
        return rows(h, row)
    return (1.0 - share) * rows(h, row) + share * rows(h, row + 1)
