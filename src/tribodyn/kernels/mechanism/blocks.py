"""Sparse elimination by blocks of six by six, in an order that was chosen at assembly.

The blocks of a matrix stand in one array, each column by column: ``blocks[n, j, i]`` is the entry of row i
and column j, and a column is two overlapping fours of numbers. The operations on them stand in lists, so that
every mechanism is served by the same few loops, whose cost is the number of blocks that fill the factors:
linear in bodies for chains and stars. There is pivoting inside the blocks on the diagonal and none between
them; ``mechanisms/general/ordering.py`` says why none is needed.
"""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.lanes import WIDTH, load, spread, store
from tribodyn.kernels.mechanism.data import Pattern

N: Final = 6
BLOCK: Final = N * N
SECOND: Final = N - WIDTH
"""Where the second four of a column begins."""
INVERT: Final = 0
DIVIDE: Final = 1
SUBTRACT: Final = 2
"""Operations: replace a block by its inverse; multiply one from the right by another; subtract a product."""


@kernel
def invert(flat: FloatArray, first: int, size: int, place: IntArray) -> int:
    """Replace a block by its inverse; return the sign of its determinant, 0 where it has none.

    Gauss-Jordan elimination with pivoting; beyond its first ``size`` rows and columns the block is a unit
    matrix, ``first`` is where it begins, and ``place`` (6,) is work space for exchanges.
    """
    sign = 1
    for k in range(size):
        pivot = k
        for i in range(k + 1, size):
            if abs(flat[first + N * i + k]) > abs(flat[first + N * pivot + k]):
                pivot = i
        place[k] = pivot
        entry = flat[first + N * pivot + k]
        if not abs(entry) > 0.0:
            return 0
        if entry < 0.0:
            sign = -sign
        if pivot != k:
            sign = -sign
            _exchange(flat, first + N * k, first + N * pivot)
        inverse = 1.0 / entry
        at = first + N * k
        scale = spread(inverse)
        low, high = scale * load(flat, at), scale * load(flat, at + SECOND)
        store(flat, at, low)
        store(flat, at + SECOND, high)
        flat[at + k] = inverse
        for i in range(size):
            to = first + N * i
            factor = flat[to + k]
            if i != k and factor != 0.0:
                share = spread(factor)
                upper = load(flat, to + SECOND) - share * high
                store(flat, to, load(flat, to) - share * low)
                store(flat, to + SECOND, upper)
                flat[to + k] = -factor * inverse
    for k in range(size - 1, -1, -1):
        if place[k] != k:
            for i in range(size):
                a, b = first + N * i + k, first + N * i + place[k]
                flat[a], flat[b] = flat[b], flat[a]
    return sign


@kernel
def _exchange(flat: FloatArray, a: int, b: int) -> None:
    """Exchange six numbers from ``a`` on with six from ``b`` on."""
    for i in range(N):
        flat[a + i], flat[b + i] = flat[b + i], flat[a + i]


@kernel
def factorise(pattern: Pattern, blocks: FloatArray) -> int:
    """Factorise in place; return the sign of the determinant, 0 where a block on the diagonal has no inverse.

    Diagonal blocks become inverses, those below the diagonal those of L.
    """
    flat, steps, place, sign = blocks.reshape((-1,)), pattern.factor, pattern.exchanges, 1
    for s in range(steps.shape[0]):
        target, size, inner = BLOCK * steps[s, 1], steps[s, 4], steps[s, 5]
        if steps[s, 0] == SUBTRACT:
            _subtract(flat, target, BLOCK * steps[s, 2], BLOCK * steps[s, 3], size, inner)
        elif steps[s, 0] == DIVIDE:
            _divide(flat, target, BLOCK * steps[s, 2], inner)
        else:
            sign *= invert(flat, target, size, place)
            if sign == 0:
                return 0
    return sign


@kernel
def _subtract(flat: FloatArray, target: int, left: int, right: int, columns: int, inner: int) -> None:
    """Subtract the product of two blocks, of which ``right`` is zero beyond (inner, columns)."""
    for j in range(columns):
        to = target + N * j
        low, high = load(flat, to), load(flat, to + SECOND)
        for k in range(inner):
            factor, column = spread(flat[right + N * j + k]), left + N * k
            low -= factor * load(flat, column)
            high -= factor * load(flat, column + SECOND)
        store(flat, to, low)
        store(flat, to + SECOND, high)


@kernel
def _divide(flat: FloatArray, target: int, inverse: int, columns: int) -> None:
    """Multiply a block that is zero beyond so many columns by an inverse from the right."""
    a, b, c = load(flat, target), load(flat, target + N), load(flat, target + 2 * N)
    d, e, f = load(flat, target + 3 * N), load(flat, target + 4 * N), load(flat, target + 5 * N)
    second = target + SECOND
    p, q, r = load(flat, second), load(flat, second + N), load(flat, second + 2 * N)
    s, t, u = load(flat, second + 3 * N), load(flat, second + 4 * N), load(flat, second + 5 * N)
    for j in range(columns):
        at, to = inverse + N * j, target + N * j
        x, y, z = spread(flat[at]), spread(flat[at + 1]), spread(flat[at + 2])
        low, high = x * a + y * b + z * c, x * p + y * q + z * r
        x, y, z = spread(flat[at + 3]), spread(flat[at + 4]), spread(flat[at + 5])
        store(flat, to, low + x * d + y * e + z * f)
        store(flat, to + SECOND, high + x * s + y * t + z * u)


@kernel
def solve(pattern: Pattern, blocks: FloatArray, x: FloatArray) -> None:
    """Replace right-hand sides ``x`` (n_nodes, 6) by the solution."""
    flat, numbers = blocks.reshape((-1,)), x.reshape((-1,))
    _substitute(pattern.forward, flat, numbers)
    _substitute(pattern.backward, flat, numbers)


@kernel
def _substitute(steps: IntArray, flat: FloatArray, x: FloatArray) -> None:
    """Subtract products of blocks with nodes; a node with itself is multiplied by its inverse."""
    for s in range(steps.shape[0]):
        block, to, at = BLOCK * steps[s, 0], N * steps[s, 1], N * steps[s, 2]
        a, b, c = spread(x[at]), spread(x[at + 1]), spread(x[at + 2])
        low = a * load(flat, block) + b * load(flat, block + N) + c * load(flat, block + 2 * N)
        second = block + SECOND
        high = a * load(flat, second) + b * load(flat, second + N) + c * load(flat, second + 2 * N)
        a, b, c = spread(x[at + 3]), spread(x[at + 4]), spread(x[at + 5])
        block, second = block + 3 * N, second + 3 * N
        low += a * load(flat, block)
        low += b * load(flat, block + N)
        low += c * load(flat, block + 2 * N)
        high += a * load(flat, second)
        high += b * load(flat, second + N)
        high += c * load(flat, second + 2 * N)
        if to != at:
            low, high = load(x, to) - low, load(x, to + SECOND) - high
        store(x, to, low)
        store(x, to + SECOND, high)
