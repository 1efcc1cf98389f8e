"""A ring that turns between pads, such as a unison ring on its casing.

Faces of pads lie on a cylinder about the axis as drawn. Nodes stay on the pads; the ring turns through them.
Of a tilt φ the second order, ½ R φ², is left out: below a nanometre where it is below 1e-4 at 0.2 m.
"""

import math
from dataclasses import dataclass

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.guide import FEWEST
from tribodyn.joints.shapes.mesh import patches
from tribodyn.joints.shapes.rings import across
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.tilt import AXIS


def nodes_along(around: int, width: float, bore: float) -> int:
    """Return the nodes along a pad without its edges: its share of those around a ring."""
    return max(math.ceil(around * width / (2.0 * math.pi * bore)), FEWEST)


@dataclass(frozen=True)
class Pads:
    """Sizes of a ring between equal pads at equal angles [m]."""

    radius: float  #: Of the ring.
    clearance: float  #: Radial gap at every pad.
    length: float  #: Of the pads along the axis.
    width: float  #: Of a pad along the ring.
    count: int  #: Of the pads.
    first: float = 0.0  #: Angle of the middle of the first pad from the x axis [rad].

    def __post_init__(self) -> None:
        """Refuse sizes that make no joint."""
        check_positive(
            "ring", radius=self.radius, radial=self.clearance, length=self.length, pad_width=self.width
        )
        if self.count * self.width > 2.0 * math.pi * (self.radius + self.clearance) * (1.0 + 1e-9):
            raise InputError(f"that of {self.count} pads leaves no room between them", key="pad_width")

    @property
    def edges(self) -> FloatArray:
        """Angles of both edges of each pad [rad], shape (count, 2)."""
        middle, half = 2.0 * math.pi * np.arange(self.count) / self.count, 0.5 * self.width
        return (self.first + middle)[:, None] + half / (self.radius + self.clearance) * np.array([-1.0, 1.0])

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the pads; the nodes around a whole ring are shared out by width."""
        return tuple(self._pad(k, first, last, grid) for k, (first, last) in enumerate(self.edges.tolist()))

    def _pad(self, number: int, first: float, last: float, grid: tuple[int, int]) -> Surface:
        bore = self.radius + self.clearance
        theta, arc = across(first, last, nodes_along(grid[0], self.width, bore))
        z, weight = across(-0.5 * self.length, 0.5 * self.length, grid[1])
        around = np.column_stack([portable.cos(theta), portable.sin(theta), 0.0 * theta])
        normal, area = np.tile(around, (z.size, 1)), np.outer(weight, bore * arc).ravel()
        position = self.radius * normal
        position[:, 2] = np.repeat(z, theta.size)
        return Surface(
            name=f"pad {number + 1}",
            position=position,
            normal=normal,
            area=area,
            gap=np.full(area.size, self.clearance),
            rows=patches(position, normal, area),
            tilt=AXIS,
            axes={"z": z, "theta": theta},
            slides=True,
            size=0.5 * min(self.width, self.length),
        )

    def corners(self) -> tuple[FloatArray, FloatArray]:
        """Return the gaps at the corners of all pads (n,), behind their losses as those of a guide."""
        around = np.column_stack([portable.cos(self.edges.ravel()), portable.sin(self.edges.ravel())])
        ends = -0.5 * self.length, 0.5 * self.length
        found = [[x, y, 0.0, -z * y, z * x, 0.0] for z in ends for x, y in around]
        return np.array(found), np.full(len(found), self.clearance)

    def room(self) -> FloatArray:
        """Return corners of the area that an upright ring has for its middle [m], shape (3 count, 2)."""
        edges, open_way = self.edges, math.pi / self.count - 0.5 * float(np.ptp(self.edges[0]))
        angles = np.column_stack([edges, edges[:, 1] + open_way])
        reach = self.clearance / np.array([1.0, 1.0, math.cos(open_way)])
        return np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=-1).reshape(-1, 2)

    def points(self) -> Points:
        """Refuse a point contact."""
        return no_points("ring between pads")
