"""Factors of the average Reynolds equation between rough surfaces, and their tabulation for the kernels.

Flow factors: Patir, N. and Cheng, H. S., ASME J. Lubrication Technology 100 (1978) 12-17 and 101 (1979)
220-230, for any Peklenik number between 1/9 and 9. H = h/σ; the Peklenik number γ is the ratio of the
correlation lengths along and across the sliding direction.

    φ_x = 1 − C exp(−r H)  (γ ≤ 1),   1 + C H^−r  (γ > 1),   φ_z(H, γ) = φ_x(H, 1/γ)
    Φ_s = A_1 H^α1 exp(−α2 H + α3 H²)  (H ≤ 5),   A_2 exp(−H/4)  (H > 5)

Between the published γ the factors, not their coefficients, are interpolated linearly in ln γ, because the
two formulas for φ_x have no coefficients in common. The branch of Φ_s above H = 5 is joined to the one below
(the published A_2 leave a jump of up to 2e-4).

Shear-stress factors: the same paper of 1979. The mean shear stress on the moving surface is φ_f η U/h +
φ_fp (h/2) ∂p/∂x. φ_f = ⟨h/h_T⟩ depends on the heights alone: a polynomial density within ±3σ, where local
gaps count from σ/100, or the mean would not exist. φ_fp is the published fit for isotropic surfaces, used
for all. φ_fs, which vanishes between equal surfaces, is left out.

Contact factor: Wu, C. and Zheng, L., ASME J. Tribology 111 (1989) 188-191; coefficients as in shared
reference data. φ_c = ∂h_T/∂h is the change of the mean gap h_T for a change of the gap; it multiplies ∂h/∂θ
and ∂h/∂t.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.splines import gauss_legendre
from tribodyn.kernels import dense
from tribodyn.kernels.film.data import FlowTable


@dataclass(frozen=True)
class Roughness:
    """Rms roughness and lay of shaft (surface 1, which moves) and bushing (surface 2)."""

    rms: tuple[float, float] = (0.0, 0.0)  #: σ_1 and σ_2 [m]; both 0 for smooth surfaces.
    #: γ_1 and γ_2 [1]: correlation length along over across the sliding direction, 1 for isotropic surfaces.
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
        first, second = self.rms[0] / self.combined, self.rms[1] / self.combined
        return first * first, second * second


PEKLENIK: Final = (1 / 9, 1 / 6, 1 / 3, 1.0, 3.0, 6.0, 9.0)

#: C, r and the least H of validity, one row a γ.
PRESSURE: Final = (
    (1.48, 0.42, 1.0),
    (1.38, 0.42, 1.0),
    (1.18, 0.42, 0.75),
    (0.90, 0.56, 0.5),
    (0.225, 1.5, 0.5),
    (0.520, 1.5, 0.5),
    (0.870, 1.5, 0.5),
)

#: A_1, α_1, α_2, α_3 and the published A_2, one row a γ.
SHEAR: Final = (
    (2.046, 1.12, 0.78, 0.03, 1.856),
    (1.962, 1.08, 0.77, 0.03, 1.754),
    (1.858, 1.01, 0.76, 0.03, 1.561),
    (1.899, 0.98, 0.92, 0.05, 1.126),
    (1.560, 0.85, 1.13, 0.08, 0.556),
    (1.290, 0.62, 1.09, 0.08, 0.388),
    (1.011, 0.54, 1.07, 0.08, 0.295),
)

BRANCH: Final = 5.0  #: H at which Φ_s changes its formula.


def pressure_factor(separation: FloatArray, peklenik: float) -> FloatArray:
    """Return φ_x at H = h/σ for a Peklenik number; φ_z is that of its inverse."""
    return _between(_pressure_row, np.asarray(separation, dtype=np.float64), peklenik)


def shear_factor(separation: FloatArray, peklenik: float) -> FloatArray:
    """Return Φ_s at H = h/σ of one surface that moves against a smooth one at rest."""
    return _between(_shear_row, np.asarray(separation, dtype=np.float64), peklenik)


def _pressure_row(h: FloatArray, row: int) -> FloatArray:
    c, r, _ = PRESSURE[row]
    return np.asarray(
        1.0 - c * portable.exp(-r * h) if PEKLENIK[row] <= 1.0 else 1.0 + c * portable.power(h, -r)
    )


def _shear_row(h: FloatArray, row: int) -> FloatArray:
    a, alpha_1, alpha_2, alpha_3, _ = SHEAR[row]
    low = np.minimum(h, BRANCH)
    below = a * portable.power(low, alpha_1) * portable.exp(-alpha_2 * low + alpha_3 * low**2)
    return np.asarray(below * portable.exp(-0.25 * np.maximum(h - BRANCH, 0.0)))


def _between(rows: Callable[[FloatArray, int], FloatArray], h: FloatArray, peklenik: float) -> FloatArray:
    """Interpolate linearly in ln γ between the two published Peklenik numbers around ``peklenik``."""
    if not PEKLENIK[0] * (1.0 - 1e-12) <= peklenik <= PEKLENIK[-1] * (1.0 + 1e-12):
        raise InputError(
            f"a Peklenik number of {peklenik:g}; the flow factors are known from 1/9 to 9",
            key="film.peklenik",
        )
    place = float(np.interp(portable.log(peklenik), portable.log(PEKLENIK), np.arange(len(PEKLENIK))))
    row = min(int(place), len(PEKLENIK) - 2)
    share = place - row
    if share == 0.0:
        return rows(h, row)
    return (1.0 - share) * rows(h, row) + share * rows(h, row + 1)


#: Even moments of the density (35/32)(1 − x²)³: φ_f in powers of 1/z², where the closed form cancels.
_SERIES: Final = (1.0, 1 / 9, 1 / 33, 5 / 429)


def couette_factor(separation: FloatArray) -> FloatArray:
    """Return φ_f at H = h/σ > 0, with z = H/3."""
    z = np.asarray(separation, dtype=np.float64) / 3.0
    far = np.polynomial.polynomial.polyval(1.0 / np.maximum(z, 10.0) ** 2, _SERIES)
    return np.where(
        z <= 1.0, _touching(np.minimum(z, 1.0)), np.where(z < 10.0, _apart(np.clip(z, 1.0, 10.0)), far)
    )


def _touching(z: FloatArray) -> FloatArray:
    """φ_f with contact of the highest asperities."""
    tail = -55.0 + z * (132.0 + z * (345.0 + z * (-160.0 + z * (-405.0 + z * (60.0 + 147.0 * z)))))
    return np.asarray(35.0 / 32.0 * z * (_cube(1.0 - z**2) * portable.log(300.0 * (z + 1.0)) + tail / 60.0))


def _apart(z: FloatArray) -> FloatArray:
    """φ_f without any contact."""
    gap = np.maximum(z - 1.0, 1e-300)
    tail = z / 15.0 * (66.0 + z**2 * (30.0 * z**2 - 80.0))
    return np.asarray(35.0 / 32.0 * z * (_cube(1.0 - z**2) * portable.log((z + 1.0) / gap) + tail))


def _cube(x: FloatArray) -> FloatArray:
    return x * x * x


def pressure_shear_factor(separation: FloatArray) -> FloatArray:
    """Return φ_fp = 1 − 1.40 exp(−0.66 H), isotropic."""
    return np.asarray(1.0 - 1.40 * portable.exp(-0.66 * np.asarray(separation, dtype=np.float64)))


COEFFICIENTS: Final = (-0.6912, 0.782, -0.304, 0.0401)  #: ln φ_c as a cubic of H = h/σ, 0 ≤ H < 3.
_INTERVALS: Final = 128


def contact_factor(separation: FloatArray) -> FloatArray:
    """Return φ_c at H = h/σ; its value at 0 below, 1 above.

    The published exponential passes 1 by 0.15 % just before H = 3, where it ends: φ_c stops at 1 instead, so
    that it has no jump.
    """
    h = np.clip(separation, 0.0, 3.0)
    return np.asarray(np.minimum(portable.exp(np.polynomial.polynomial.polyval(h, COEFFICIENTS)), 1.0))


def reach() -> float:
    """Return the separation from which φ_c is 1, by halves: ``brentq`` takes half a second to import."""
    low, high = 2.5, 3.0
    while low < (middle := 0.5 * (low + high)) < high:
        within = np.polynomial.polynomial.polyval(middle, COEFFICIENTS) < 0.0
        low, high = (middle, high) if within else (low, middle)
    return high


def mean_gap_nodes() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return H, h_T/σ = reach − ∫ φ_c dH and φ_c at the ends of equal intervals from 0 to :func:`reach`."""
    h = np.linspace(0.0, reach(), _INTERVALS + 1)
    points, weights = gauss_legendre(8)
    half = 0.5 * (h[1] - h[0])
    samples = contact_factor((h[:-1] + half)[:, None] + half * points)
    pieces = half * dense.product(samples, weights)
    above = np.append(np.cumsum(pieces[::-1])[::-1], 0.0)
    return h, h[-1] - above, contact_factor(h)


_PER_UNIT: Final = 300  #: Intervals per unit of 1/H; the formulas change at H = 5 and 3, which are nodes.
_LARGEST: Final = 2  #: 1/H at the least separation, H = 1/2.
_FAR: Final = 1e9  #: H that stands for infinity at the first node.


# Asked for whenever a mechanism is put together, which is several times in a run.
@lru_cache(maxsize=8)
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
    to_coefficients = dense.inverse(np.vander(points, increasing=True))
    return np.ascontiguousarray(dense.product(values, to_coefficients.T))


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
