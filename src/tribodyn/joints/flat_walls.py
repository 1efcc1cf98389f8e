"""Shafts between flat walls: where smooth, rigid ones rest."""

from typing import Final, TypeAlias

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.shapes import Guide, Slot

FlatWalls: TypeAlias = Guide | Slot  #: Shapes with flat walls.
#: Distance of a point beyond the walls, over the clearance: loads so much smaller than others do not move.
_FAR: Final = 1.0e3


def resting(shape: FlatWalls, loads: FloatArray) -> FloatArray:
    """Return displacement and rotation of a smooth, rigid shaft that loads hold against flat walls, (n, 6).

    Loads are forces [N] and moments [N m] about its middle, shape (n, 6); those along the axis do not count.
    It goes as far as the walls let it, and only as far as the loads push it: the point of all allowed ones
    that is next to one far away in the direction of the loads, by the active set of Lawson and Hanson (1974).
    """
    from scipy.optimize import nnls

    corners, gaps = shape.corners()
    unit = shape.clearance / np.array([1.0, 1.0, 1.0, *3 * [0.5 * shape.length]])
    corners, gaps = corners * unit / shape.clearance, gaps / shape.clearance
    found, pushed = np.zeros(loads.shape), loads * unit * corners.any(axis=0)
    for place, load in zip(found, pushed, strict=True):
        if load.any():
            far = _FAR * load / np.linalg.norm(load)
            matrix, wanted = np.vstack([-corners.T, corners @ far - gaps]), np.eye(7)[6]
            rest = matrix @ nnls(matrix, wanted)[0] - wanted
            place[:] = unit * (far - rest[:6] / rest[6])
    return found
