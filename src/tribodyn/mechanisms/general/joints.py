"""Joints as constraint rows: one entry of one list for each kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.mechanism.data import DIRECTION, POINT

Row = tuple[int, int, int]
"""Kind of a row, axis of the socket, axis of the shaft; 0, 1, 2 for x, y, z."""

_BALL: Final[tuple[Row, ...]] = tuple((POINT, i, 0) for i in range(3))
_ALONG: Final = _BALL[:2]
_ALIGNED: Final[tuple[Row, ...]] = ((DIRECTION, 0, 2), (DIRECTION, 1, 2))
_NO_TURN: Final[tuple[Row, ...]] = ((DIRECTION, 1, 0),)


@dataclass(frozen=True)
class Kind:
    """A kind of ideal joint.

    Attributes
    ----------
    rows
        What vanishes.
    coordinates
        Which of ``angle`` and ``position`` are free, so that a drive can act there.
    """

    rows: tuple[Row, ...]
    coordinates: tuple[str, ...] = ()


KINDS: Final[dict[str, Kind]] = {
    "fixed": Kind((*_BALL, *_ALIGNED, *_NO_TURN)),
    "revolute": Kind((*_BALL, *_ALIGNED), ("angle",)),
    "spherical": Kind(_BALL),
    "cylindrical": Kind((*_ALONG, *_ALIGNED), ("angle", "position")),
    "prismatic": Kind((*_ALONG, *_ALIGNED, *_NO_TURN), ("position",)),
    "universal": Kind((*_BALL, (DIRECTION, 2, 0))),
    "pin-slot": Kind(_ALONG, ("position",)),
    "planar": Kind((_BALL[2], *_ALIGNED), ("angle",)),
    "spring-damper": Kind((), ("angle", "position")),
}
"""All kinds by name; z is the axis, of a universal joint that on the first body, whose other axis is the
shaft's x."""


def frame(axis: FloatArray, second: FloatArray) -> FloatArray:
    """Return axes as columns: z along ``axis``, x near ``second``, or anywhere if they are parallel."""
    z = axis / np.linalg.norm(axis)
    x = second - z * (z @ second)
    if np.linalg.norm(x) < 1.0e-8 * max(float(np.linalg.norm(second)), 1.0e-300):
        x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
