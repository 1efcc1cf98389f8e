"""A constant mass matrix, kept by rows: products, and the scales of equations.

An equation without derivatives, a row of zeros, stands in the iteration with neither step nor β, so that
its row of the matrix keeps its size as the step shrinks.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import power
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.state import ERROR_WEIGHT, POWER, ROW_WEIGHT, TESTED, WEIGHT, Y

SMALLEST: Final = 1.0e-300  #: Weight of a variable of higher index before there is a step.


@inlined
def is_algebraic(places: NDArray[np.int64], i: int) -> bool:
    """Tell whether equation ``i`` has no derivatives."""
    return bool(places[i] == places[i + 1])


@inlined
def product(mass: FloatArray, places: NDArray[np.int64], rows: FloatArray, row: int, i: int) -> float:
    """Return component ``i`` of the mass matrix times a row."""
    total, columns = 0.0, rows.shape[1] + 1
    for k in range(places[i], places[i + 1]):
        total += mass[k] * rows[row, places[columns + k]]
    return total


@inlined
def magnitude_of_mass(rows: FloatArray, mass: FloatArray, places: NDArray[np.int64], i: int) -> float:
    """Return Σ_j |M_ij y_j|."""
    if places.size == 0:
        return abs(rows[Y, i])
    total, columns = 0.0, rows.shape[1] + 1
    for k in range(places[i], places[i + 1]):
        total += abs(mass[k] * rows[Y, places[columns + k]])
    return total


@kernel
def multiply(mass: FloatArray, places: NDArray[np.int64], rows: FloatArray, row: int, target: int) -> None:
    """Fill a row with the mass matrix times another one."""
    for i in range(rows.shape[1]):
        rows[target, i] = product(mass, places, rows, row, i)


@kernel
def weigh(mass: FloatArray, places: NDArray[np.int64], rows: FloatArray, h: float) -> None:
    """Weigh variables by their index, and equations by what a tolerance of their variables changes in them.

    The error of a variable of index 2 is multiplied by the step, that of one of index 3 by its square:
    Hairer, Lubich and Roche, The Numerical Solution of Differential-Algebraic Systems by Runge-Kutta
    Methods, Springer 1989, and Hairer and Wanner II, VII.
    """
    n = rows.shape[1]
    for i in range(n):
        rows[WEIGHT, i] *= power(min(abs(h), 1.0), rows[POWER, i])
        rows[ERROR_WEIGHT, i] = rows[TESTED, i] * rows[WEIGHT, i]
    for i in range(n):
        scale = 0.0
        for k in range(places[i], places[i + 1]):
            scale += abs(mass[k]) / max(rows[WEIGHT, places[n + 1 + k]], SMALLEST)
        rows[ROW_WEIGHT, i] = 1.0 / scale if scale > 0.0 else 0.0
