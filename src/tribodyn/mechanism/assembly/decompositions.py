"""Decompositions of a mechanism's matrices, kept by place: dense, and QR of sparse rows for their rank."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray, IntArray
from tribodyn.core.platforms import give_back_memory
from tribodyn.kernels import dense

_BODY: Final = 6  #: Columns of a body.
_AT_ONCE: Final = 256  #: Columns of an inverse that are found at once: all of many hundreds take much memory.
_NOTHING: Final = 1.0e-13  #: Length of what is left of a row or column that counts as nothing.
#: The same of all that was left out, and what rows miss by in motions that they leave.
_EXACT: Final = 1.0e-9


@dataclass(frozen=True)
class _Front:
    """Factored rows that act on one body."""

    rows: IntArray  #: Their numbers, shape (m,); the first k of them hold rows of R.
    normals: FloatArray  #: Of the reflections, shape (k, m).
    #: Columns of these rows of R: those of the triangle, shape (k,), and all others, shape (n,).
    columns: IntArray
    others: IntArray
    #: Their entries, shapes (k, k) and (k, n).
    triangle: FloatArray
    beside: FloatArray

    @property
    def pivots(self) -> IntArray:
        """Numbers of the rows of R, shape (k,)."""
        return self.rows[: self.columns.size]


class MultifrontalQR:
    """Factorisation of rows of length one over the motions of bodies, (m, 6 n).

    ``rank`` is how many rows, and columns, are independent.
    """

    def __init__(self, matrix: FloatArray) -> None:
        self.matrix = matrix
        self._fronts, self._free, self._lost = list[_Front](), list[IntArray](), 0.0
        for front, left, lost in _eliminated(matrix):
            self._lost = math.hypot(self._lost, lost)
            self._free.append(left)
            if front.columns.size:
                self._fronts.append(front)
        pivots = np.concatenate([front.pivots for front in self._fronts] or [np.zeros(0, np.int64)])
        self._dependent = np.setdiff1d(np.arange(len(matrix)), pivots)
        self.rank = pivots.size

    @cached_property
    def bounds(self) -> tuple[float, float]:
        """Lower bound of the least singular value but those of dependent rows, upper bound of the largest.

        By the norms of Frobenius, and the largest sums over rows and columns, of which neither is smaller.
        """
        if self.rank == 0:
            return 0.0, 0.0
        unit = np.eye(len(self.matrix))[:, np.concatenate([front.pivots for front in self._fronts])]
        with np.errstate(all="ignore"):
            parts = np.array_split(unit, math.ceil(self.rank / _AT_ONCE), axis=1)
            sizes = [dense.norm(self._transposed(self._shortest(part))) for part in parts]
            least = 1.0 / math.sqrt(math.hypot(*sizes)) - self._lost
        entries = np.abs(self.matrix)
        return least, math.sqrt(float(np.max(entries.sum(axis=0)) * np.max(entries.sum(axis=1))))

    def is_certain(self, least: float) -> bool:
        """Return whether singular values would show the same rank.

        Those of independent rows then exceed ``least`` times the largest, those of others are none, and the
        motions that are left were found accurately.
        """
        if self.rank == 0:
            return True
        (lower, upper), missed = self.bounds, dense.norm(dense.product(self.matrix, self.null))
        return lower > least * upper and max(self._lost, missed) <= _EXACT

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the shortest x (6 n,) with the least |A x − right|, right of shape (m,)."""
        turned = right[:, None].copy()
        for front in self._fronts:
            turned[front.rows] = _reflected(front.normals, turned[front.rows])
        return self._shortest(turned)[:, 0]

    @cached_property
    def null(self) -> FloatArray:
        """Orthonormal columns that A takes to zero, shape (6 n, 6 n − rank).

        Their entries are zero, not only small, of bodies that do not move.
        """
        unit = np.eye(self.matrix.shape[1])[:, np.concatenate(self._free)]
        rows, end = self._back(np.zeros((len(self.matrix), unit.shape[1])), unit).T.copy(), 0
        for columns in filter(len, self._free):
            begin, end = end, end + len(columns)
            own = rows[begin:end]
            for _ in range(2):
                moved = np.flatnonzero(own.any(axis=0))
                before = rows[np.flatnonzero(rows[:begin, moved].any(axis=1))]  # others move other bodies
                own = own - dense.product(dense.product(before[:, moved], own[:, moved].T).T, before)
                lower = dense.cholesky(dense.product(own, own.T))
                # Turned round it is an upper triangle, which is solved without exchanges: zeros stay zero.
                own = dense.solve(lower[::-1, ::-1], own[::-1])[::-1]
            rows[begin:end] = own
        return np.ascontiguousarray(rows.T)

    @cached_property
    def dependent(self) -> FloatArray:
        """Orthonormal combinations of rows that vanish, shape (m − rank, m)."""
        found = np.eye(len(self.matrix))[:, self._dependent]
        for front in reversed(self._fronts):
            found[front.rows] = _reflected(front.normals[::-1], found[front.rows])
        return np.ascontiguousarray(found.T)

    def softest(self, rounds: int = 3) -> float:
        """Return an upper bound of the least singular value of independent rows, by inverse iteration."""
        x = self._shortest(np.ones((len(self.matrix), 1)))
        for _ in range(rounds):
            x = self._shortest(self._transposed(x / dense.norm(x)))
        return dense.norm(dense.product(self.matrix, x)) / dense.norm(x)

    def _shortest(self, right: FloatArray) -> FloatArray:
        """Return the shortest x (6 n, k) with R x = right (m, k)."""
        x = self._back(right, np.zeros((self.matrix.shape[1], right.shape[1])))
        return np.asarray(x - dense.product(self.null, dense.product(self.null.T, x)))

    def _back(self, right: FloatArray, x: FloatArray) -> FloatArray:
        """Fill x (6 n, k), of which columns left over are given, so that R x = right (m, k); return it."""
        for front in reversed(self._fronts):
            rest = right[front.pivots] - dense.product(front.beside, x[front.others])
            x[front.columns] = dense.solve(front.triangle, rest)
        return x

    def _transposed(self, right: FloatArray) -> FloatArray:
        """Return z (m, k) with Rᵀ z = right (6 n, k) in the columns that are not left over."""
        found, rest = np.zeros((len(self.matrix), right.shape[1])), right.copy()
        for front in self._fronts:
            found[front.pivots] = z = dense.solve(front.triangle.T, rest[front.columns])
            rest[front.others] -= dense.product(front.beside.T, z)
        return found


def _reflected(normals: FloatArray, columns: FloatArray) -> FloatArray:
    dense.reflect(np.ascontiguousarray(normals), columns)
    return columns


def _eliminated(matrix: FloatArray) -> Iterator[tuple[_Front, IntArray, float]]:
    """Give the fronts in their order, each with the columns left over and the size of what was dropped."""
    work, size = np.array(matrix, np.float64), matrix.shape[1]
    acts = np.logical_or.reduceat(work != 0.0, np.arange(0, size, _BODY), axis=1)
    bodies_of = [set(np.flatnonzero(row).tolist()) for row in acts]
    rows_of = [set(np.flatnonzero(column).tolist()) for column in acts.T]

    def around(body: int) -> set[int]:
        return set().union(*(bodies_of[row] for row in rows_of[body])) - {body}

    neighbours, left = [around(body) for body in range(len(rows_of))], set(range(len(rows_of)))
    while left:
        body = min(left, key=lambda b: (len(neighbours[b]), len(rows_of[b]), b))
        left.discard(body)
        rows = np.array(sorted(rows_of[body]), np.int64)
        own, others = _columns([body], size), _columns(sorted(neighbours[body]), size)
        n = own.size
        out, order, normals = dense.triangle(work[np.ix_(rows, np.append(own, others))], n, _NOTHING)
        k, own = len(normals), own[order]
        work[np.ix_(rows, others)] = out[:, n:]
        lengths = np.sqrt(np.add.reduce(out[k:, n:] ** 2, axis=1))
        lost = dense.norm(out[k:, k:n]), dense.norm(lengths[lengths <= _NOTHING])
        goes_on = set(rows[k:][lengths > _NOTHING].tolist())
        for other in neighbours[body]:
            rows_of[other] = (rows_of[other] - set(rows.tolist())) | goes_on
        for row in goes_on:
            bodies_of[row] = neighbours[body]
        for other in neighbours[body]:
            neighbours[other] = around(other)
        front = _Front(rows, normals, own[:k], np.append(own[k:], others), out[:k, :k], out[:k, k:])
        yield front, own[k:], math.hypot(*lost)


def _columns(bodies: list[int], size: int) -> IntArray:
    """Return the numbers of the columns of some bodies, of ``size`` columns in all."""
    found = (_BODY * np.array(bodies, np.int64)[:, None] + np.arange(_BODY)).ravel()
    return found[found < size]


#: Number of rows or unknowns from which on factors replace singular values where they are accurate.
LARGE: Final = 60
_REGULAR: Final = 1.0e8  #: Largest |A| |x| / |b| of a solution of A x = b that elimination finds accurately.
#: Singular value of rows over ways and turns, relative to the largest, below which some are dependent.
DEPENDENT: Final = 1.0e-6
_KEPT: Final = 4  #: Decompositions that are kept: those of two matrices at this place and at the last one.


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


def factors(matrix: FloatArray, rank: int | None = None) -> MultifrontalQR | None:
    """Return the factors of a large matrix with rows of length one; None of a small one.

    None, too, where its rank is doubtful: singular values decide it then. It is not where it is the ``rank``
    that is known, however small the least of them.
    """
    if max(matrix.shape, default=0) < LARGE or 0 in matrix.shape:
        return None
    return _factors(np.ascontiguousarray(matrix).tobytes(), matrix.shape, rank)


@lru_cache(_KEPT)
def _factors(content: bytes, shape: tuple[int, int], rank: int | None) -> MultifrontalQR | None:
    found = MultifrontalQR(np.frombuffer(content).reshape(shape))
    return found if found.is_certain(0.0 if found.rank == rank else DEPENDENT) else None


def forget_large() -> None:
    """Let go of the factors of large matrices, which no integration needs: they are larger than its data."""
    if _factors.cache_info().currsize:
        _factors.cache_clear()
        give_back_memory()


def null_space(matrix: FloatArray, rank: int) -> FloatArray:
    """Return orthonormal columns that a matrix (m, n) of known rank takes to zero, shape (n, n − rank)."""
    found = factors(with_unit_rows(matrix))
    if found is not None and found.rank == rank:
        return found.null
    return svd(matrix)[2][rank:].T


def least_squares(matrix: FloatArray, right: FloatArray, rank: int) -> FloatArray:
    """Return the shortest x (n,) with the least |matrix x − right|, for a matrix (m, n) of known rank."""
    size = float(np.max(np.abs(matrix), initial=0.0)) or 1.0
    found = factors(matrix / size, rank)
    if found is not None and found.rank == rank:
        return found.solve(right / size)
    return RowSpace(matrix, rank).solve(right)


def with_unit_rows(matrix: FloatArray) -> FloatArray:
    """Return a matrix with its rows divided by their lengths, those of length zero as they are."""
    length = np.linalg.norm(matrix, axis=1, keepdims=True)
    return np.asarray(matrix / np.where(length == 0.0, 1.0, length))


def row_space(matrix: FloatArray, rank: int) -> "RowSpace | SparseRowSpace":
    """Return the spaces that rows of length one (m, n), of known rank, hold and leave free."""
    found = factors(matrix)
    return RowSpace(matrix, rank) if found is None or found.rank != rank else SparseRowSpace(found)


class RowSpace:
    """The motions that rows (m, n) of a rank hold, by singular values.

    ``free`` are orthonormal columns of the motions that they leave, shape (n, n − rank).
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
