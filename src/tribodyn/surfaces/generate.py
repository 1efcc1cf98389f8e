"""Random surfaces of a known spectrum: for tests, for examples, and for a user who has no scan yet.

The spectrum is self-affine with roll-off: its density is constant for waves longer than ``roll_off``,
falls as q^(-2-2H) for a map, or q^(-1-2H) for a profile, down to ``shortest``, and is zero below. The
moments are integrals of powers, known in closed form.
"""

import math
from dataclasses import dataclass

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.surfaces.moments import Moments
from tribodyn.surfaces.scan import Scan

#: Mean of cosⁿ over directions for n = 0, 2, 4, by dimension.
_DIRECTIONS = {1: (1.0, 1.0, 1.0), 2: (1.0, 1.0 / 2.0, 3.0 / 8.0)}


@dataclass(frozen=True)
class SelfAffine:
    """An isotropic self-affine spectrum.

    Parameters
    ----------
    sigma
        Root-mean-square height [m].
    hurst
        Hurst exponent H in (0, 1).
    roll_off, shortest
        Wavelengths at which the power law begins and ends [m].
    """

    sigma: float
    hurst: float
    roll_off: float
    shortest: float

    def __post_init__(self) -> None:
        """Refuse invalid spectra."""
        if not (self.sigma > 0.0 and 0.0 < self.hurst < 1.0 and 0.0 < self.shortest < self.roll_off):
            raise InputError("needs sigma > 0, 0 < hurst < 1 and 0 < shortest < roll_off")

    def density(self, q: FloatArray, dimension: int) -> FloatArray:
        """Return the two-sided spectral density of the heights.

        Parameters
        ----------
        q
            Wavenumbers 2π/λ [rad/m], any shape.
        dimension
            2 of a map, 1 of a profile.

        Returns
        -------
        numpy.ndarray
            [m²·m^dimension], shape of ``q``.
        """
        first, last = self._band
        shape = np.maximum(q / first, 1.0) ** (-dimension - 2.0 * self.hurst)
        measure = {1: 1.0 / math.pi, 2: 1.0 / (2.0 * math.pi)}[dimension]
        scale = self.sigma**2 / (measure * self._integral(0, dimension))
        return np.asarray(np.where(q <= last, scale * shape, 0.0))

    def moments(self, dimension: int) -> Moments:
        """Return the exact spectral moments of a surface with this spectrum.

        Parameters
        ----------
        dimension
            2 of a map, 1 of a profile.

        Returns
        -------
        Moments
            m0 [m²], m2 [1] and m4 [1/m²] of its profiles.
        """
        whole = self._integral(0, dimension)
        m0, m2, m4 = (
            share * self.sigma**2 * self._integral(order, dimension) / whole
            for order, share in zip((0, 2, 4), _DIRECTIONS[dimension], strict=True)
        )
        return Moments(m0, m2, m4)

    @property
    def _band(self) -> tuple[float, float]:
        return 2.0 * math.pi / self.roll_off, 2.0 * math.pi / self.shortest

    def _integral(self, order: int, dimension: int) -> float:
        """Return ∫ q^(order+dimension-1) of the density over its value at zero."""
        (first, last), power = self._band, order - 2.0 * self.hurst
        fall = first ** (dimension + 2.0 * self.hurst) * (last**power - first**power) / power
        return float(first ** (order + dimension) / (order + dimension) + fall)


def generate(spectrum: SelfAffine, shape: tuple[int, ...], spacing: float, seed: int) -> Scan:
    """Return a periodic surface of random phases; its variance is that of the spectrum on this grid.

    Parameters
    ----------
    spectrum
        What it is made of.
    shape
        (n,) for a profile, (n_y, n_x) for a map.
    spacing
        Distance of neighbouring points in every direction [m].
    seed
        The same seed gives the same surface.

    Returns
    -------
    Scan
        Heights [m] of the given shape.

    Raises
    ------
    ValueError
        The seed is negative, or a dimension is.
    """
    noise = np.fft.rfftn(np.random.default_rng(seed).standard_normal(shape))
    axes = [np.fft.fftfreq(n, spacing) for n in shape[:-1]] + [np.fft.rfftfreq(shape[-1], spacing)]
    squares = np.meshgrid(*((2.0 * math.pi * axis) ** 2 for axis in axes), indexing="ij", sparse=True)
    q = np.sqrt(sum(squares))
    density = np.where(q > 0.0, spectrum.density(np.where(q > 0.0, q, 1.0), len(shape)), 0.0)
    amplitude = np.sqrt(density * math.prod(shape) / spacing ** len(shape))
    heights = np.fft.irfftn(amplitude * noise / np.abs(noise), shape, axes=range(len(shape)))
    return Scan(heights, (spacing,) * len(shape), f"generated, seed {seed}")
