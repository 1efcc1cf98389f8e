"""Power spectral density of a surface, for the eye: over which wavelengths the roughness is spread."""

from dataclasses import dataclass

import numpy as np
import scipy

from tribodyn.core.arrays import FloatArray
from tribodyn.surfaces.scan import Scan
from tribodyn.surfaces.treatment import filled


@dataclass(frozen=True, eq=False)
class Spectrum:
    """One-sided density of the variance of profiles along one direction.

    Attributes
    ----------
    frequency
        1/λ [1/m], shape (n,), without zero.
    density
        [m³], shape (n,): its integral over frequency is the mean variance of a profile.
    """

    frequency: FloatArray
    density: FloatArray


def in_bands(spectrum: Spectrum, per_decade: int = 16) -> Spectrum:
    """Return the mean density in bands of equal ratio: that of a single profile is noise otherwise."""
    band = np.floor(np.log10(spectrum.frequency / spectrum.frequency[0]) * per_decade).astype(np.int64)
    used, place, count = np.unique(band, return_inverse=True, return_counts=True)
    frequency, density = (
        np.bincount(place, values, used.size) / count for values in (spectrum.frequency, spectrum.density)
    )
    return Spectrum(frequency, density)


def spectra(scan: Scan) -> dict[str, Spectrum]:
    """Return the mean density of the profiles along ``x``, and of those along ``y`` in a map.

    Each profile is weighted by a Hann window, which keeps the jump between its ends out of the spectrum.
    """
    heights = filled(scan.heights)
    if not scan.is_map:
        return {"x": _spectrum(heights[np.newaxis], scan.spacing[0])}
    dy, dx = scan.spacing
    return {"x": _spectrum(heights, dx), "y": _spectrum(heights.T, dy)}


def _spectrum(lines: FloatArray, step: float) -> Spectrum:
    n = lines.shape[1]
    window = np.hanning(n)
    waves = scipy.fft.rfft((lines - lines.mean(axis=1, keepdims=True)) * window, axis=1)
    power = np.mean(np.abs(waves) ** 2, axis=0) * 2.0 * step / np.sum(window**2)
    if n % 2 == 0:
        power[-1] /= 2.0
    return Spectrum(np.asarray(np.fft.rfftfreq(n, step)[1:], dtype=np.float64), power[1:])
