"""Shear-stress factors of Patir and Cheng: how roughness changes the friction of the film.

Patir, N. and Cheng, H. S., ASME J. Lubrication Technology 101 (1979) 220-230. The mean shear stress on the
moving surface is φ_f η U/h + φ_fp (h/2) ∂p/∂x. φ_f = ⟨h/h_T⟩ depends on the heights alone (a polynomial
density within ±3σ; local gaps count from σ/100, or the mean would not exist). φ_fp is the published fit
for isotropic surfaces, used for all. φ_fs, which vanishes between like surfaces, is left out.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray

_SERIES: Final = (1.0, 1 / 9, 1 / 33, 5 / 429)
"""Even moments of the density (35/32)(1 − x²)³: φ_f in powers of 1/z², where the closed form cancels."""


def couette_factor(separation: FloatArray) -> FloatArray:
    """Return φ_f at H = h/σ > 0, with z = H/3."""
    z = np.asarray(separation, dtype=np.float64) / 3.0
    far = np.polynomial.polynomial.polyval(np.maximum(z, 10.0) ** -2, _SERIES)
    return np.where(
        z <= 1.0, _touching(np.minimum(z, 1.0)), np.where(z < 10.0, _apart(np.clip(z, 1.0, 10.0)), far)
    )


def _touching(z: FloatArray) -> FloatArray:
    """φ_f where the highest asperities touch."""
    tail = -55.0 + z * (132.0 + z * (345.0 + z * (-160.0 + z * (-405.0 + z * (60.0 + 147.0 * z)))))
    return np.asarray(35.0 / 32.0 * z * ((1.0 - z**2) ** 3 * np.log(300.0 * (z + 1.0)) + tail / 60.0))


def _apart(z: FloatArray) -> FloatArray:
    """φ_f where they do not."""
    gap = np.maximum(z - 1.0, 1e-300)
    tail = z / 15.0 * (66.0 + z**2 * (30.0 * z**2 - 80.0))
    return np.asarray(35.0 / 32.0 * z * ((1.0 - z**2) ** 3 * np.log((z + 1.0) / gap) + tail))


def pressure_shear_factor(separation: FloatArray) -> FloatArray:
    """Return φ_fp = 1 − 1.40 exp(−0.66 H), isotropic."""
    return np.asarray(1.0 - 1.40 * np.exp(-0.66 * np.asarray(separation, dtype=np.float64)))
