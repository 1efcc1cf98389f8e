"""Ideal joints as constraint rows: one entry of one list for each kind."""

from __future__ import annotations

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


ROWS: Final[dict[str, tuple[Row, ...]]] = {
    "fixed": (*_BALL, *_ALIGNED, *_NO_TURN),
    "revolute": (*_BALL, *_ALIGNED),
    "spherical": _BALL,
    "cylindrical": (*_ALONG, *_ALIGNED),
    "prismatic": (*_ALONG, *_ALIGNED, *_NO_TURN),
    "universal": (*_BALL, (DIRECTION, 2, 0)),
    "pin-slot": _ALONG,
    "planar": (_BALL[2], *_ALIGNED),
    "spring-damper": (),
}
"""What vanishes in the ideal joints of ``kinds.KINDS``.

z is the axis, of a universal joint that on the first body, whose other axis is the x of the shaft.
"""


def frame(axis: FloatArray, second: FloatArray) -> FloatArray:
    """Return axes as columns: z along ``axis``, x near ``second``, or anywhere if they are parallel."""
    z = axis / np.linalg.norm(axis)
    x = second - z * (z @ second)
    if np.linalg.norm(x) < 1.0e-8 * max(float(np.linalg.norm(second)), 1.0e-300):
        x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
