"""A round pin in a slot between two flat walls, along which it slides and in which it turns.

The pin lies along x, the slot along z, its walls stand at ±y. Nodes are on the strips of the pin that can
touch; they travel with it and do not turn.
"""

from dataclasses import dataclass

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.joints.shapes.guide import rows_across
from tribodyn.joints.shapes.mesh import patches
from tribodyn.joints.shapes.rings import across
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.tilt import LINE

WALLS = {"upper": 1.0, "lower": -1.0}


@dataclass(frozen=True)
class Slot:
    """Sizes of a pin in a slot [m]."""

    radius: float  #: Of the pin.
    clearance: float  #: Gap on either side, the pin in the middle.
    length: float  #: Of the pin within the slot.

    def __post_init__(self) -> None:
        """Refuse sizes that make no joint."""
        check_positive("slot", radius=self.radius, radial=self.clearance, length=self.length)

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the two walls, with nodes up to where a pin that touches stands off by the clearance."""
        return tuple(self._wall(name, side, grid) for name, side in WALLS.items())

    def _wall(self, name: str, side: float, grid: tuple[int, int]) -> Surface:
        edge = self.radius * float(portable.sin(portable.acos(1.0 - self.clearance / self.radius)))
        s, strip = across(-edge, edge, rows_across(grid[0]))
        x, weight = across(-0.5 * self.length, 0.5 * self.length, grid[1])
        angle, area = portable.asin(s / self.radius), np.outer(weight, strip).ravel()
        rise = self.radius * portable.cos(angle)
        position = np.column_stack([np.repeat(x, s.size), *np.tile([side * rise, side * s], x.size)])
        normal = np.tile([0.0, side, 0.0], (area.size, 1))
        return Surface(
            name=f"{name} wall",
            position=position,
            normal=normal,
            area=area,
            gap=np.tile(self.clearance + self.radius - rise, x.size),
            rows=patches(position, normal, area),
            tilt=LINE,
            axes={"z": x, "theta": angle + 0.5 * np.pi * (2.0 - side)},
            size=float(s[-1]),
        )

    def points(self) -> Points:
        """Refuse a point contact."""
        return no_points("slot")

    def corners(self) -> tuple[FloatArray, FloatArray]:
        """Return the gaps at the ends of the pin, behind their losses as those of a guide."""
        half = 0.5 * self.length
        found = [[0.0, y, 0.0, 0.0, 0.0, y * x] for y in WALLS.values() for x in (-half, half)]
        return np.array(found), np.full(4, self.clearance)

    def outlines(self) -> list[tuple[FloatArray, FloatArray]]:
        """Return the same as a guide for plates in the places of its walls."""
        half, r = 0.5 * self.length, self.radius
        plate = np.array([[-half, r], [half, r], [half, 1.5 * r], [-half, 1.5 * r]])
        return [(plate * [1.0, side], np.tile([0.0, side], (4, 1))) for side in WALLS.values()]

    def room(self) -> FloatArray:
        """Return the corners of the room across; along the pin it is free [m], shape (4, 2)."""
        return self.clearance * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
