"""Levels: the polynomial that is taken off a scan before anything is measured on it."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.surfaces.scan import Scan

LEVELS: Final[dict[str, int]] = {"mean": 0, "plane": 1, "quadratic": 2}
"""Name of a level and the total degree of its polynomial."""


def levelled(scan: Scan, level: str) -> Scan:
    """Return a scan less its least-squares polynomial; missing heights have no say.

    Parameters
    ----------
    scan
        Any surface with more heights than the polynomial has terms.
    level
        One of ``LEVELS``.
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
