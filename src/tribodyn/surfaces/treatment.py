"""Treatment of a scan before evaluation: levels, filters, and the filling of missing heights.

A level is the least-squares polynomial that is subtracted from a scan. A filter separates the wavelengths
kept from those removed. ``gaussian`` is the linear Gaussian filter of ISO 16610-21 (profiles) and 16610-61
(maps): it passes half of a wave as long as the cut-off; missing heights and points outside the scan have no
weight. ``spectral`` is the sharp filter, which removes all waves shorter than the cut-off. It works on
cosines (DCT), whose mirrored surface has no jump at its border.
"""

import math
from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
import scipy

from mebdf.arrays import FloatArray
from tribodyn.surfaces.scan import Scan


def filled(heights: FloatArray) -> FloatArray:
    """Return heights whose holes are filled by Gaussian means of what surrounds them.

    The width of the mean doubles until every hole is reached: a hole takes the nearest heights there are.

    ``heights``: [m], shape (n,) or (n_y, n_x), NaN where missing, known somewhere.
    """
    from scipy.ndimage import gaussian_filter

    result = heights.copy()
    width = 1.0
    while np.any(holes := np.isnan(result)):
        known = (~np.isnan(heights)).astype(np.float64)
        share = gaussian_filter(known, width, mode="nearest")
        mean = gaussian_filter(np.where(known > 0.0, heights, 0.0), width, mode="nearest")
        reached = holes & (share > 1e-3)
        result[reached] = mean[reached] / share[reached]
        width *= 2.0
    return result


#: Name of a level and the total degree of its polynomial.
LEVELS: Final[dict[str, int]] = {"mean": 0, "plane": 1, "quadratic": 2}


def levelled(scan: Scan, level: str) -> Scan:
    """Return a scan less its least-squares polynomial; missing heights have no say.

    ``scan``: any surface with more heights than the polynomial has terms; ``level``: one of ``LEVELS``.
    """
    known = ~np.isnan(scan.heights)
    heights = np.where(known, scan.heights, 0.0)
    heights = np.where(known, heights - heights.sum() / max(known.sum(), 1), 0.0)
    terms = _terms(scan.heights.shape, LEVELS[level])
    gram = np.array([[np.sum(known * a * b) for a in terms] for b in terms])
    right = np.array([np.sum(heights * term) for term in terms])
    factors = np.linalg.lstsq(gram, right)[0]
    surface = sum(factor * term for factor, term in zip(factors, terms, strict=True))
    return scan.with_heights(np.where(known, heights - surface, np.nan))


def _terms(shape: tuple[int, ...], degree: int) -> list[FloatArray]:
    """Return products of Legendre polynomials up to a total degree, each of a shape that broadcasts."""
    axes = np.meshgrid(*(np.linspace(-1.0, 1.0, n) for n in shape), indexing="ij", sparse=True)
    powers = [[np.polynomial.legendre.Legendre.basis(k)(axis) for k in range(degree + 1)] for axis in axes]
    if len(shape) == 1:
        return powers[0]
    return [powers[0][i] * powers[1][j] for i in range(degree + 1) for j in range(degree + 1 - i)]


#: α of ISO 16610-21, for which half of a wave of the length of the cut-off passes.
_ALPHA: Final = math.sqrt(math.log(2.0) / math.pi)
_REACH: Final = 6.0  #: Standard deviations of the weight beyond which it is taken as zero: e⁻¹⁸.

Smoother: TypeAlias = Callable[[Scan, float], FloatArray]


def gaussian(scan: Scan, cutoff: float) -> FloatArray:
    """Return the waves longer than ``cutoff`` [m]: heights [m], shape of the scan, NaN where missing."""
    known = ~np.isnan(scan.heights)
    width = _ALPHA * cutoff / math.sqrt(2.0 * math.pi)
    mean = np.where(known, scan.heights, 0.0)
    # Without holes the share is a product of the shares of the lines, which costs next to nothing.
    share = np.ones([1] * known.ndim) if known.all() else known.astype(np.float64)
    for axis, step in enumerate(scan.spacing):
        mean = _convolved(mean, width / step, axis)
        if known.all():
            line = np.ones([n if k == axis else 1 for k, n in enumerate(known.shape)])
            share = share * _convolved(line, width / step, axis)
        else:
            share = _convolved(share, width / step, axis)
    return np.where(known, mean / np.where(known, share, 1.0), np.nan)


def spectral(scan: Scan, cutoff: float) -> FloatArray:
    """Return the waves longer than ``cutoff`` [m]: heights [m], shape of the scan, NaN where missing."""
    known = ~np.isnan(scan.heights)
    waves = scipy.fft.dctn(filled(scan.heights))
    squares = [
        (np.arange(n) / (2.0 * n * step)) ** 2 for n, step in zip(waves.shape, scan.spacing, strict=True)
    ]
    frequency = np.sqrt(sum(np.meshgrid(*squares, indexing="ij", sparse=True)))
    waves[frequency > 1.0 / cutoff] = 0.0
    return np.where(known, scipy.fft.idctn(waves), np.nan)


FILTERS: Final[dict[str, Smoother]] = {"gaussian": gaussian, "spectral": spectral}


def filtered(scan: Scan, name: str, short: float | None, long: float | None) -> Scan:
    """Return the waves of a scan between two lengths.

    ``name``: one of ``FILTERS``; ``short``, ``long``: shortest and longest wavelength kept [m]; None keeps
    all.
    """
    smooth = FILTERS[name]
    if long is not None:
        scan = scan.with_heights(scan.heights - smooth(scan, long))
    return scan if short is None else scan.with_heights(smooth(scan, short))


def _convolved(values: FloatArray, width: float, axis: int) -> FloatArray:
    """Return a convolution with a Gaussian of standard deviation ``width`` [points], zeros around."""
    n = values.shape[axis]
    padded = scipy.fft.next_fast_len(n + math.ceil(_REACH * width), real=True)
    transfer = np.exp(-0.5 * (2.0 * math.pi * width * np.fft.rfftfreq(padded)) ** 2)
    shape = [1] * values.ndim
    shape[axis] = transfer.size
    waves = scipy.fft.rfft(values, padded, axis=axis) * transfer.reshape(shape)
    whole = scipy.fft.irfft(waves, padded, axis=axis)
    return np.asarray(whole[:n] if axis == 0 else whole[:, :n])
