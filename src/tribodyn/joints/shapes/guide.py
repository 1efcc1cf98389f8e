"""A block between the flat walls of its guide, along which it slides.

Every wall is a face of the block, on which the gap is the same as drawn. Turned in its play, the block
touches at the ends of its faces and at their edges.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Final, Self

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.mesh import patches
from tribodyn.joints.shapes.rings import across
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.tilt import WHOLE

FEWEST: Final = 4  #: Nodes across a wall or a pad, however narrow it is.


def rows_across(around: int) -> int:
    """Return the nodes across a wall: those around a block are shared out among four."""
    return max(around // 4, FEWEST)


@dataclass(frozen=True)
class Wall:
    """A face of the block in its cross-section, where a wall of the channel stands."""

    name: str  #: Of its surface.
    #: Its edges [m], anticlockwise around the block: outside lies on the right of the way.
    first: tuple[float, float]
    last: tuple[float, float]

    @cached_property
    def width(self) -> float:
        """Distance of its edges [m]."""
        return float(portable.hypot(self.last[0] - self.first[0], self.last[1] - self.first[1]))

    @cached_property
    def normal(self) -> FloatArray:
        """Normal into the channel, shape (3,)."""
        way = np.subtract(self.last, self.first) / self.width
        return np.array([way[1], -way[0], 0.0])

    @property
    def distance(self) -> float:
        """Distance of its plane from the axis of the block [m]."""
        return float(self.normal[0] * self.first[0] + self.normal[1] * self.first[1])


@dataclass(frozen=True)
class Guide:
    """Sizes of a block in a channel [m]."""

    walls: tuple[Wall, ...]  #: In their order around the block.
    clearance: float  #: Gap at the walls that are furthest apart, where the block stands in the middle.
    length: float  #: Along which both can touch: of the block, or of the channel that it passes through.
    #: Whether it passes through a channel that is shorter, such as a rail through its carriage.
    through: bool = False
    #: What the gap at each wall has more, where temperatures change; nothing by default.
    grown: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse sizes that make no guide."""
        check_positive("guide", radial=self.clearance, length=self.length)
        for wall in self.walls:
            if not (wall.width > 0.0 and wall.distance > 0.0):
                raise InputError(f"has no {wall.name} wall on which its block can rest", key="width")

    @property
    def gaps(self) -> tuple[float, ...]:
        """Gap at each wall [m]."""
        return tuple(self.clearance + more for more in self.grown or (0.0,) * len(self.walls))

    @property
    def radius(self) -> float:
        """Largest distance of a wall from the axis [m]: that of a bore in the place of the channel."""
        return max(wall.distance for wall in self.walls)

    def grown_by(self, hot: Callable[[float], float]) -> Self:
        """Return the guide at temperatures at which a wall at a distance has the clearance ``hot`` [m]."""
        most = hot(self.radius)
        return replace(self, clearance=most, grown=tuple(hot(wall.distance) - most for wall in self.walls))

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the walls."""
        return tuple(self._wall(wall, gap, grid) for wall, gap in zip(self.walls, self.gaps, strict=True))

    def _wall(self, wall: Wall, gap: float, grid: tuple[int, int]) -> Surface:
        way, half = np.subtract(wall.last, wall.first) / wall.width, 0.5 * self.length
        s, strip = across(0.0, wall.width, rows_across(grid[0]))
        z, weight = across(-half, half, grid[1])
        place = wall.first + s[:, None] * way
        position = np.column_stack([np.tile(place, (z.size, 1)), np.repeat(z, s.size)])
        normal, area = np.tile(wall.normal, (len(position), 1)), np.outer(weight, strip).ravel()
        angle = np.array([portable.atan2(y, x) for x, y in place])
        return Surface(
            name=wall.name,
            position=position,
            normal=normal,
            area=area,
            gap=np.full(area.size, gap),
            rows=patches(position, normal, area),
            tilt=WHOLE,
            axes={"z": z, "theta": np.where(angle < angle[0], angle + 2.0 * np.pi, angle)},
            slides=self.through,
            opens=(wall.distance / self.radius, 0.0),
            size=0.5 * min(wall.width, self.length),
        )

    def points(self) -> Points:
        """Refuse a point contact."""
        return no_points("guide")

    def corners(self) -> tuple[FloatArray, FloatArray]:
        """Return the gaps at the corners of all faces (n,), behind their losses by displacement and rotation.

        The losses have the shape (n, 6).
        """
        half, edges = (
            0.5 * self.length,
            [(wall, edge) for wall in self.walls for edge in (wall.first, wall.last)],
        )
        found = [
            [*wall.normal, *np.cross([*edge, end], wall.normal)]
            for end in (-half, half)
            for wall, edge in edges
        ]
        return np.array(found), np.tile(np.repeat(self.gaps, 2), 2)

    def outlines(self) -> list[tuple[FloatArray, FloatArray]]:
        """Return the corners of its cross-section [m], and by how much a gap of one sets off those of walls.

        Shapes (n, 2); between walls that share no edge there is open space.
        """
        found = []
        for one, after in pairwise((*self.walls, self.walls[0])):
            if one.last == after.first:
                found.append((one.last, _crossing(one, after, 1.0, 1.0)))
            else:
                found += [(one.last, one.normal[:2]), (after.first, after.normal[:2])]
        points, ways = zip(*found, strict=True)
        return [(np.array(points), np.array(ways))]

    def room(self) -> FloatArray:
        """Return the corners of the area in which the middle of an upright block can be [m], shape (n, 2)."""
        pairs = pairwise([*zip(self.walls, self.gaps, strict=True), (self.walls[0], self.gaps[0])])
        return np.array([_crossing(one, after, gap, other) for (one, gap), (after, other) in pairs])


def _crossing(first: Wall, second: Wall, gap: float, other: float) -> FloatArray:
    """Return the point at distances along the normals of two walls, shape (2,)."""
    (a, b), (c, d) = first.normal[:2], second.normal[:2]
    return np.asarray(np.array([gap * d - other * b, other * a - gap * c]) / (a * d - b * c))
