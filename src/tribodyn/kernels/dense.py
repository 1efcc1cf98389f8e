"""Dense linear algebra before a run: what NumPy leaves to libraries that round differently on each processor.

Small matrices only. Arguments and results are those of the functions of these names in NumPy.
"""

import math
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray, FloatMatrix, IntArray
from tribodyn.kernels.jit import entry, kernel

_ROUNDING: Final = 2.0**-52
_MOST_SWEEPS: Final = 60


def product(first: Any, second: Any) -> Any:
    """Return the matrix product; the second array has one or two dimensions. Sums run in order."""
    a, b = np.asarray(first, np.float64), np.asarray(second, np.float64)
    columns = b[:, None] if b.ndim == 1 else b
    rows = a.reshape(math.prod(a.shape[:-1]), a.shape[-1])
    out = np.empty((rows.shape[0], columns.shape[1]))
    _multiply(np.require(rows, requirements=["C", "W"]), np.require(columns, requirements=["C", "W"]), out)
    return out.reshape(a.shape[:-1] + b.shape[1:])[()]


def norm(values: Any) -> float:
    """Return the root of the sum of all squares."""
    flat = np.ravel(np.asarray(values, np.float64))
    return math.sqrt(product(flat, flat))


def solve(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return x of matrix x = right, (n, n) and (n,) or (n, m); not finite where the matrix is singular."""
    columns = right.reshape(len(right), -1).copy()
    solve_in_place(np.array(matrix, np.float64, order="C"), columns, 0, columns.shape[1])
    return columns.reshape(right.shape)


def inverse(matrix: FloatArray) -> FloatArray:
    """Return the inverse of a matrix (n, n)."""
    return solve(matrix, np.eye(len(matrix)))


def svd(matrix: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return U (m, k), singular values (k,), falling, and Vᵀ (n, n) of a matrix (m, n), k = min(m, n).

    By rotations of pairs of columns: Hestenes (1958), J. SIAM 6, 51. Columns of U that belong to the value
    zero are zero; rows of Vᵀ from the k-th on span what the matrix takes to zero.
    """
    m, n = matrix.shape
    columns, right = np.array(matrix.T, np.float64, order="C"), np.eye(n)
    _orthogonalise(columns, right, np.empty(n))
    sizes = np.sqrt(np.add.reduce(columns * columns, axis=1))
    order = np.argsort(-sizes, kind="stable")
    sizes, columns, k = sizes[order], columns[order], min(m, n)
    left = columns[:k] / np.where(sizes[:k] > 0.0, sizes[:k], 1.0)[:, None]
    return np.ascontiguousarray(left.T), sizes[:k], right[order]


def eigh(matrix: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return eigenvalues (n,), rising, and eigenvectors as columns (n, n) of a symmetric matrix.

    Those of a matrix without negative ones are its singular values. Where Gershgorin's circles leave room for
    negative ones, a multiple of unity is added.
    """
    diagonal, sizes = np.diag(matrix), np.add.reduce(np.abs(matrix), axis=1)
    shift = float(np.max(sizes - np.abs(diagonal) - diagonal, initial=0.0))
    _, values, vectors = svd(matrix + shift * np.eye(len(matrix)))
    return values[::-1] - shift, np.ascontiguousarray(vectors[::-1].T)


def lstsq(matrix: FloatArray, right: FloatArray, rcond: float | None = None) -> FloatArray:
    """Return the shortest x (n,) with the least |matrix x − right|.

    Singular values below ``rcond`` times the largest count as zero.
    """
    left, values, vectors = svd(matrix)
    least = (_ROUNDING * max(matrix.shape) if rcond is None else rcond) * values.max(initial=0.0)
    kept = values > least
    shares = product(left.T, right)[kept] / values[kept]
    return np.asarray(product(shares, vectors[: values.size][kept]))


def triangle(matrix: FloatArray, n_pivots: int, least: float) -> tuple[FloatArray, IntArray, FloatArray]:
    """Return a matrix (m, n) whose first columns are made a triangle, their order, and the reflections.

    By Householder's reflections with pivoting among the first ``n_pivots`` columns (Businger and Golub
    (1965), Numer. Math. 7, 269), until what is left of each is not longer than ``least``. The order has
    shape (n_pivots,), the normals of the reflections (rank, m).
    """
    out, order = np.array(matrix, np.float64, order="C"), np.arange(n_pivots)
    normals = np.zeros((min(n_pivots, len(out)), len(out)))
    rank = _reduce(out, order, least, normals, np.empty(out.shape[1]))
    return out, order, normals[:rank]


def cholesky(matrix: FloatArray) -> FloatArray:
    """Return the lower triangle L (n, n) of a symmetric positive definite matrix L Lᵀ."""
    out = np.array(np.tril(matrix), order="C")
    _factorise(out)
    return out


def reflect(normals: FloatArray, columns: FloatArray) -> None:
    """Apply reflections (k, m) to columns (m, n) in place, the first of them first."""
    whole = np.require(columns, requirements="C")
    _reflect(np.require(normals, requirements=["C", "W"]), whole, np.empty(columns.shape[1]))
    columns[...] = whole


@entry
def _multiply(a: FloatMatrix, b: FloatMatrix, out: FloatMatrix) -> None:
    for i in range(a.shape[0]):
        for j in range(b.shape[1]):
            out[i, j] = 0.0
        for k in range(a.shape[1]):
            factor = a[i, k]
            if factor != 0.0:
                for j in range(b.shape[1]):
                    out[i, j] += factor * b[k, j]


@entry
def _factorise(a: FloatMatrix) -> None:
    """Cholesky's factorisation in place of the lower triangle; zeros that stay zero cost nothing."""
    for k in range(a.shape[0]):
        a[k, k] = math.sqrt(a[k, k])
        for i in range(k + 1, a.shape[0]):
            a[i, k] /= a[k, k]
        for i in range(k + 1, a.shape[0]):
            if a[i, k] != 0.0:
                for j in range(k + 1, i + 1):
                    a[i, j] -= a[i, k] * a[j, k]


@kernel
def _reflect_once(normal: FloatArray, columns: FloatArray, first: int, across: FloatArray) -> None:
    """Reflect columns, from the row ``first`` on, before which the normal is zero."""
    for j in range(columns.shape[1]):
        across[j] = 0.0
    for i in range(first, columns.shape[0]):
        for j in range(columns.shape[1]):
            across[j] += normal[i] * columns[i, j]
    for i in range(first, columns.shape[0]):
        for j in range(columns.shape[1]):
            columns[i, j] -= 2.0 * normal[i] * across[j]


@entry
def _reflect(normals: FloatMatrix, columns: FloatMatrix, across: FloatArray) -> None:
    for k in range(normals.shape[0]):
        _reflect_once(normals[k], columns, 0, across)


@entry
def _reduce(a: FloatMatrix, order: IntArray, least: float, normals: FloatMatrix, across: FloatArray) -> int:
    """Make a triangle of the first columns in place; return their rank."""
    for k in range(normals.shape[0]):
        best, largest = k, -1.0
        for j in range(k, order.size):
            square = 0.0
            for i in range(k, a.shape[0]):
                square += a[i, j] * a[i, j]
            if square > largest:
                best, largest = j, square
        length = math.sqrt(largest)
        if length <= least:
            return k
        order[k], order[best] = order[best], order[k]
        for i in range(a.shape[0]):
            a[i, k], a[i, best] = a[i, best], a[i, k]
        scale = 1.0 / math.sqrt(2.0 * length * (length + abs(a[k, k])))
        for i in range(k, a.shape[0]):
            normals[k, i] = a[i, k] * scale
        normals[k, k] += math.copysign(length, a[k, k]) * scale
        _reflect_once(normals[k], a, k, across)
        for i in range(k + 1, a.shape[0]):
            a[i, k] = 0.0
    return normals.shape[0]


@kernel
def _inner(a: FloatArray, b: FloatArray) -> float:
    """Return the inner product; four sums side by side do not wait for each other."""
    n = a.size - a.size % 4
    s0 = s1 = s2 = s3 = 0.0
    for i in range(0, n, 4):
        s0 += a[i] * b[i]
        s1 += a[i + 1] * b[i + 1]
        s2 += a[i + 2] * b[i + 2]
        s3 += a[i + 3] * b[i + 3]
    for i in range(n, a.size):
        s0 += a[i] * b[i]
    return (s0 + s1) + (s2 + s3)


@kernel
def _rotate(rows: FloatArray, p: int, q: int, c: float, s: float) -> None:
    for i in range(rows.shape[1]):
        first, second = rows[p, i], rows[q, i]
        rows[p, i], rows[q, i] = c * first - s * second, s * first + c * second


@entry
def _orthogonalise(columns: FloatMatrix, right: FloatMatrix, squares: FloatArray) -> None:
    """Turn columns, kept as rows (n, m), in pairs until all are orthogonal; ``right`` (n, n) with them.

    ``squares`` (n,) is room for the squares of their lengths.
    """
    n = columns.shape[0]
    for _ in range(_MOST_SWEEPS):
        turned, whole = False, 0.0
        for p in range(n):
            squares[p] = _inner(columns[p], columns[p])
            whole += squares[p]
        for p in range(n - 1):
            for q in range(p + 1, n):
                first, second = squares[p], squares[q]
                across = _inner(columns[p], columns[q])
                if abs(across) <= _ROUNDING * max(math.sqrt(first) * math.sqrt(second), _ROUNDING * whole):
                    continue
                turned = True
                ratio = (second - first) / (2.0 * across)
                tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.sqrt(1.0 + ratio * ratio))
                c = 1.0 / math.sqrt(1.0 + tangent * tangent)
                _rotate(columns, p, q, c, c * tangent)
                squares[p] = _inner(columns[p], columns[p])
                squares[q] = _inner(columns[q], columns[q])
                _rotate(right, p, q, c, c * tangent)
        if not turned:
            return


@entry
def solve_in_place(matrix: FloatMatrix, rhs: FloatMatrix, first: int, last: int) -> None:
    """Solve ``matrix x = rhs`` by Gaussian elimination with partial pivoting; the matrix is destroyed.

    Right-hand sides (n, m) from column ``first`` up to, not including, ``last`` become the solution.
    """
    n = matrix.shape[0]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if pivot != k:
            for j in range(k, n):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
            for j in range(first, last):
                rhs[k, j], rhs[pivot, j] = rhs[pivot, j], rhs[k, j]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] * inverse
            if factor != 0.0:
                for j in range(k + 1, n):
                    matrix[i, j] -= factor * matrix[k, j]
                for j in range(first, last):
                    rhs[i, j] -= factor * rhs[k, j]
    for k in range(n - 1, -1, -1):
        inverse = 1.0 / matrix[k, k]
        for j in range(first, last):
            total = rhs[k, j]
            for i in range(k + 1, n):
                total -= matrix[k, i] * rhs[i, j]
            rhs[k, j] = total * inverse
