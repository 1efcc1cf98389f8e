"""Nodes of all surfaces as rows that kernels read, and deviations of surfaces from cylinders."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.signals import Signal
from tribodyn.core.splines import gauss_legendre_between
from tribodyn.kernels.joints.surface import data as kernel
from tribodyn.kernels.lanes import WIDTH

AROUND: Final = 4.4
ALONG: Final = 1.1  #: Groups of nodes around and along for c = σ.
GROUP: Final = 4  #: Kernels take so many nodes at once.
#: Around and along, however narrow the clearance is: wear and measured forms have shapes of their own.
FEWEST: Final = (64, 16)
#: Around and along, however wide the clearance is; a run says if its grid is too coarse.
MOST: Final = (512, 128)


def resolving(clearance: float, roughness: float) -> tuple[int, int]:
    """Return the numbers of nodes around and along that resolve the contact at a clearance c and a σ [m].

    Examples
    --------
    >>> resolving(20e-6, 1.634e-6)
    (64, 16)
    """
    ratio = math.sqrt(clearance / roughness)
    around, along = (GROUP * math.ceil(factor * ratio) for factor in (AROUND, ALONG))
    return min(max(around, FEWEST[0]), MOST[0]), min(max(along, FEWEST[1]), MOST[1])


OUT_OF_REACH: Final = 1.0e3  #: Lift of a repeated node of a ring [m].
#: Distance by which a node may miss its ring [m], and errors of its normal and its relative area [1].
CLOSE: Final = 1.0e-12
_KEPT: Final = 8  #: Numbers of nodes whose rings are kept.

Rows = NDArray[np.void]  #: Records :data:`~tribodyn.kernels.joints.surface.data.Row`.


def rows_of(surfaces: Sequence[tuple[Rows, int]], nodes: FloatArray) -> Rows:
    """Return the rows of all surfaces, given with their first nodes, counted from the first of all."""
    rows, at = np.zeros(sum(own.size for own, _ in surfaces), dtype=kernel.Row), 0
    for own, first in surfaces:
        rows[at : at + own.size] = own
        rows["first"][at : at + own.size] += first
        at += own.size
    ends = np.stack([rows["first"], rows["first"] + rows["count"]], axis=1)
    gaps = np.append(nodes[kernel.GAP], np.inf)  # an end may lie behind the last node
    rows["least"] = np.minimum.reduceat(gaps, ends.ravel())[::2]
    ring = rows["whole"] == 0.0
    for count in np.unique(rows["count"][ring]).tolist():
        _check_rings(rows[ring & (rows["count"] == count)], count, nodes)
    return rows


def _check_rings(rows: Rows, count: int, nodes: FloatArray) -> None:
    """Refuse rows of ``count`` of the nodes that kernels would take for rings."""
    cos, sin, _ = _ring(count)
    first = rows["first"]
    if np.all(np.diff(first) == count):  # one behind the other, as of most surfaces
        here = nodes[:, first[0] : first[-1] + count].reshape(len(nodes), first.size, count)
    else:
        here = nodes[:, first[:, None] + np.arange(count)]
    radius, _, height = here[kernel.POSITION : kernel.POSITION + 3, :, :1]
    radial, _, axial = rows["normal"].T[:, :, None]
    expected = (radius * cos, radius * sin, height, radial * cos, radial * sin, axial)
    if max(np.abs(found - at).max() for found, at in zip(here[: kernel.AREA], expected, strict=True)) > CLOSE:
        raise InputError("nodes of a row must lie at equal angles around the axis", key="shape")
    if np.any(np.ptp(here[kernel.AREA], axis=1) > CLOSE * here[kernel.AREA, :, 0]):
        raise InputError("nodes of a row around the axis must have equal areas", key="shape")


@lru_cache(_KEPT)
def _ring(count: int) -> FloatArray:
    return _around(np.arange(count), count)


def _around(node: NDArray[np.int64], count: int) -> FloatArray:
    """Return cosine and sine of the angles of nodes in a ring of ``count``, and zeros, shape (3, n)."""
    theta = 2.0 * np.pi * node / count
    return np.stack([portable.cos(theta), portable.sin(theta), np.zeros(theta.size)])


def rings_of(rows: Rows, nodes: FloatArray) -> FloatArray:
    """Return the common data of the nodes of each row, see ``kernels/joints/surface/data.py``."""
    rings, first = np.zeros((kernel.N_RING, rows.size + WIDTH - 1)), rows["first"]
    own = rings[:, : rows.size]
    own[kernel.N_RADIAL], own[kernel.N_AXIAL], own[kernel.ARM] = (
        rows["normal"][:, 0],
        rows["normal"][:, 2],
        rows["arm"],
    )
    own[kernel.RADIUS], own[kernel.HEIGHT] = nodes[kernel.POSITION, first], nodes[kernel.POSITION + 2, first]
    own[kernel.LEAST], own[kernel.NODE_AREA], own[kernel.COUNT] = (
        rows["least"],
        nodes[kernel.AREA, first],
        rows["count"],
    )
    return rings


def angles_of(rows: Rows) -> FloatArray:
    """Return the table of angles of rings, each number of nodes once; set where those of a ring begin."""
    ring, parts = rows["whole"] == 0.0, [np.zeros((kernel.N_ANGLE, 0))]
    for count in np.unique(rows["count"][ring]):
        rows["angle"][ring & (rows["count"] == count)] = sum(part.shape[1] for part in parts)
        parts.append(_groups(int(count)))
    return np.concatenate(parts, axis=1)


def _groups(count: int) -> FloatArray:
    """Return the angles of the groups of four in a ring of ``count`` nodes; the last one may repeat some."""
    if count < WIDTH:
        raise InputError(f"a ring needs at least {WIDTH} nodes, not {count}", key="grid")
    begin = np.arange(0, count, WIDTH)
    node = (np.minimum(begin, count - WIDTH)[:, None] + np.arange(WIDTH)).ravel()
    angles = _around(node, count)
    angles[kernel.LIFT] = np.where(node < np.repeat(begin, WIDTH), OUT_OF_REACH, 0.0)
    return angles


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
