"""From a scan to roughness parameters and their dependence on wavelengths, with the spectrum for the eye."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import scipy

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given
from tribodyn.surfaces.moments import LEAST_BANDWIDTH, Asperities, Moments, asperities, moments
from tribodyn.surfaces.scan import Scan
from tribodyn.surfaces.scan_checks import FEWEST_POINTS, checked
from tribodyn.surfaces.treatment import FILTERS, LEVELS, filled, filtered, levelled


@dataclass(frozen=True, eq=False)
class Spectrum:
    """One-sided density of the variance of profiles along one direction."""

    frequency: FloatArray  #: 1/λ [1/m], shape (n,), without zero.
    density: FloatArray  #: [m³], shape (n,): its integral over frequency is the mean variance of a profile.


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


_POINTS_OF_A_WAVE: Final = 2.0
_CUTOFFS: Final = 8
_LEAST_RANGE: Final = 1.5
_STEEPEST: Final = 10.0
_UNRESOLVED: Final = 0.85
_STRONG_LAY: Final = 0.5


@dataclass(frozen=True)
class Treatment:
    """Treatment of a scan before evaluation.

    Parameters
    ----------
    level
        One of ``LEVELS``.
    filter
        One of ``FILTERS``.
    short_cutoff, long_cutoff
        Shortest and longest wavelength kept [m]; None keeps all that the scan holds.
    """

    level: str = "plane"
    filter: str = "gaussian"
    short_cutoff: float | None = None
    long_cutoff: float | None = None

    def __post_init__(self) -> None:
        """Refuse names that do not exist."""
        for key, family in (("level", LEVELS), ("filter", FILTERS)):
            if getattr(self, key) not in family:
                raise InputError(f"{as_given(getattr(self, key))}; allowed: {', '.join(family)}", key=key)


@dataclass(frozen=True, eq=False)
class MeasuredSurface:
    """A surface as it was measured."""

    surface: Scan  #: Heights after levelling and filtering, from which all numbers come; its mean is zero.
    treatment: Treatment  #: What was done.
    #: Third and fourth moment of the heights over σ³ and σ⁴ [1]; 0 and 3 when Gaussian.
    skewness: float
    kurtosis: float
    moments: Moments  #: Spectral moments; σ = √m0.
    asperities: Asperities  #: What contact laws need.
    warnings: tuple[str, ...] = ()  #: What a reader of the numbers should know.

    @property
    def sigma(self) -> float:
        """Root-mean-square height σ [m]."""
        return math.sqrt(self.moments.m0)


_AS_MEASURED: Final = Treatment()


def analyse(scan: Scan, treatment: Treatment = _AS_MEASURED) -> MeasuredSurface:
    """Return the roughness of a scan.

    Parameters
    ----------
    scan
        Heights [m], shape (n,) of a profile or (n_y, n_x) of a map.
    treatment
        Form to remove, and the cut-offs of the filters [m].

    Returns
    -------
    MeasuredSurface
        Parameters of the roughness, its asperities, and warnings.

    Raises
    ------
    InputError
        The scan or the cut-offs cannot be used.

    Examples
    --------
    >>> from tribodyn.surfaces import SelfAffine, analyse, generate
    >>> rough = SelfAffine(sigma=1e-6, hurst=0.8, roll_off=50e-6, shortest=5e-6)
    >>> surface = analyse(generate(rough, (256, 256), 1e-6, seed=1))
    >>> f"{surface.moments.m0**0.5:.3g} m"
    '9.93e-07 m'
    """
    scan, warnings = checked(scan)
    check_cutoffs(scan, treatment)
    roughness = _measured(levelled(scan, treatment.level), treatment)
    if roughness.moments.m2 > _STEEPEST**2:
        raise InputError(
            f"the mean slope is {math.sqrt(roughness.moments.m2):.3g}; "
            "are the units of height and spacing right?",
            source=scan.source or None,
        )
    return replace(roughness, warnings=(*warnings, *_remarks(roughness)))


def check_cutoffs(scan: Scan, treatment: Treatment) -> None:
    """Refuse wavelengths that the scan does not hold."""
    short, long = treatment.short_cutoff, treatment.long_cutoff
    finest, longest = _POINTS_OF_A_WAVE * max(scan.spacing), min(scan.extent)
    for key, cutoff in (("short_cutoff", short), ("long_cutoff", long)):
        if cutoff is not None and not finest <= cutoff <= longest:
            raise InputError(
                f"given {cutoff * 1e6:.4g} um; the scan holds waves from {finest * 1e6:.4g} um (two points) "
                f"to {longest * 1e6:.4g} um (its length)",
                key=key,
            )
    if short is not None and long is not None and not short < long:
        raise InputError("must be below the longest wavelength kept, long_cutoff", key="short_cutoff")
    if short is not None and min(_border(scan, short)) < FEWEST_POINTS:
        raise InputError(
            f"waves of {short * 1e6:.4g} um leave too little of a scan of {longest * 1e6:.4g} um",
            key="short_cutoff",
        )


def dependence(roughness: MeasuredSurface, scan: Scan) -> list[MeasuredSurface]:
    """Return the roughness of a scan for other shortest and longest wavelengths.

    Parameters
    ----------
    roughness
        What :func:`analyse` returned.
    scan
        What it was given.

    Returns
    -------
    list of MeasuredSurface
        The shortest wavelength goes from the one of ``roughness``, or four points, up to a tenth of the
        longest; then the longest goes down from a half of that of ``roughness``. The other stays.

    Raises
    ------
    InputError
        The scan cannot be used.
    """
    scan, _ = checked(scan)
    level = levelled(scan, roughness.treatment.level)
    return [_measured(level, treatment) for treatment in _variations(scan, roughness.treatment)]


def _variations(scan: Scan, treatment: Treatment) -> Iterator[Treatment]:
    shortest = treatment.short_cutoff or 2.0 * _POINTS_OF_A_WAVE * max(scan.spacing)
    longest = treatment.long_cutoff or min(scan.extent)
    for cutoff in _between(shortest, longest / 10.0):
        yield replace(treatment, short_cutoff=cutoff)
    for cutoff in reversed(_between(max(3.0 * shortest, longest / 50.0), 0.5 * longest)):
        yield replace(treatment, long_cutoff=cutoff)


def _between(first: float, last: float) -> list[float]:
    """Return cut-offs at equal ratios; none when the scan leaves no room for any."""
    if last < _LEAST_RANGE * first:
        return []
    return [float(value) for value in np.geomspace(first, last, _CUTOFFS)]


def _measured(level: Scan, treatment: Treatment) -> MeasuredSurface:
    """Return the roughness of a levelled scan."""
    short = treatment.short_cutoff
    surface = filtered(level, treatment.filter, short, treatment.long_cutoff)
    if short is not None:
        surface = _without_border(surface, short)
    heights = surface.heights - np.nanmean(surface.heights)
    surface = surface.with_heights(heights)
    found = moments(surface)
    squares = heights * heights
    skewness = float(np.nanmean(squares * heights)) / found.m0**1.5
    kurtosis = float(np.nanmean(squares * squares)) / found.m0**2
    return MeasuredSurface(surface, treatment, skewness, kurtosis, found, asperities(found))


def _border(scan: Scan, cutoff: float) -> list[int]:
    """Return the number of points in each direction within half a wave from the border."""
    widths = [math.ceil(0.5 * cutoff / step) for step in scan.spacing]
    return [n - 2 * width for n, width in zip(scan.heights.shape, widths, strict=True)]


def _without_border(scan: Scan, cutoff: float) -> Scan:
    """Cut off half a wave at the border, where a filter sees one side only."""
    left = _border(scan, cutoff)
    parts = tuple(slice((n - k) // 2, (n + k) // 2) for n, k in zip(scan.heights.shape, left, strict=True))
    return scan.with_heights(scan.heights[parts])


def _remarks(roughness: MeasuredSurface) -> Iterator[str]:
    """Give warnings about the numbers."""
    found, treatment = roughness.moments, roughness.treatment
    if found.resolved < _UNRESOLVED:
        yield (
            "the points are too far apart for the curvature: density and radius are those of the sampling; "
            f"give a short cut-off of at least {8e6 * max(roughness.surface.spacing):.3g} um"
        )
    elif treatment.short_cutoff is None:
        yield "density and radius depend on the shortest wavelength: give a short cut-off, and state it"
    if roughness.asperities.bandwidth < LEAST_BANDWIDTH:
        yield (
            f"alpha = {roughness.asperities.bandwidth:.3g} is below {LEAST_BANDWIDTH:g}, which no random "
            "surface has: the formulas for asperities do not hold"
        )
    if abs(roughness.skewness) > 1.0 or abs(roughness.kurtosis - 3.0) > 2.0:
        yield "the heights are far from Gaussian, which the contact laws assume"
    if found.directional is not None and found.directional.texture < _STRONG_LAY:
        yield "the surface has a lay; the formulas for asperities assume the same roughness in all directions"
