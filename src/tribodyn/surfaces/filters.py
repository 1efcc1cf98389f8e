"""Filters: what separates the wavelengths kept from those taken off.

``gaussian`` is the linear Gaussian filter of ISO 16610-21 (profiles) and 16610-61 (maps): half of a wave
as long as the cut-off passes. Missing heights and the world beyond the border weigh nothing.
``spectral`` is the sharp filter: waves shorter than the cut-off are gone. It works on cosines (DCT),
whose mirrored surface has no jump at its border.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
import scipy

from tribodyn.core.arrays import FloatArray
from tribodyn.surfaces.holes import filled
from tribodyn.surfaces.scan import Scan

_ALPHA: Final = math.sqrt(math.log(2.0) / math.pi)
"""α of ISO 16610-21, for which half of a wave of the length of the cut-off passes."""
_REACH: Final = 6.0
"""Standard deviations of the weight beyond which it is taken as zero: e⁻¹⁸."""

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

    Parameters
    ----------
    scan
        A levelled surface.
    name
        One of ``FILTERS``.
    short, long
        Shortest and longest wavelength kept [m]; None keeps all.
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
