"""The mechanism in motion: a film of its bodies as lines between joints, and solids of round rods."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.cases.units import AXES
from tribodyn.core.errors import InputError
from tribodyn.figures.chart import COLOURS
from tribodyn.figures.style import INK, caption, finish, sheet
from tribodyn.mechanism.assembly.skeleton import MM, Skeleton, case_of, outline_at, skeleton, view
from tribodyn.mechanism.figures.mechanism import direction, draw_at, draw_joints, paper
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.sections.mechanism import at_times
from tribodyn.views.charts import LOOKS
from tribodyn.views.gltf import Solid
from tribodyn.views.playback import time_unit

TITLE: Final = "The mechanism in motion"
_ROOM: Final = 0.08  #: Room around the mechanism, as a share of its size.


def moving(dataset: xr.Dataset, times: FloatArray) -> tuple[Skeleton, FloatArray, FloatArray]:
    """Return the picture's content, with positions and orientations at some times; refuse a body at rest."""
    case, motion = case_of(dataset), at_times(dataset, times)
    if case is None or motion is None:
        raise InputError("this result holds no motion to show", key="animate")
    return skeleton(case), *motion


class MechanismFilm:
    """A figure that shows the mechanism at one of some times.

    ``times``: times that may be shown [s], shape (n_t,).
    """

    def __init__(self, dataset: xr.Dataset, times: FloatArray) -> None:
        self._drawn, self._position, self._orientation = moving(dataset, times)
        unit, scale = time_unit(dataset)
        self._times = [f"{scale * t:.4g} {unit}" for t in times]
        self._plane = paper(*view(MM * self._position.reshape(-1, 3)))
        self.figure = sheet(dataset, TITLE, 4.2)
        self._axes = self.figure.subplots()
        everywhere = np.concatenate([part.reshape(-1, 3) for part in self._parts()]) @ self._plane.T
        low, high = everywhere.min(axis=0), everywhere.max(axis=0)
        room = _ROOM * float(np.linalg.norm(high - low))
        self._limits = [(a - room, b + room) for a, b in zip(low, high, strict=True)]
        self.show(0)
        # Arranging the parts of a figure takes longer than drawing it: once is enough.
        self.figure.draw_without_rendering()
        self.figure.set_layout_engine("none")

    def _parts(self) -> list[FloatArray]:
        """Return all points that are drawn at any time [mm]."""
        drawn, position, orientation = self._drawn, self._position, self._orientation
        lines = [drawn.lines(b, position[:, b], orientation[:, b]) for b in range(len(drawn.bodies))]
        elements = (*drawn.outlines, *drawn.springs)
        return [*lines, *(outline_at(drawn, line, position, orientation) for line in elements)]

    def show(self, frame: int) -> None:
        """Draw the mechanism at one of the times."""
        axes = self._axes
        axes.clear()
        axes.set_aspect("equal")
        now = self._position[frame], self._orientation[frame]
        draw_at(axes, self._drawn, self._plane, *now, INK)
        draw_joints(axes, self._drawn, self._plane, *now)
        axes.set_xlim(self._limits[0])
        axes.set_ylim(self._limits[1])
        finish(axes, *(direction(row) for row in self._plane))
        caption(axes, self._times[frame], "right")


_THICK: Final = 0.012  #: Radius of rods, as a share of the size of the mechanism.
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
