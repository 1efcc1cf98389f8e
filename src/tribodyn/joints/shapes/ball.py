"""A ball in a bore, along which it slides freely: the end of a lever in a slot, a ball on a guide.

Ball and bore touch around the equator of the ball; beside it the gap opens by R (1 − cos λ). Nodes travel
with the ball.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.base import Points, Surface, check_positive, no_points
from tribodyn.joints.shapes.rings import Rings, across
from tribodyn.kernels.joints.surface.tilt import NO_TILT


@dataclass(frozen=True)
class Ball:
    """Sizes of a ball in a bore.

    Attributes
    ----------
    radius
        Of the ball [m].
    clearance
        Radial clearance [m].
    band
        Latitude up to which there are nodes on both sides of the equator [rad]; what can touch must lie
        within. By default that at which the gap has opened by once the clearance.
    """

    radius: float
    clearance: float
    band: float | None = None

    def __post_init__(self) -> None:
        """Refuse sizes that make no joint."""
        check_positive("ball", radius=self.radius, radial=self.clearance)
        if self.band is not None and not 0.0 < self.band < 0.5 * math.pi:
            raise InputError(f"must lie between 0 and 90°, not at {self.band:g} rad", key="band")

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the band, weighed by the area of the bore."""
        n_theta, n_z = grid
        band = portable.acos(1.0 - self.clearance / self.radius) if self.band is None else self.band
        edge = self.radius * portable.sin(band)
        z, weight = across(-edge, edge, n_z)
        ones, latitude = np.ones(z.size), portable.asin(z / self.radius)
        rings = Rings(
            self.radius * portable.cos(latitude),
            z,
            ones,
            0.0 * ones,
            (self.radius + self.clearance) * weight,
        )
        gap = self.clearance + self.radius * (1.0 - portable.cos(latitude))
        return (rings.surface("ball", ("latitude", latitude), gap, n_theta, NO_TILT),)

    def points(self) -> Points:
        """Refuse a point contact: its laws are for a sphere in a sphere, and for cylinders."""
        return no_points("ball in a bore")
