"""Tabulation of the factors of a pair of rough surfaces for the kernels."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.film.data import FlowTable
from tribodyn.lubrication.contact_factor import mean_gap_nodes
from tribodyn.lubrication.flow_factors import pressure_factor, shear_factor
from tribodyn.lubrication.roughness import Roughness
from tribodyn.lubrication.shear_stress import couette_factor, pressure_shear_factor

_PER_UNIT: Final = 300
"""Intervals per unit of 1/H; the formulas change at H = 5 and 3, which are nodes."""
_LARGEST: Final = 2
"""1/H at the least separation, H = 1/2."""
_FAR: Final = 1e9
"""H that stands for infinity at the first node."""


def flow_table(roughness: Roughness) -> FlowTable:
    """Return the factors of ``roughness`` as piecewise cubics over 1/H, and the mean gap over H."""
    separation, mean, slope = mean_gap_nodes()
    step = float(separation[1] - separation[0])
    return FlowTable(
        inverse_step=float(_PER_UNIT),
        factors=_factor_pieces(roughness),
        gap_step=step,
        mean_gap=_hermite(mean[:-1], mean[1:], step * slope[:-1], step * slope[1:]),
    )


def _factor_pieces(roughness: Roughness) -> FloatArray:
    """Cubics through four points of each interval, ends included, so that no slope crosses a branch."""
    left = np.arange(_LARGEST * _PER_UNIT)[:, None]
    points = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])
    # Inside by a hair: at a node each side keeps its own formula.
    inverse = np.maximum((left + points) / _PER_UNIT, 1.0 / _FAR)
    values = np.stack(_factors(roughness, 1.0 / inverse), axis=1)
    to_coefficients = np.linalg.inv(np.vander(points, increasing=True))
    return np.ascontiguousarray(values @ to_coefficients.T)


def _factors(roughness: Roughness, h: FloatArray) -> tuple[FloatArray, ...]:
    """φ_θ, φ_z, φ_s, φ_f, φ_fp of the pair; both surfaces count with their share of the variance."""
    shares, peklenik = roughness.shares, roughness.peklenik
    along = sum(w * pressure_factor(h, g) for w, g in zip(shares, peklenik, strict=True))
    across = sum(w * pressure_factor(h, 1.0 / g) for w, g in zip(shares, peklenik, strict=True))
    # The shaft is surface 1 and moves: docs/theory/film.md derives the sign.
    shear = shares[0] * shear_factor(h, peklenik[0]) - shares[1] * shear_factor(h, peklenik[1])
    return np.asarray(along), np.asarray(across), shear, couette_factor(h), pressure_shear_factor(h)


def _hermite(left: FloatArray, right: FloatArray, d_left: FloatArray, d_right: FloatArray) -> FloatArray:
    """Coefficients of the cubics with these values and slopes (per interval) at their ends, shape (n, 4)."""
    rise = right - left
    return np.stack(
        [left, d_left, 3.0 * rise - 2.0 * d_left - d_right, d_left + d_right - 2.0 * rise], axis=1
    )
