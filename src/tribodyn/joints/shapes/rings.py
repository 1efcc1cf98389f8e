"""Surfaces of revolution: rings of equal angles at Gauss-Legendre points, on edges, and across the axis."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.splines import gauss_legendre_between
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.data import Row
from tribodyn.kernels.joints.surface.tilt import AXIS

EDGES: Final = 2  #: Rows on the edges of a surface, which weigh nothing.


def across(first: float, last: float, n: int) -> tuple[FloatArray, FloatArray]:
    """Return ``n`` Gauss-Legendre points and weights between two edges, see :func:`with_edges`."""
    return with_edges(first, last, *gauss_legendre_between(n, first, last))


def with_edges(
    first: float, last: float, points: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return points and weights between two edges, which weigh nothing: shape (n + 2,), edges at the ends."""
    return np.concatenate([[first], points, [last]]), np.concatenate([[0.0], weights, [0.0]])


@dataclass(frozen=True)
class Rings:
    """The profile of a surface of revolution, a ring of nodes at each of its points."""

    #: Of the rings on the shaft [m], shape (n,).
    radius: FloatArray
    height: FloatArray
    #: Components of the normals, shape (n,).
    radial: FloatArray
    axial: FloatArray
    strip: FloatArray  #: Area of the surface over angle that a ring stands for [m²/rad], shape (n,).

    def surface(
        self, name: str, along: tuple[str, FloatArray], gap: float | FloatArray, n_theta: int, tilt: float
    ) -> Surface:
        """Return the surface with nodes at the angles 2π i/n_theta about the axis.

        ``along`` names the coordinate across the rings, with its values (n,); the gap is as drawn [m],
        everywhere or of each ring (n,).
        """
        theta = 2.0 * np.pi * np.arange(n_theta) / n_theta
        around = np.stack([portable.cos(theta), portable.sin(theta), np.zeros(n_theta)])
        ones = np.ones(n_theta)

        def spread(radial: FloatArray, axial: FloatArray) -> FloatArray:
            """Return vectors with given components at all nodes."""
            vectors = radial[:, None, None] * around
            vectors[:, 2] = axial[:, None]
            return np.ascontiguousarray(vectors.transpose(0, 2, 1).reshape(-1, 3))

        area = 2.0 * np.pi / n_theta * self.strip
        return Surface(
            name=name,
            position=spread(self.radius, self.height),
            normal=spread(self.radial, self.axial),
            area=np.outer(area, ones).ravel(),
            gap=np.outer(gap * np.ones(area.size), ones).ravel(),
            rows=self._rows(n_theta, area),
            tilt=tilt,
            axes={along[0]: along[1], "theta": theta},
        )

    def _rows(self, n_theta: int, area: FloatArray) -> np.ndarray[tuple[int], np.dtype[np.void]]:
        """Return the records of the rings."""
        rows = np.zeros(area.size, dtype=Row)
        rows["first"] = n_theta * np.arange(area.size)
        rows["count"] = n_theta
        rows["area"] = n_theta * area
        rows["normal"][:, 0], rows["normal"][:, 2] = self.radial, self.axial
        rows["arm"] = self.height * self.radial - self.radius * self.axial
        return rows


@dataclass(frozen=True)
class Annulus:
    """Sizes of a flat ring [m]."""

    #: Its radii.
    inner: float
    outer: float
    clearance: float = 0.0  #: Gap as drawn; 0 for faces that lie on each other.
    height: float = 0.0  #: Of the face along the axis, from the joint's point.
    #: From the shaft into the socket: 1 along the axis, −1 against it, as a collar that rests on its bushing.
    direction: float = -1.0

    def __post_init__(self) -> None:
        """Refuse sizes that make no ring."""
        check_positive("annulus", outer=self.outer)
        if not 0.0 <= self.inner < self.outer:
            raise InputError(
                f"must be larger than the inner radius {self.inner:g} m, not {self.outer:g} m", key="outer"
            )
        if not self.clearance >= 0.0:
            raise InputError(f"must not be negative, as {self.clearance:g}", key="axial")
        if abs(self.direction) != 1.0:
            raise InputError(f"must be 1 or -1, not {self.direction:g}", key="direction")

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the ring."""
        return (self.surface("face", grid),)

    def surface(self, name: str, grid: tuple[int, int]) -> Surface:
        """Return the ring under a name."""
        n_theta, n_rho = grid
        rho, weight = across(self.inner, self.outer, n_rho)
        ones = np.ones(rho.size)
        rings = Rings(rho, self.height * ones, 0.0 * ones, self.direction * ones, rho * weight)
        surface = rings.surface(name, ("rho", rho), self.clearance, n_theta, AXIS)
        return replace(surface, size=0.5 * (self.outer - self.inner))

    def points(self) -> Points:
        """Refuse a point contact."""
        return no_points("flat ring")
