"""Bodies as the solids that their keys describe, as modelled: round ones, boxes and meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribodyn.cases.directions import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.mesh_solid import mesh_solid


@dataclass(frozen=True)
class BodySolid:
    """A solid as modelled.

    Attributes
    ----------
    points
        Of a round solid the middles of both ends, shape (2, 3); of a box, or of the one around a mesh, its
        centre and the middles of three faces, shape (4, 3) [m].
    radius, inner
        Outer and inner radius of a round solid [m]; 0 of others.
    triangles
        Corners of the triangles of a mesh, shape (3 n, 3): −1 to 1 along each axis of its box. Else None.
    """

    points: FloatArray
    radius: float = 0.0
    inner: float = 0.0
    triangles: FloatArray | None = None


def body_solid(body: BodyKeys) -> BodySolid | None:
    """Return the solid of a body; None of one whose keys give mass properties only."""
    if body.start is not None and body.end is not None and body.radius is not None:
        return BodySolid(np.array([body.start, body.end]), body.radius)
    centre = np.array(body.centre)
    first, second = unit(body.first_axis, "first_axis"), unit(body.second_axis, "second_axis")
    if body.length is not None and body.radius is not None:
        half = 0.5 * body.length * np.array(first)
        return BodySolid(np.array([centre - half, centre + half]), body.radius, body.inner_radius or 0.0)
    if body.size is not None:
        axes = np.array([first, second, np.cross(first, second)])
        return BodySolid(_box(centre, 0.5 * np.array(body.size)[:, None] * axes))
    return None if body.facets is None else _mesh(body, np.array(body.facets).reshape(-1, 3))


def _box(centre: FloatArray, halves: FloatArray) -> FloatArray:
    """Return the centre of a box and the middles of three faces from the vectors to them, shape (4, 3)."""
    return np.concatenate([centre[None], centre + halves])


def _mesh(body: BodyKeys, corners: FloatArray) -> BodySolid:
    """Return the solid of a mesh from its corners [m], shape (3 n, 3), and the scale of the body."""
    if body.scale is not None:
        fixed = body.scaled_about or mesh_solid(body.facets or ()).centre
        corners = fixed + body.scale * (corners - fixed)
    low, high = corners.min(axis=0), corners.max(axis=0)
    centre, half = 0.5 * (low + high), 0.5 * (high - low)
    return BodySolid(_box(centre, np.diag(half)), triangles=(corners - centre) / half)
