"""A flat ring across the axis: collars, flanges, end faces. It pushes and never pulls."""

from dataclasses import dataclass, replace

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.rings import Rings, across
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.tilt import AXIS


@dataclass(frozen=True)
class Annulus:
    """Sizes of a flat ring [m].

    Attributes
    ----------
    inner, outer
        Its radii.
    clearance
        Gap as drawn; 0 for faces that lie on each other.
    height
        Of the face along the axis, from the joint's point.
    direction
        From the shaft into the socket: 1 along the axis, −1 against it, as a collar that rests on its
        bushing.
    """

    inner: float
    outer: float
    clearance: float = 0.0
    height: float = 0.0
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
