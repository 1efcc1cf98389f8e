"""Mass properties of a solid of uniform density inside a closed surface of triangles.

Each triangle with corners a, b, c and the origin is a tetrahedron of volume V = a·(b × c)/6, negative where
the origin is outside the triangle, with the integrals over its volume

    ∫ x dV = V s / 4,    ∫ x xᵀ dV = V (a aᵀ + b bᵀ + c cᵀ + s sᵀ) / 20,    s = a + b + c

(Tonon 2005, Explicit exact formulas for the 3-D tetrahedron inertia tensor).
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribodyn.cases.case import demand
from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense


@dataclass(frozen=True)
class MeshSolid:
    """A solid of uniform density.

    Attributes
    ----------
    volume
        [m³].
    centre
        Its centroid [m], shape (3,).
    squares
        Principal moments of inertia about the centroid per mass [m²], shape (3,), rising.
    axes
        Principal axes as rows, shape (3, 3).
    """

    volume: float
    centre: FloatArray
    squares: FloatArray
    axes: FloatArray


def mesh_solid(facets: Sequence[float]) -> MeshSolid:
    """Return the solid inside a surface.

    Parameters
    ----------
    facets
        Corners of triangles, anticlockwise from outside [m], 9 n numbers.

    Raises
    ------
    InputError
        The surface is not closed, or its triangles face inwards.
    """
    demand(len(facets) > 0 and len(facets) % 9 == 0, "facets", "a triangle has nine coordinates")
    corners = np.array(facets).reshape(-1, 3, 3)
    _require_closed(corners)
    middle = 0.5 * (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1)))
    corners = corners - middle
    a, b, c = np.moveaxis(corners, 1, 0)
    volumes = np.add.reduce(a * np.cross(b, c), axis=1) / 6.0
    volume = math.fsum(volumes)
    demand(volume > 0.0, "facets", "corners of triangles go anticlockwise, seen from outside")
    sums = a + b + c
    centre = np.array([math.fsum(column) for column in (volumes[:, None] * sums).T]) / (4.0 * volume)
    second = _second_moments(volumes, (a, b, c, sums)) / (20.0 * volume)
    second -= np.outer(centre, centre)
    values, vectors = dense.eigh(second)
    # About an axis the inertia per mass is the sum of the second moments along the other two.
    squares = math.fsum(values) - values
    order = np.argsort(squares, kind="stable")
    return MeshSolid(volume, middle + centre, squares[order], vectors.T[order])


def _second_moments(weights: FloatArray, points: Sequence[FloatArray]) -> FloatArray:
    """Return the sum of weighted products of coordinates, shape (3, 3)."""
    found = np.zeros((3, 3))
    for place in points:
        found += [[math.fsum(weights * place[:, i] * place[:, j]) for j in range(3)] for i in range(3)]
    return found


def _require_closed(corners: FloatArray) -> None:
    """Refuse a surface that has an edge without another triangle on its other side."""
    points = [[tuple(corner) for corner in triangle] for triangle in corners.tolist()]
    edges = Counter((triangle[i], triangle[(i + 1) % 3]) for triangle in points for i in range(3))
    open_edges = sum(n != edges[end, start] for (start, end), n in edges.items())
    words = f"the surface is not closed: {open_edges} edges have a triangle on one side only"
    demand(open_edges == 0, "facets", words)
