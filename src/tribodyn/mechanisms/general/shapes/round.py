"""Balls: in a race, and in a bore along which they slide."""

from __future__ import annotations

from typing import Any, ClassVar

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.shapes import Ball, Sphere
from tribodyn.mechanisms.general.shapes.base import ClearanceShape


class BallInRace(ClearanceShape):
    """A ball in a race."""

    NAME: ClassVar[str] = "sphere"
    IDEAL: ClassVar[str] = "spherical"

    def of(self, keys: Any, facets: FloatArray | None = None) -> Sphere:
        """Return the ball and its race."""
        return Sphere(keys.radius, keys.radial, keys.band)


class BallInBore(ClearanceShape):
    """A ball in a bore."""

    NAME: ClassVar[str] = "ball"
    IDEAL: ClassVar[str] = "pin-slot"

    def of(self, keys: Any, facets: FloatArray | None = None) -> Ball:
        """Return the ball."""
        return Ball(keys.radius, keys.radial)
