"""A ball in a race: ball joints and rod ends. Its pressure has no moment about the centre."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.base import Points, Surface, check_positive
from tribodyn.joints.shapes.rings import Rings, across
from tribodyn.kernels.joints.surface.tilt import NO_TILT


@dataclass(frozen=True)
class Sphere:
    """Sizes of a ball in a race.

    Attributes
    ----------
    radius
        Of the ball [m].
    clearance
        Radial clearance [m].
    band
        Latitude up to which the race reaches on both sides of the plane across the axis [rad].
    """

    radius: float
    clearance: float
    band: float

    def __post_init__(self) -> None:
        """Refuse sizes that make no joint."""
        check_positive("sphere", radius=self.radius, radial=self.clearance)
        if not 0.0 < self.band <= 0.5 * math.pi:
            raise InputError(f"must lie above 0 and at most at 90°, not {self.band:g} rad", key="band")

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the band; weights are Gauss's in the sine of the latitude, over which area is uniform."""
        n_theta, n_latitude = grid
        sine, weight = across(-portable.sin(self.band), portable.sin(self.band), n_latitude)
        cosine = np.sqrt(1.0 - sine**2)
        bore = self.radius + self.clearance
        strip = bore * bore * weight
        rings = Rings(self.radius * cosine, self.radius * sine, cosine, sine, strip)
        return (rings.surface("race", ("latitude", portable.asin(sine)), self.clearance, n_theta, NO_TILT),)

    def points(self) -> Points:
        """Return the one sphere; its force acts wherever the ball is, on the race or beside it."""
        return Points(self.radius, self.clearance, 0.0, (0.0,))
