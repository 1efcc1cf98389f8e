"""Axes of joints."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray


def frame(axis: FloatArray, second: FloatArray) -> FloatArray:
    """Return axes as columns: z along ``axis``, x near ``second``, or anywhere if they are parallel."""
    z = axis / np.linalg.norm(axis)
    x = second - z * (z @ second)
    if np.linalg.norm(x) < 1.0e-8 * max(float(np.linalg.norm(second)), 1.0e-300):
        x = np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))])
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
