"""Decompositions of matrices of a mechanism, which several searches ask for at the same place."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.multifrontal import MultifrontalQR

LARGE: Final = 60
"""Number of rows or unknowns from which on factors replace singular values where they are accurate."""
_REGULAR: Final = 1.0e8
"""Largest |A| |x| / |b| of a solution of A x = b that elimination finds accurately."""
DEPENDENT: Final = 1.0e-6
"""Singular value of rows over ways and turns, relative to the largest, below which some are dependent."""
_KEPT: Final = 4
"""Decompositions that are kept: those of two matrices at this place and at the last one."""


def svd(matrix: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the result of :func:`tribodyn.kernels.dense.svd`, as arrays that cannot be written to."""
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


def factors(matrix: FloatArray) -> MultifrontalQR | None:
    """Return the factors of a large matrix with rows of length one; None of a small one.

    None, too, where its rank is doubtful: singular values decide it then.
    """
    if max(matrix.shape, default=0) < LARGE or 0 in matrix.shape:
        return None
    return _factors(np.ascontiguousarray(matrix).tobytes(), matrix.shape)


@lru_cache(_KEPT)
def _factors(content: bytes, shape: tuple[int, int]) -> MultifrontalQR | None:
    found = MultifrontalQR(np.frombuffer(content).reshape(shape))
    return found if found.is_certain(DEPENDENT) else None


def null_space(matrix: FloatArray, rank: int) -> FloatArray:
    """Return orthonormal columns that a matrix (m, n) of known rank takes to zero, shape (n, n − rank)."""
    found = factors(with_unit_rows(matrix))
    if found is not None and found.rank == rank:
        return found.null
    return svd(matrix)[2][rank:].T


def least_squares(matrix: FloatArray, right: FloatArray, rank: int) -> FloatArray:
    """Return the shortest x (n,) with the least |matrix x − right|, for a matrix (m, n) of known rank."""
    size = float(np.max(np.abs(matrix), initial=0.0)) or 1.0
    found = factors(matrix / size)
    if found is not None and found.rank == rank:
        return found.solve(right / size)
    return RowSpace(matrix, rank).solve(right)


def with_unit_rows(matrix: FloatArray) -> FloatArray:
    """Return a matrix with its rows divided by their lengths, those of length zero as they are."""
    length = np.linalg.norm(matrix, axis=1, keepdims=True)
    return np.asarray(matrix / np.where(length == 0.0, 1.0, length))


def row_space(matrix: FloatArray, rank: int) -> RowSpace | SparseRowSpace:
    """Return the spaces that rows of length one (m, n), of known rank, hold and leave free."""
    found = factors(matrix)
    return RowSpace(matrix, rank) if found is None or found.rank != rank else SparseRowSpace(found)


class RowSpace:
    """The motions that rows hold, by singular values.

    Parameters
    ----------
    matrix
        The rows, shape (m, n).
    rank
        How many are independent.

    Attributes
    ----------
    free
        Orthonormal columns of the motions that they leave, shape (n, n − rank).
    """

    def __init__(self, matrix: FloatArray, rank: int) -> None:
        u, values, rows = svd(matrix)
        self._u, self._values, self._held = u[:, :rank], values[:rank], rows[:rank].T
        self.free = rows[rank:].T

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the shortest motion (n,) with the least |matrix x − right|."""
        return np.asarray(dense.product(self._held, dense.product(self._u.T, right) / self._values))

    def part_of(self, motion: FloatArray) -> FloatArray:
        """Return the part of a motion (n,) that the rows hold."""
        return np.asarray(dense.product(self._held, dense.product(self._held.T, motion)))

    def left_by(self, rows: FloatArray, rank: int) -> FloatArray:
        """Return orthonormal columns of the held motions that other rows, of known rank, leave free."""
        return np.asarray(dense.product(self._held, dense.svd(dense.product(rows, self._held))[2][rank:].T))


class SparseRowSpace:
    """The same of many bodies, by factors; ``free`` and :meth:`left_by` are zero of bodies at rest."""

    def __init__(self, factorised: MultifrontalQR) -> None:
        self._factors, self.free = factorised, factorised.null

    def solve(self, right: FloatArray) -> FloatArray:
        """See :meth:`RowSpace.solve`."""
        return self._factors.solve(right)

    def part_of(self, motion: FloatArray) -> FloatArray:
        """See :meth:`RowSpace.part_of`."""
        return np.asarray(motion - dense.product(self.free, dense.product(self.free.T, motion)))

    def left_by(self, rows: FloatArray, rank: int) -> FloatArray:
        """See :meth:`RowSpace.left_by`."""
        given = np.vstack([rows, self.free.T])
        found, rank_of_both = factors(given), rank + self.free.shape[1]
        if found is not None and found.rank == rank_of_both:
            return found.null
        return RowSpace(self._factors.matrix, self._factors.rank).left_by(rows, rank)
