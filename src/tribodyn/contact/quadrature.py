"""Integrals over Gaussian asperity heights."""

import math
from collections.abc import Callable
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quadrature import gauss_legendre

_POINTS: Final = 48
_DECAY: Final = 40.0
"""Heights whose density is below exp(-40) = 4e-18 of the largest one in the interval are left out."""


def density(z: FloatArray) -> FloatArray:
    """Return the standard normal density Φ(z), any shape."""
    return np.asarray(portable.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi))


def exceedance(z: FloatArray) -> FloatArray:
    """Return ∫_z^∞ Φ, the share of asperities higher than ``z``, any shape."""
    return np.asarray(0.5 * portable.erfc(z / np.sqrt(2.0)))


def asperity_integral(
    h_star: FloatArray,
    power: float,
    lower: float,
    upper: float,
    weight: Callable[[FloatArray], FloatArray] = density,
) -> FloatArray:
    """Return ∫_lower^upper s^power · weight(h* + s) ds for every separation, shape of ``h_star`` [1].

    With ``weight=exceedance`` it is the integral of the same with :func:`density` over all separations
    from h* to infinity, since ∫_h*^∞ Φ(x + s) dx = exceedance(h* + s).

    Gauss–Legendre in t = √s, which makes the integrand smooth at s = 0 for the powers 1 and 1.5; the
    upper limit is cut where the density has died away.
    """
    h, t, half = _nodes(h_star, lower, upper)
    integrand = 2.0 * portable.power(t, 2.0 * power + 1.0) * weight(h + t**2)
    return np.asarray(half[..., 0] * np.sum(integrand * gauss_legendre(_POINTS)[1], axis=-1))


def height_integral(
    h_star: FloatArray, load: Callable[[FloatArray], FloatArray], lower: float, upper: float
) -> FloatArray:
    """Return ∫_lower^upper load(s) · Φ(h* + s) ds for every separation, shape of ``h_star`` [1].

    For the loads of asperities that are not powers of the interference s; nodes as above.
    """
    h, t, half = _nodes(h_star, lower, upper)
    s = t**2
    weights = gauss_legendre(_POINTS)[1]
    return np.asarray(half[..., 0] * np.sum(2.0 * t * load(s) * density(h + s) * weights, axis=-1))


def _nodes(h_star: FloatArray, lower: float, upper: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return h*, the nodes t and half the length of the interval, shapes (..., 1), (..., n), (..., 1)."""
    h = np.asarray(h_star, dtype=np.float64)[..., np.newaxis]
    reach = np.sqrt(np.maximum(h + lower, 0.0) ** 2 + 2.0 * _DECAY) - h
    t_first = math.sqrt(lower)
    half = 0.5 * (np.sqrt(np.minimum(upper, reach)) - t_first)
    return h, t_first + half * (1.0 + gauss_legendre(_POINTS)[0]), half
