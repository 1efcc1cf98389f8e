"""The mechanism as solids: each body as round rods between its joints."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from tribodyn.cases.units import AXES
from tribodyn.core.arrays import FloatArray
from tribodyn.figures.chart import COLOURS
from tribodyn.mechanism.assembly.skeleton import Skeleton, view
from tribodyn.mechanism.figures.animation import moving
from tribodyn.mechanism.frames import frame
from tribodyn.views.charts import LOOKS
from tribodyn.views.gltf import Solid

_THICK: Final = 0.012
"""Radius of rods, as a share of the size of the mechanism."""
_SIDES: Final = 12


def solids(dataset: xr.Dataset, times: FloatArray) -> tuple[list[Solid], str]:
    """Return the bodies at some times [s], shape (n_t,), and the axis that points upwards."""
    drawn, position, orientation = moving(dataset, times)
    everywhere = np.concatenate([*drawn.points, drawn.centres])
    radius = _THICK * float(np.linalg.norm(np.ptp(everywhere, axis=0)) or 1.0)
    found = []
    for k, name in enumerate(drawn.bodies):
        colour = to_rgb(COLOURS[LOOKS[(k + 1) % len(LOOKS)][0]])
        found.append(Solid(name, colour, *_rods(drawn, k, radius), position[:, k], orientation[:, k]))
    _, up = view(position.reshape(-1, 3))
    return found, AXES[int(np.argmax(up))]


def _rods(drawn: Skeleton, body: int, radius: float) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return vertices and triangles of a body: rods from its first joint, or its middle, to the others."""
    points = drawn.points[body] - drawn.centres[body]
    hub, ends = (points[0], points[1:]) if len(points) == 2 else (points.mean(axis=0), points)
    vertices, triangles = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
    for end in ends:
        corners, facets = _rod(hub, end, radius)
        triangles.append(facets + sum(map(len, vertices)))
        vertices.append(corners)
    return np.concatenate(vertices), np.concatenate(triangles)


def _rod(start: FloatArray, end: FloatArray, radius: float) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return vertices and triangles of a closed prism; of a short one where both ends are at one point."""
    way = end - start
    length = float(np.linalg.norm(way))
    axes = frame(way / length if length > radius else np.array([0.0, 0.0, 1.0]), np.zeros(3))
    turn = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    ring = radius * (np.outer(np.cos(turn), axes[:, 0]) + np.outer(np.sin(turn), axes[:, 1]))
    if length <= radius:
        start, end = start - radius * axes[:, 2], start + radius * axes[:, 2]
    corners = np.concatenate([start + ring, end + ring, [start, end]])
    k, n = np.arange(_SIDES), _SIDES
    after = (k + 1) % n
    sides = [[k, after, after + n], [k, after + n, k + n]]
    caps = [[after, k, np.full(n, 2 * n)], [k + n, after + n, np.full(n, 2 * n + 1)]]
    return corners, np.concatenate([np.transpose(facet) for facet in (*sides, *caps)])
