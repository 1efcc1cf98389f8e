"""Directions in a case."""

from __future__ import annotations

import math

from tribodyn.cases.case import demand
from tribodyn.cases.fields import Vector


def unit(direction: Vector, key: str) -> Vector:
    """Return a direction as a unit vector; one of no length is refused."""
    length = math.hypot(*direction)
    demand(length > 0.0, key, "a direction has a length above zero")
    x, y, z = direction
    return x / length, y / length, z / length


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))
