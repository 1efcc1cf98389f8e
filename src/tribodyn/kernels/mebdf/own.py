"""The Jacobian of a problem that solves with the iteration matrix itself: entries in the problem's order."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mebdf.kernels.arrays import copy
from mebdf.kernels.mass import is_algebraic, magnitude_of_mass
from mebdf.kernels.state import ATOL, DELTA, MAGNITUDE, RESIDUAL, RTOL, Y
from tribodyn.core.arrays import FloatArray, FloatMatrix, IntArray, IntMatrix
from tribodyn.kernels.jit import entry


class OwnMatrix(NamedTuple):
    """Work arrays of a problem's own algebra."""

    places: IntMatrix  #: Row and column of the first entries of the Jacobian, shape (2, n), n ≤ n_entries.
    jacobian: FloatArray  #: Entries as filled in, shape (n_entries,).
    #: Those in use: the last ones that were finite, or those before them, shape (n_entries,).
    last: FloatArray
    previous: FloatArray  #: The finite ones before the last, shape (n_entries,).
    #: What the problem's ``factorise`` leaves for its ``solve``.
    factors: FloatArray
    pivots: IntArray


@entry
def take_over(own: OwnMatrix, back: int) -> bool:
    """Keep a new Jacobian if it is finite, and the newest before it; return whether it is."""
    total = 0.0
    for i in range(own.jacobian.size):
        total += own.jacobian[i]
    if not math.isfinite(total):
        return False
    if back == 0:
        copy(own.last, own.previous)
    copy(own.jacobian, own.last)
    return True


@entry
def trace(own: OwnMatrix) -> float:
    """Return the trace of the Jacobian in use, as far as its entries have places."""
    total = 0.0
    for k in range(own.places.shape[1]):
        if own.places[0, k] == own.places[1, k]:
            total += own.last[k]
    return total


@entry
def magnify(
    own: OwnMatrix, rows: FloatMatrix, mass: FloatArray, places: NDArray[np.int64], scaled: float
) -> None:
    """Fill the row MAGNITUDE, as :func:`mebdf.kernels.matrix.magnify` does."""
    for i in range(rows.shape[1]):
        rows[MAGNITUDE, i] = magnitude_of_mass(rows, mass, places, i)
    for k in range(own.places.shape[1]):
        i, j = own.places[0, k], own.places[1, k]
        size = abs(rows[Y, j])
        if places.size > 0 and is_algebraic(places, i):
            size += rows[ATOL, j] / rows[RTOL, j]
        rows[MAGNITUDE, i] += abs(scaled * own.last[k]) * size


@entry
def set_right_side(rows: FloatMatrix, places: NDArray[np.int64], scaled: float) -> None:
    """Copy the row RESIDUAL to DELTA, for a matrix that has the step in algebraic equations, too."""
    for i in range(rows.shape[1]):
        factor = scaled if places.size > 0 and is_algebraic(places, i) else 1.0
        rows[DELTA, i] = factor * rows[RESIDUAL, i]
