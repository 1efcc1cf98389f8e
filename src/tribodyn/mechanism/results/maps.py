"""Fields over the nodes of all joints as one array: surface by surface, row by row."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.problem import Floats
from tribodyn.joints.clearances import Place

LATITUDE: Final = "latitude"


@dataclass(frozen=True)
class Maps:
    """Maps of nodes, which kernels count through all surfaces.

    Surfaces with fewer rows or columns than the largest are filled up: their last row and column stand there
    again, and fields are zero there.
    """

    names: tuple[str, ...]  #: Of the surfaces: joint and surface of it.
    places: tuple[Place, ...]  #: Where they lie among all nodes.

    @property
    def n_nodes(self) -> int:
        """Number of all nodes."""
        return self.places[-1].nodes.stop if self.places else 0

    @property
    def shape(self) -> tuple[int, int, int]:
        """Surfaces, rows, columns."""
        shapes = np.array([_shape(place) for place in self.places] or [(0, 0)])
        return len(self.places), int(shapes[:, 0].max()), int(shapes[:, 1].max())

    @property
    def area(self) -> FloatArray:
        """Area of each node [m²], shape (n_nodes,)."""
        return np.concatenate([np.empty(0), *(place.surface.area for place in self.places)])

    def __call__(self, values: Floats) -> Floats:
        """Return fields of shape (..., n_nodes) as maps of shape (..., surfaces, rows, columns)."""
        maps = np.zeros((*values.shape[:-1], *self.shape), dtype=values.dtype)
        for k, place in enumerate(self.places):
            rows, columns = _shape(place)
            own = values[..., place.nodes].reshape(*values.shape[:-1], rows, columns)
            maps[..., k, :rows, :columns] = own
        return maps

    def coordinates(self) -> dict[str, FloatArray]:
        """Return the places of rows and the angles of columns, as results hold them."""
        _, n_rows, n_columns = self.shape
        return {
            "row": np.arange(n_rows, dtype=np.float64),
            "column": np.arange(n_columns, dtype=np.float64),
            "row_place": _filled([_axis(place, 0) for place in self.places], n_rows),
            "column_angle": _filled([_axis(place, 1) for place in self.places], n_columns),
        }


def _shape(place: Place) -> tuple[int, int]:
    """Return rows and columns of a surface; nodes in no order are one row."""
    shape = (1, *place.surface.field_shape)[-2:]
    return int(shape[0]), int(shape[1])


def _axis(place: Place, which: int) -> FloatArray:
    names, axes = list(place.surface.axes), list(place.surface.axes.values())
    if len(axes) == 1:
        return np.arange(_shape(place)[which], dtype=np.float64)
    # An arc of a ball's race instead of its latitude: rows are then in metres everywhere.
    return axes[which] * (np.linalg.norm(place.surface.position[0]) if names[which] == LATITUDE else 1.0)


def _filled(axes: Sequence[FloatArray], n: int) -> FloatArray:
    return np.array([np.pad(axis, (0, n - axis.size), mode="edge") for axis in axes])
