"""The iteration matrix I − hβJ: explicit inverse where few equations make that faster, LU otherwise."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mebdf.state import FACTORS, LAST_JACOBIAN, PIVOTS, RESIDUAL, WORK

LARGEST_INVERSE: Final = 24
"""Number of equations up to which the inverse is used: a product has no chain of divisions."""


@kernel
def factorise(count: NDArray[np.int64], matrices: FloatArray, scaled: float) -> bool:
    """Prepare solutions with I − ``scaled`` J; return whether the matrix is regular."""
    n = matrices.shape[1]
    place = WORK if n <= LARGEST_INVERSE else FACTORS
    for i in range(n):
        for j in range(n):
            matrices[place, i, j] = -scaled * matrices[LAST_JACOBIAN, i, j]
        matrices[place, i, i] += 1.0
    if n <= LARGEST_INVERSE:
        return _invert(matrices)
    return _decompose(count, matrices)


@kernel
def _invert(matrices: FloatArray) -> bool:
    """Gauss-Jordan elimination with row pivoting from WORK to FACTORS."""
    n = matrices.shape[1]
    for i in range(n):
        for j in range(n):
            matrices[FACTORS, i, j] = 1.0 if i == j else 0.0
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrices[WORK, i, k]) > abs(matrices[WORK, pivot, k]):
                pivot = i
        if not abs(matrices[WORK, pivot, k]) > 0.0:
            return False
        inverse = 1.0 / matrices[WORK, pivot, k]
        for place in (WORK, FACTORS):
            for j in range(n):
                value = matrices[place, pivot, j]
                matrices[place, pivot, j] = matrices[place, k, j]
                matrices[place, k, j] = value * inverse
        for i in range(n):
            factor = matrices[WORK, i, k]
            if i != k and factor != 0.0:
                for j in range(k + 1, n):
                    matrices[WORK, i, j] -= factor * matrices[WORK, k, j]
                for j in range(n):
                    matrices[FACTORS, i, j] -= factor * matrices[FACTORS, k, j]
    return True


@kernel
def _decompose(count: NDArray[np.int64], matrices: FloatArray) -> bool:
    """LU decomposition with row pivoting in FACTORS."""
    n = matrices.shape[1]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrices[FACTORS, i, k]) > abs(matrices[FACTORS, pivot, k]):
                pivot = i
        count[PIVOTS + k] = pivot
        if not abs(matrices[FACTORS, pivot, k]) > 0.0:
            return False
        if pivot != k:
            for j in range(n):
                value = matrices[FACTORS, k, j]
                matrices[FACTORS, k, j] = matrices[FACTORS, pivot, j]
                matrices[FACTORS, pivot, j] = value
        inverse = 1.0 / matrices[FACTORS, k, k]
        for i in range(k + 1, n):
            factor = matrices[FACTORS, i, k] * inverse
            matrices[FACTORS, i, k] = factor
            if factor != 0.0:
                for j in range(k + 1, n):
                    matrices[FACTORS, i, j] -= factor * matrices[FACTORS, k, j]
    return True


@kernel
def substitute(count: NDArray[np.int64], rows: FloatArray, matrices: FloatArray) -> None:
    """Replace the row RESIDUAL by the solution with it on the right."""
    n = rows.shape[1]
    for k in range(n):
        pivot = count[PIVOTS + k]
        if pivot != k:
            value = rows[RESIDUAL, k]
            rows[RESIDUAL, k] = rows[RESIDUAL, pivot]
            rows[RESIDUAL, pivot] = value
    for k in range(n):
        total = rows[RESIDUAL, k]
        for j in range(k):
            total -= matrices[FACTORS, k, j] * rows[RESIDUAL, j]
        rows[RESIDUAL, k] = total
    for k in range(n - 1, -1, -1):
        total = rows[RESIDUAL, k]
        for j in range(k + 1, n):
            total -= matrices[FACTORS, k, j] * rows[RESIDUAL, j]
        rows[RESIDUAL, k] = total / matrices[FACTORS, k, k]
