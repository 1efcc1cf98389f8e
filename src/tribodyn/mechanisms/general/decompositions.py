"""Decompositions of matrices of a mechanism, which several searches ask for at the same place."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense

LARGE: Final = 60
"""Number of unknowns from which on elimination takes the place of singular values where it is accurate."""
_REGULAR: Final = 1.0e8
"""Largest |A| |x| / |b| of a solution of A x = b that elimination finds accurately."""
_ACCURATE: Final = 1.0e-5
"""Least singular value over the largest of a matrix whose pseudo-inverse elimination finds accurately."""
_KEPT: Final = 4
"""Decompositions that are kept: those of two matrices at this place and at the last one."""


def svd(matrix: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return what :func:`tribodyn.kernels.dense.svd` does, as arrays that cannot be written to."""
    return _svd(np.ascontiguousarray(matrix).tobytes(), matrix.shape)


@lru_cache(_KEPT)
def _svd(content: bytes, shape: tuple[int, int]) -> tuple[FloatArray, FloatArray, FloatArray]:
    found = dense.svd(np.frombuffer(content).reshape(shape))
    for array in found:
        array.flags.writeable = False
    return found


def shortest(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the shortest x (n,) with the least |matrix x − right|, for a square matrix.

    A large matrix that is regular is solved by elimination, in a fiftieth of the time for 160 unknowns.
    """
    if len(matrix) >= LARGE:
        with np.errstate(all="ignore"):
            found = dense.solve(matrix, right)
            amplified = float(np.max(np.abs(matrix))) * dense.norm(found) / dense.norm(right)
        if amplified < _REGULAR:
            return found
    return dense.lstsq(matrix, right)


def has_full_rank(matrix: FloatArray, least: float) -> bool:
    """Return whether all singular values of a large matrix are known to exceed ``least`` times the largest.

    False, too, where only singular values themselves would show it.
    """
    return max(matrix.shape, default=0) >= LARGE and _of_gram(matrix)[1] > max(least, _ACCURATE)


def pseudo_inverse(matrix: FloatArray) -> FloatArray | None:
    """Return that of a large matrix (m, n) whose rank is full and not doubtful, (n, m); None of any other."""
    if not has_full_rank(matrix, _ACCURATE):
        return None
    inverse, _ = _of_gram(matrix)
    wide = matrix.shape[0] <= matrix.shape[1]
    return np.asarray(dense.product(matrix.T, inverse) if wide else dense.product(inverse, matrix.T))


def complement(matrix: FloatArray) -> FloatArray:
    """Return orthonormal rows (m − n, m) at right angles to the independent columns of a matrix (m, n).

    By reflections: Householder (1958), J. ACM 5, 339.
    """
    left, (m, n) = np.array(matrix, np.float64), matrix.shape
    normals = []
    for k in range(n):
        normal = left[k:, k].copy()
        normal[0] += math.copysign(dense.norm(normal), normal[0])
        normal /= dense.norm(normal)
        left[k:, k:] -= 2.0 * np.multiply.outer(normal, dense.product(normal, left[k:, k:]))
        normals.append(normal)
    rows = np.eye(m)[n:]
    for k in range(n - 1, -1, -1):
        rows[:, k:] -= 2.0 * np.multiply.outer(dense.product(rows[:, k:], normals[k]), normals[k])
    return rows


def _of_gram(matrix: FloatArray) -> tuple[FloatArray, float]:
    """Return the inverse of A Aᵀ, or of Aᵀ A where A is taller than wide, and what follows of A.

    That is a lower bound of its least singular value over the largest: by the norms of Frobenius, which are
    not below those of singular values.
    """
    return _of_gram_kept(np.ascontiguousarray(matrix).tobytes(), matrix.shape)


@lru_cache(_KEPT)
def _of_gram_kept(content: bytes, shape: tuple[int, int]) -> tuple[FloatArray, float]:
    matrix = np.frombuffer(content).reshape(shape)
    short = matrix if shape[0] <= shape[1] else np.ascontiguousarray(matrix.T)
    with np.errstate(all="ignore"):
        inverse = dense.inverse(dense.product(short, short.T))
        bound = 1.0 / (math.sqrt(dense.norm(inverse)) * dense.norm(matrix))
    inverse.flags.writeable = False
    return inverse, bound
