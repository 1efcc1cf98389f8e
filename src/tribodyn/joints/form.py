"""Deviation of the surfaces of a bushing joint from cylinders: crown, chamfers, measured forms."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.signals import Signal
from tribodyn.core.splines import gauss_legendre_between


@dataclass(frozen=True)
class Bore:
    """Measured form of a bushing."""

    #: Where it was measured [rad, m], increasing; once around.
    angles: Sequence[float]
    positions: Sequence[float]
    values: Sequence[float]  #: Deviation of the bore's radius [m], more where it is wider, angle by angle.

    def deviation(self, theta: FloatArray, z: FloatArray) -> FloatArray:
        """Return the deviation at angles and heights, shape (n_z, n_theta).

        Bicubic and periodic; along heights of which there are fewer than four a polynomial.
        """
        from scipy.interpolate import CubicSpline

        angles = np.asarray(self.angles, dtype=np.float64)
        rows = np.reshape(self.values, (angles.size, len(self.positions)))
        closed = np.append(angles, angles[0] + 2.0 * np.pi)
        around = CubicSpline(closed, np.vstack([rows, rows[:1]]), bc_type="periodic")
        at = around(angles[0] + np.mod(theta - angles[0], 2.0 * np.pi))
        within = np.clip(z, self.positions[0], self.positions[-1])
        return np.asarray(CubicSpline(np.asarray(self.positions), at, axis=1)(within).T)


@dataclass(frozen=True)
class Form:
    """Additional gap; of crown and chamfers there is nothing in the middle."""

    crown: float = 0.0  #: Drop of a parabola at the ends against the middle [m].
    #: Straight run-out at both ends: how far it reaches inwards, and how deep it is at the end [m].
    chamfer_length: float = 0.0
    chamfer_depth: float = 0.0
    bore: Bore | None = None  #: Measured form of the bushing; none by default.
    #: Measured deviation of the trunnion's radius over the height [m], the same all around, since it turns in
    #: the bushing; none by default.
    profile: Signal | None = None

    def measured(self, theta: FloatArray, z: FloatArray) -> FloatArray:
        """Return the gap that measured forms add to the clearance [m], shape (n_z, n_theta)."""
        added = np.zeros((z.size, theta.size))
        if self.bore is not None:
            added += self.bore.deviation(theta, z)
        if self.profile is not None:
            from scipy.interpolate import PPoly

            within = np.clip(z, self.profile.knots[0], self.profile.knots[-1])
            added -= PPoly(self.profile.coefficients, self.profile.knots)(within)[:, None]
        return added

    def gap(self, z: FloatArray, length: float) -> FloatArray:
        """Return the gap that the form adds at the heights ``z`` of a bushing [m], shape of ``z``."""
        half = 0.5 * length
        drop = self.crown * (z / half) ** 2
        if self.chamfer_length == 0.0:
            return drop
        into = np.maximum(np.abs(z) - (half - self.chamfer_length), 0.0)
        return drop + self.chamfer_depth * into / self.chamfer_length

    def quadrature(self, n: int, length: float) -> tuple[FloatArray, FloatArray]:
        """Return ``n`` points along the axis and their weights [m], shape (n,) each, increasing.

        Gauss-Legendre over the length; where chamfers make corners, over each piece, with a quarter of the
        points, two at least, in each chamfer. Raises ``InputError`` where there are too few points for that.
        """
        half, corner = 0.5 * length, 0.5 * length - self.chamfer_length
        if self.chamfer_length == 0.0:
            return gauss_legendre_between(n, -half, half)
        outer = max(2, n // 4)
        if n < 3 * outer:
            raise InputError("chamfers need points of their own, 6 in all at least", key="solver.grid.z")
        pieces = (
            gauss_legendre_between(outer, -half, -corner),
            gauss_legendre_between(n - 2 * outer, -corner, corner),
            gauss_legendre_between(outer, corner, half),
        )
        points, weights = zip(*pieces, strict=True)
        return np.concatenate(points), np.concatenate(weights)
