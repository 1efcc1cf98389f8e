"""Protocol of shapes: a shape puts nodes on the surfaces of a joint."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels.joints.surface.bulk import FACE


@dataclass(frozen=True)
class Surface:
    """Nodes of one surface, in the socket's frame, the shaft where it is drawn."""

    name: str  #: Which surface of the joint.
    position: FloatArray  #: x_k on the shaft [m], shape (n, 3).
    normal: FloatArray  #: n_k from the shaft into the socket, shape (n, 3).
    area: FloatArray  #: A_k [m²], shape (n,).
    gap: FloatArray  #: h0_k without wear [m], shape (n,).
    rows: NDArray[np.void]  #: Records ``Row`` whose nodes count from the first of this surface.
    tilt: float  #: What turning does to the gaps, see ``kernels/joints/surface/tilt.py``.
    #: Names and values of the two coordinates of a map of the nodes, row by row; one for nodes in no order.
    axes: dict[str, FloatArray]
    #: Whether the nodes stay where they are on the socket while the shaft slides through it.
    slides: bool = False
    #: Radius ρ of the second-order term of the tilt [m], see ``kernels/joints/surface/tilt.py``.
    lean: float = 0.0
    #: How much of a change of the radial clearance and of the play along the axis its gaps gain [1].
    opens: tuple[float, float] = (1.0, 0.0)
    #: How the compliance of elastic bodies follows its contact, see ``kernels/joints/surface/bulk.py``;
    #: radius of the bore, or half the width of a face, and the clearance of a ball [m].
    extent: float = FACE
    size: float = 0.0
    room: float = 0.0

    @property
    def field_shape(self) -> tuple[int, ...]:
        """Shape of a map of the nodes."""
        return tuple(values.size for values in self.axes.values())


@dataclass(frozen=True)
class Points:
    """Points of contact of smooth surfaces of a shape: circles, or one sphere."""

    #: Radius of the shaft, radial clearance, and length that two circles share, 0 for a sphere [m].
    radius: float
    clearance: float
    length: float
    heights: tuple[float, ...]  #: Of the centres along the axis [m].

    @property
    def bore_radius(self) -> float:
        """Radius of the socket [m]."""
        return self.radius + self.clearance


class Shape(Protocol):
    """A node generator; its sizes are the arguments by which it is made."""

    @property
    def clearance(self) -> float:
        """Gap between shaft and socket, the shaft in the middle: of round ones the radial clearance [m]."""

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the surfaces with ``grid`` nodes along their two directions."""

    def points(self) -> Points:
        """Return the points of contact of smooth surfaces, or refuse a shape that has none."""


def check_positive(shape: str, **sizes: float) -> None:
    """Refuse a size that is not above zero; their keys are those of the table ``clearance``."""
    for name, value in sizes.items():
        if not (np.isfinite(value) and value > 0.0):
            raise InputError(f"of a {shape} must be a length above zero, not {value:g}", key=name)


def no_points(shape: str) -> Points:
    """Refuse a point contact."""
    raise InputError(
        f"a {shape} touches over its surface, not at points; use contact = 'surface'", key="contact"
    )
