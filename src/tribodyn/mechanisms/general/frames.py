"""The frame at rest, and frames of joints."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense

GROUND: Final = "ground"
"""Name of the body that never moves."""


def frame(axis: FloatArray, second: FloatArray) -> FloatArray:
    """Return axes as columns: z along ``axis``, x near ``second``, or anywhere if they are parallel."""
    z = axis / dense.norm(axis)
    x = second - z * dense.product(z, second)
    if dense.norm(x) < 1.0e-8 * max(float(dense.norm(second)), 1.0e-300):
        x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
    x = x / dense.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
