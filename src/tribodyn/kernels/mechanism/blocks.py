"""Sparse elimination by blocks of six by six, in an order that was chosen at assembly.

The blocks of a matrix stand in one array; the operations on them in lists, so that every mechanism is served
by the same few loops, whose cost is the number of blocks that fill the factors: linear in bodies for chains
and stars. There is pivoting inside the blocks on the diagonal and none between them;
``mechanisms/general/ordering.py`` says why none is needed.
"""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.kernels.arrays import is_zero
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.data import Pattern

N: Final = 6
INVERT: Final = 0
DIVIDE: Final = 1
SUBTRACT: Final = 2
"""Operations: replace a block by its inverse; multiply one from the right by another; subtract a product."""


@kernel
def invert(matrix: FloatArray, place: IntArray) -> int:
    """Replace a block by its inverse; return the sign of its determinant, 0 where it has none.

    Gauss-Jordan elimination with row pivoting; ``place`` (6,) is work space for row exchanges.
    """
    sign = 1
    for k in range(N):
        pivot = k
        for i in range(k + 1, N):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        place[k] = pivot
        if not abs(matrix[pivot, k]) > 0.0:
            return 0
        if matrix[pivot, k] < 0.0:
            sign = -sign
        if pivot != k:
            sign = -sign
            for j in range(N):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        inverse = 1.0 / matrix[k, k]
        matrix[k, k] = 1.0
        for j in range(N):
            matrix[k, j] *= inverse
        for i in range(N):
            factor = matrix[i, k]
            if i != k and factor != 0.0:
                matrix[i, k] = 0.0
                for j in range(N):
                    matrix[i, j] -= factor * matrix[k, j]
    for k in range(N - 1, -1, -1):
        if place[k] != k:
            for i in range(N):
                matrix[i, k], matrix[i, place[k]] = matrix[i, place[k]], matrix[i, k]
    return sign


@kernel
def factorise(pattern: Pattern, blocks: FloatArray) -> int:
    """Factorise in place; return the sign of the determinant, 0 where a block on the diagonal has no inverse.

    Diagonal blocks become inverses, those below the diagonal those of L.
    """
    steps, place, sign = pattern.factor, pattern.exchanges, 1
    for s in range(steps.shape[0]):
        target = blocks[steps[s, 1]]
        if steps[s, 0] == SUBTRACT:
            _subtract(target, blocks[steps[s, 2]], blocks[steps[s, 3]])
        elif steps[s, 0] == DIVIDE:
            _divide(target, blocks[steps[s, 2]])
        else:
            sign *= invert(target, place)
            if sign == 0:
                return 0
    return sign


@kernel
def _subtract(target: FloatArray, left: FloatArray, right: FloatArray) -> None:
    """Subtract the product of two blocks, row by row; those that a joint does not have are zero."""
    for i in range(N):
        if is_zero(left, i):
            continue
        a, b, c = target[i, 0], target[i, 1], target[i, 2]
        d, e, f = target[i, 3], target[i, 4], target[i, 5]
        for k in range(N):
            factor = left[i, k]
            a -= factor * right[k, 0]
            b -= factor * right[k, 1]
            c -= factor * right[k, 2]
            d -= factor * right[k, 3]
            e -= factor * right[k, 4]
            f -= factor * right[k, 5]
        target[i, 0], target[i, 1], target[i, 2] = a, b, c
        target[i, 3], target[i, 4], target[i, 5] = d, e, f


@kernel
def _divide(target: FloatArray, inverse: FloatArray) -> None:
    """Multiply a block by an inverse from the right, row by row."""
    for i in range(N):
        if is_zero(target, i):
            continue
        a, b, c = target[i, 0], target[i, 1], target[i, 2]
        d, e, f = target[i, 3], target[i, 4], target[i, 5]
        for j in range(N):
            target[i, j] = (
                a * inverse[0, j]
                + b * inverse[1, j]
                + c * inverse[2, j]
                + d * inverse[3, j]
                + e * inverse[4, j]
                + f * inverse[5, j]
            )


@kernel
def solve(pattern: Pattern, blocks: FloatArray, x: FloatArray) -> None:
    """Replace right-hand sides ``x`` (n_nodes, 6) by the solution."""
    _substitute(pattern.forward, blocks, x)
    _substitute(pattern.backward, blocks, x)


@kernel
def _substitute(steps: IntArray, blocks: FloatArray, x: FloatArray) -> None:
    """Subtract products of blocks with nodes; a node with itself is multiplied by its inverse."""
    for s in range(steps.shape[0]):
        block, target, source = blocks[steps[s, 0]], steps[s, 1], steps[s, 2]
        a, b, c = x[source, 0], x[source, 1], x[source, 2]
        d, e, f = x[source, 3], x[source, 4], x[source, 5]
        for i in range(N):
            product = (
                block[i, 0] * a
                + block[i, 1] * b
                + block[i, 2] * c
                + block[i, 3] * d
                + block[i, 4] * e
                + block[i, 5] * f
            )
            x[target, i] = product if target == source else x[target, i] - product
