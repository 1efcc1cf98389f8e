"""What the surfaces of a bushing joint stand back from two cylinders: a crown and chamfers at the ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError


@dataclass(frozen=True)
class Form:
    """Additional gap along the axis, the same all around; nothing of it in the middle.

    Attributes
    ----------
    crown
        Drop of a parabola at the ends against the middle [m].
    chamfer_length, chamfer_depth
        Straight run-out at both ends: how far it reaches inwards, and how deep it is at the end [m].
    """

    crown: float = 0.0
    chamfer_length: float = 0.0
    chamfer_depth: float = 0.0

    def gap(self, z: FloatArray, length: float) -> FloatArray:
        """Return what is added to the clearance at the heights ``z`` of a bushing [m], shape of ``z``."""
        half = 0.5 * length
        drop = self.crown * (z / half) ** 2
        if self.chamfer_length == 0.0:
            return drop
        into = np.maximum(np.abs(z) - (half - self.chamfer_length), 0.0)
        return drop + self.chamfer_depth * into / self.chamfer_length

    def quadrature(self, n: int, length: float) -> tuple[FloatArray, FloatArray]:
        """Return ``n`` points along the axis and their weights [m], shape (n,) each, increasing.

        Gauss-Legendre over the length; where chamfers make corners, over each piece, with a quarter of the
        points, two at least, in each chamfer.

        Raises
        ------
        InputError
            There are too few points for that.
        """
        half, corner = 0.5 * length, 0.5 * length - self.chamfer_length
        if self.chamfer_length == 0.0:
            return _gauss(n, -half, half)
        outer = max(2, n // 4)
        if n < 3 * outer:
            raise InputError("chamfers need points of their own, 6 in all at least", key="solver.grid.z")
        pieces = (
            _gauss(outer, -half, -corner),
            _gauss(n - 2 * outer, -corner, corner),
            _gauss(outer, corner, half),
        )
        points, weights = zip(*pieces, strict=True)
        return np.concatenate(points), np.concatenate(weights)


def _gauss(n: int, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    points, weights = np.polynomial.legendre.leggauss(n)
    return 0.5 * ((last - first) * points + first + last), 0.5 * (last - first) * weights
