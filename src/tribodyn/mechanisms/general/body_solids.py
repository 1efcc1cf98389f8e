"""Bodies as the solids that their keys describe, where they were modelled: round ones and boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribodyn.cases.directions import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.general.body import BodyKeys


@dataclass(frozen=True)
class BodySolid:
    """A solid as modelled.

    Attributes
    ----------
    points
        Of a round solid the middles of both ends, shape (2, 3); of a box its centre and the middles of three
        faces, shape (4, 3) [m].
    radius
        Radius of a round solid [m]; 0 of a box.
    """

    points: FloatArray
    radius: float


def body_solid(body: BodyKeys) -> BodySolid | None:
    """Return the solid of a body; None of one whose keys give mass properties only."""
    if body.start is not None and body.end is not None and body.radius is not None:
        return BodySolid(np.array([body.start, body.end]), body.radius)
    centre = np.array(body.centre)
    first, second = unit(body.first_axis, "first_axis"), unit(body.second_axis, "second_axis")
    if body.length is not None and body.radius is not None:
        half = 0.5 * body.length * np.array(first)
        return BodySolid(np.array([centre - half, centre + half]), body.radius)
    if body.size is not None:
        axes = np.array([first, second, np.cross(first, second)])
        return BodySolid(np.array([centre, *(centre + 0.5 * np.array(body.size)[:, None] * axes)]), 0.0)
    return None
