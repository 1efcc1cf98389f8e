"""The iteration matrix I − hβJ, solved by its inverse or by LU, and a constant mass matrix by rows.

An equation without derivatives, a row of zeros, stands in the iteration with neither step nor β, so that
its row of the matrix keeps its size as the step shrinks.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
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


#: Number of equations up to which the inverse is used: a product has no chain of divisions.
LARGEST_INVERSE: Final = 24


@kernel
def factorise(
    pivots: NDArray[np.int64],
    matrices: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
    scaled: float,
) -> int:
    """Prepare solutions with M − ``scaled`` J, see :mod:`mebdf.kernels.matrix`.

    Return the sign of its determinant, or 0.
    """
    n = matrices.shape[1]
    transposed = n <= LARGEST_INVERSE
    for i in range(n):
        for j in range(n):
            entry = matrices[at.LAST_JACOBIAN, j, i] if transposed else matrices[at.LAST_JACOBIAN, i, j]
            matrices[at.FACTORS, i, j] = -scaled * entry
        if places.size == 0:
            matrices[at.FACTORS, i, i] += 1.0
    if places.size > 0:
        _add_mass(matrices, mass, places, transposed, scaled)
    if transposed:
        return _invert(pivots, matrices)
    return _decompose(pivots, matrices)


@kernel
def _add_mass(
    matrices: FloatArray, mass: FloatArray, places: NDArray[np.int64], transposed: bool, scaled: float
) -> None:
    """Add the mass matrix in FACTORS, and take the step out of algebraic equations."""
    n = matrices.shape[1]
    for i in range(n):
        for k in range(places[i], places[i + 1]):
            j = places[n + 1 + k]
            if transposed:
                matrices[at.FACTORS, j, i] += mass[k]
            else:
                matrices[at.FACTORS, i, j] += mass[k]
        if is_algebraic(places, i):
            for j in range(n):
                if transposed:
                    matrices[at.FACTORS, j, i] /= scaled
                else:
                    matrices[at.FACTORS, i, j] /= scaled


@kernel
def _invert(pivots: NDArray[np.int64], matrices: FloatArray) -> int:
    """Gauss-Jordan elimination in place, with row pivoting, in FACTORS.

    The matrix is the transposed one, so that products run along rows of its inverse.
    """
    n, sign = matrices.shape[1], 1
    for k in range(n):
        sign *= _bring_pivot(pivots, matrices, k)
        if sign == 0:
            return 0
        inverse = 1.0 / matrices[at.FACTORS, k, k]
        matrices[at.FACTORS, k, k] = 1.0
        for j in range(n):
            matrices[at.FACTORS, k, j] *= inverse
        for i in range(n):
            factor = matrices[at.FACTORS, i, k]
            if i != k and factor != 0.0:
                matrices[at.FACTORS, i, k] = 0.0
                for j in range(n):
                    matrices[at.FACTORS, i, j] -= factor * matrices[at.FACTORS, k, j]
    for k in range(n - 1, -1, -1):
        pivot = pivots[k]
        if pivot != k:
            for i in range(n):
                value = matrices[at.FACTORS, i, k]
                matrices[at.FACTORS, i, k] = matrices[at.FACTORS, i, pivot]
                matrices[at.FACTORS, i, pivot] = value
    return sign


@kernel
def _bring_pivot(pivots: NDArray[np.int64], matrices: FloatArray, k: int) -> int:
    """Exchange rows of FACTORS for the largest pivot; return the sign it gives the determinant, 0 if none."""
    n, pivot = matrices.shape[1], k
    for i in range(k + 1, n):
        if abs(matrices[at.FACTORS, i, k]) > abs(matrices[at.FACTORS, pivot, k]):
            pivot = i
    pivots[k] = pivot
    if not abs(matrices[at.FACTORS, pivot, k]) > 0.0:
        return 0
    sign = 1 if matrices[at.FACTORS, pivot, k] > 0.0 else -1
    if pivot == k:
        return sign
    for j in range(n):
        value = matrices[at.FACTORS, k, j]
        matrices[at.FACTORS, k, j] = matrices[at.FACTORS, pivot, j]
        matrices[at.FACTORS, pivot, j] = value
    return -sign


@kernel
def _decompose(pivots: NDArray[np.int64], matrices: FloatArray) -> int:
    """LU decomposition with row pivoting in FACTORS."""
    n, sign = matrices.shape[1], 1
    for k in range(n):
        sign *= _bring_pivot(pivots, matrices, k)
        if sign == 0:
            return 0
        inverse = 1.0 / matrices[at.FACTORS, k, k]
        for i in range(k + 1, n):
            factor = matrices[at.FACTORS, i, k] * inverse
            matrices[at.FACTORS, i, k] = factor
            if factor != 0.0:
                for j in range(k + 1, n):
                    matrices[at.FACTORS, i, j] -= factor * matrices[at.FACTORS, k, j]
    return sign


@kernel
def magnify(
    rows: FloatArray, matrices: FloatArray, mass: FloatArray, places: NDArray[np.int64], scaled: float
) -> None:
    """Fill the row MAGNITUDE.

    Algebraic equations hold constants beside their variables: where these are zero, the size at which their
    relative tolerance is as large as the absolute one stands for them.
    """
    n = rows.shape[1]
    for i in range(n):
        magnitude = magnitude_of_mass(rows, mass, places, i)
        for j in range(n):
            magnitude += abs(scaled) * abs(matrices[at.LAST_JACOBIAN, i, j] * rows[at.Y, j])
        if places.size > 0 and is_algebraic(places, i):
            for j in range(n):
                size = rows[at.ATOL, j] / rows[at.RTOL, j]
                magnitude += abs(scaled * matrices[at.LAST_JACOBIAN, i, j]) * size
        rows[at.MAGNITUDE, i] = magnitude


@kernel
def solve(pivots: NDArray[np.int64], rows: FloatArray, matrices: FloatArray) -> None:
    """Fill the row DELTA with the solution for the row RESIDUAL."""
    n = rows.shape[1]
    if n > LARGEST_INVERSE:
        for i in range(n):
            rows[at.DELTA, i] = rows[at.RESIDUAL, i]
        _substitute(pivots, rows, matrices)
        return
    for i in range(n):
        rows[at.DELTA, i] = 0.0
    for j in range(n):
        value = rows[at.RESIDUAL, j]
        for i in range(n):
            rows[at.DELTA, i] += matrices[at.FACTORS, j, i] * value


@kernel
def _substitute(pivots: NDArray[np.int64], rows: FloatArray, matrices: FloatArray) -> None:
    """Replace the row DELTA by the solution with it on the right, with the factors of :func:`_decompose`."""
    n = rows.shape[1]
    for k in range(n):
        pivot = pivots[k]
        if pivot != k:
            value = rows[at.DELTA, k]
            rows[at.DELTA, k] = rows[at.DELTA, pivot]
            rows[at.DELTA, pivot] = value
    for k in range(n):
        total = rows[at.DELTA, k]
        for j in range(k):
            total -= matrices[at.FACTORS, k, j] * rows[at.DELTA, j]
        rows[at.DELTA, k] = total
    for k in range(n - 1, -1, -1):
        total = rows[at.DELTA, k]
        for j in range(k + 1, n):
            total -= matrices[at.FACTORS, k, j] * rows[at.DELTA, j]
        rows[at.DELTA, k] = total / matrices[at.FACTORS, k, k]
