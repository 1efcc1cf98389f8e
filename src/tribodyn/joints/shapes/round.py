"""Balls in a race and along a bore, and a pin in a slot along which it slides.

The pressure of a race has no moment about the centre. Ball and bore touch around the equator of the ball;
beside it the gap opens by R (1 − cos λ). Nodes travel with the ball.

The pin lies along x, the slot along z, its walls stand at ±y. Nodes are on the strips of the pin that can
touch; they travel with it and do not turn.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.guide import rows_across
from tribodyn.joints.shapes.mesh import patches
from tribodyn.joints.shapes.rings import Rings, across
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.bulk import HOLE, RACE
from tribodyn.kernels.joints.surface.tilt import LINE, NO_TILT


@dataclass(frozen=True)
class Sphere:
    """Sizes of a ball in a race."""

    radius: float  #: Of the ball [m].
    clearance: float  #: Radial clearance [m].
    band: float  #: Latitude up to which the race reaches on both sides of the plane across the axis [rad].

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
        surface = rings.surface("race", ("latitude", portable.asin(sine)), self.clearance, n_theta, NO_TILT)
        return (replace(surface, extent=RACE, size=bore, room=self.clearance),)

    def points(self) -> Points:
        """Return the one sphere; its force acts wherever the ball is, on the race or beside it."""
        return Points(self.radius, self.clearance, 0.0, (0.0,))


@dataclass(frozen=True)
class Ball:
    """Sizes of a ball in a bore."""

    radius: float  #: Of the ball [m].
    clearance: float  #: Radial clearance [m].
    #: Latitude up to which there are nodes on both sides of the equator [rad]; what can touch must lie
    #: within. By default that at which the gap has opened by once the clearance.
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
            self.radius * portable.cos(latitude), z, ones, 0.0 * ones, (self.radius + self.clearance) * weight
        )
        gap = self.clearance + self.radius * (1.0 - portable.cos(latitude))
        surface = rings.surface("ball", ("latitude", latitude), gap, n_theta, NO_TILT)
        return (replace(surface, extent=HOLE, size=self.radius + self.clearance, room=self.clearance),)

    def points(self) -> Points:
        """Refuse a point contact: its laws are for a sphere in a sphere, and for cylinders."""
        return no_points("ball in a bore")


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
