"""Spectral moments, and the asperities of contact laws that follow from them.

m0 = ⟨z²⟩, m2 = ⟨(∂z/∂x)²⟩, m4 = ⟨(∂²z/∂x²)²⟩ of a profile, which for an isotropic surface are the same
in all directions (Nayak 1971; McCool 1987). Of a map they are taken along x and y, and as the means over
all directions, m2 = ½⟨|∇z|²⟩ and m4 = ⅜⟨(∇²z)²⟩, which do not change when the map is turned or its axes
are swapped.

Slopes and curvatures are seven-point central differences. The rule errs by (2πΔ/λ)⁶/140 (slope) and /560
(curvature) of its value: for waves of 8 points by 0.17 % and 0.04 %, for waves of 5 by 2.8 % and 0.7 %.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.surfaces.scan import Scan

REACH: Final = 3  #: Points on each side that a difference reads.
_SLOPE: Final = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
_CURVATURE: Final = np.array([2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0]) / 180.0
_COARSE_CURVATURE: Final = np.array([0.0, 0.0, 1.0, -2.0, 1.0, 0.0, 0.0])


def slope(heights: FloatArray, step: float, axis: int = 0) -> FloatArray:
    """Return ∂z/∂x [1] along an axis, shorter there by six points; NaN where a height is missing."""
    return _difference(heights, _SLOPE / step, axis)


def curvature(heights: FloatArray, step: float, axis: int = 0) -> FloatArray:
    """Return ∂²z/∂x² [1/m] along an axis, shorter there by six points; NaN where a height is missing."""
    return _difference(heights, _CURVATURE / step**2, axis)


def coarse_curvature(heights: FloatArray, step: float, axis: int = 0) -> FloatArray:
    """Return :func:`curvature` by three points: far from it, the grid does not resolve the curvature."""
    return _difference(heights, _COARSE_CURVATURE / step**2, axis)


def _difference(heights: FloatArray, weights: FloatArray, axis: int) -> FloatArray:
    # Imported here: most runs read no scan.
    from scipy.ndimage import correlate1d

    everywhere = correlate1d(heights, weights, axis=axis, mode="nearest")
    return np.asarray(everywhere[REACH:-REACH] if axis == 0 else everywhere[:, REACH:-REACH])


@dataclass(frozen=True)
class Directional:
    """Second and fourth moments of a map that belong to directions."""

    #: Along the axes [1].
    m2_x: float
    m2_y: float
    #: Along the axes [1/m²].
    m4_x: float
    m4_y: float
    #: Largest and smallest over all directions [1]: across and along the lay.
    m2_across: float
    m2_along: float
    lay: float  #: Direction of the smallest, from x towards y [rad], in [-π/2, π/2].

    @property
    def texture(self) -> float:
        """Slope along over slope across the lay [1]: 1 when isotropic, 0 for straight grooves."""
        return math.sqrt(max(self.m2_along, 0.0) / self.m2_across)


@dataclass(frozen=True)
class Moments:
    """Spectral moments in the sense of a profile of an isotropic surface."""

    #: Variance of height [m²], slope [1] and curvature [1/m²].
    m0: float
    m2: float
    m4: float
    #: m4 by three points over m4 by seven [1]: near 1 when the grid resolves the curvature.
    resolved: float = 1.0
    directional: Directional | None = None  #: What a map says of directions; None for a profile.

    def __add__(self, other: "Moments") -> "Moments":
        """Return the moments of the sum of two independent surfaces, which is the gap between them."""
        coarse = self.resolved * self.m4 + other.resolved * other.m4
        m4 = self.m4 + other.m4
        return Moments(self.m0 + other.m0, self.m2 + other.m2, m4, coarse / m4)


def moments(scan: Scan) -> Moments:
    """Return the moments of a surface that has been levelled and filtered.

    Parameters
    ----------
    scan
        Heights [m], shape (n,) of a profile or (n_y, n_x) of a map; NaN where none was measured.

    Returns
    -------
    Moments
        Variances of heights [m²], slopes [1] and curvatures [1/m²].
    """
    m0 = float(np.nanvar(scan.heights))
    return _of_map(scan, m0) if scan.is_map else _of_profile(scan, m0)


def _of_profile(scan: Scan, m0: float) -> Moments:
    (step,) = scan.spacing
    m4 = _mean_square(curvature(scan.heights, step))
    coarse = _mean_square(coarse_curvature(scan.heights, step))
    return Moments(m0, _mean_square(slope(scan.heights, step)), m4, coarse / m4)


def _of_map(scan: Scan, m0: float) -> Moments:
    z, (dy, dx) = scan.heights, scan.spacing
    inside = slice(REACH, -REACH)
    z_x, z_y = slope(z[inside], dx, 1), slope(z[:, inside], dy, 0)
    z_xx, z_yy = curvature(z[inside], dx, 1), curvature(z[:, inside], dy, 0)
    laplacian = coarse_curvature(z[inside], dx, 1) + coarse_curvature(z[:, inside], dy, 0)
    m2_x, m2_y, m2_xy = _mean_square(z_x), _mean_square(z_y), float(np.nanmean(z_x * z_y))
    m4 = 0.375 * _mean_square(z_xx + z_yy)
    middle, spread = 0.5 * (m2_x + m2_y), math.hypot(0.5 * (m2_x - m2_y), m2_xy)
    directional = Directional(
        m2_x,
        m2_y,
        _mean_square(z_xx),
        _mean_square(z_yy),
        middle + spread,
        middle - spread,
        0.5 * math.atan2(-2.0 * m2_xy, m2_y - m2_x),
    )
    return Moments(m0, middle, m4, 0.375 * _mean_square(laplacian) / m4, directional)


def _mean_square(values: FloatArray) -> float:
    return float(np.nanmean(values**2))


#: α of an isotropic Gaussian surface with a single wavelength; none is below it.
LEAST_BANDWIDTH: Final = 1.5


@dataclass(frozen=True)
class Asperities:
    """The equivalent sphere-tipped asperities of a random surface."""

    density: float  #: Summits per area ξ = m4/(6π√3 m2) [1/m²].
    radius: float  #: Radius β = ⅜√(π/m4) of the mean curvature of the summits [m].
    bandwidth: float  #: α = m0 m4/m2² [1].
    summit_rms: float  #: Standard deviation of summit heights σ_s = √((1 − 0.8968/α) m0) [m].
    summit_offset: float  #: Mean height of the summits above the mean plane 4√(m0/(πα)) [m].

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
