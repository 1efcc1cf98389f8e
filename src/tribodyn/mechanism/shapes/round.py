"""Balls in a race and along a bore, and a round pin in a slot between flat walls."""

from typing import Any, ClassVar

from tribodyn.cases.case import NamedGroup
from tribodyn.cases.fields import quantity
from tribodyn.joints.shapes import Ball, Slot, Sphere
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local


class RaceKeys(NamedGroup):
    """Size of a race."""

    band: float = quantity(
        "40 deg", "half the width of the race of a ball, as a latitude", "assumed", gt=0, le="90 deg"
    )


class BallInRace(ClearanceShape):
    """A ball in a race."""

    NAME: ClassVar[str] = "sphere"
    KEYS: ClassVar[type[NamedGroup]] = RaceKeys
    IDEAL: ClassVar[str] = "spherical"

    def of(self, keys: Any, local: Local) -> Sphere:
        """Return the ball and its race."""
        return Sphere(keys.radius, keys.radial, keys.band)


class BallInBore(ClearanceShape):
    """A ball in a bore."""

    NAME: ClassVar[str] = "ball"
    IDEAL: ClassVar[str] = "pin-slot"

    def of(self, keys: Any, local: Local) -> Ball:
        """Return the ball."""
        return Ball(keys.radius, keys.radial)


class PinInSlot(ClearanceShape):
    """A pin between two flat walls."""

    NAME: ClassVar[str] = "slot"
    NEEDED: ClassVar[dict[str, str]] = {
        **ClearanceShape.NEEDED,
        "length": "the length of the pin in its slot",
    }
    EXAMPLE: ClassVar[dict[str, object]] = {**ClearanceShape.EXAMPLE, "length": "20 mm"}

    WALLS: ClassVar[int] = 2

    def of(self, keys: Any, local: Local) -> Slot:
        """Return the slot as drawn."""
        return Slot(keys.radius, keys.radial, keys.length)
