"""Sparse elimination by blocks of six by six, in an order that was chosen at assembly.

The blocks of a matrix stand in one array, each column by column: ``blocks[n, j, i]`` is the entry of row i
and column j, and a column is two fours of numbers, of which the last two are zero. So are right-hand sides
and solutions. The operations stand in lists, so that every mechanism is served by the same few loops, whose
cost is the number of blocks that fill the factors: linear in bodies for chains and stars. There is pivoting
inside the blocks on the diagonal, where these are not positive definite, and none between them;
``mechanism/assembly/ordering.py`` says why none is needed.
"""

from typing import Final

from mebdf.arrays import FloatArray, IntArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.lanes import WIDTH, load, spread, store, zeros
from tribodyn.kernels.mechanism.data import COLUMN, N, Pattern

BLOCK: Final = N * COLUMN
INVERT: Final = 0
DIVIDE: Final = 1
SUBTRACT: Final = 2
INVERT_DEFINITE: Final = 3
PLACE: Final = 4
"""Operations: replace a block by its inverse; multiply one from the right by another; subtract a product;
replace a symmetric, positive definite block by its inverse; write a number along a diagonal from an entry on.
"""


@kernel
def invert(blocks: FloatArray, number: int, size: int, place: IntArray) -> int:
    """Replace a block by its inverse; return the sign of its determinant, 0 where it has none.

    Gauss-Jordan elimination with pivoting; beyond its first ``size`` rows and columns the block is a unit
    matrix, and ``place`` (6,) is work space for exchanges.
    """
    sign, block = 1, blocks[number]
    for k in range(size):
        pivot = k
        for i in range(k + 1, size):
            if abs(block[i, k]) > abs(block[pivot, k]):
                pivot = i
        place[k] = pivot
        entry = block[pivot, k]
        if not abs(entry) > 0.0:
            return 0
        if entry < 0.0:
            sign = -sign
        if pivot != k:
            sign = -sign
            for i in range(N):
                block[k, i], block[pivot, i] = block[pivot, i], block[k, i]
        _eliminate(blocks, number, k, size)
    for k in range(size - 1, -1, -1):
        if place[k] != k:
            for i in range(size):
                block[i, k], block[i, place[k]] = block[i, place[k]], block[i, k]
    return sign


@kernel
def _eliminate(blocks: FloatArray, number: int, k: int, size: int) -> None:
    """Eliminate an unknown of a block by its entry on the diagonal, where its part of the inverse goes."""
    first = BLOCK * number
    at, inverse = first + COLUMN * k, 1.0 / blocks[number, k, k]
    scale = spread(inverse)
    low, high = scale * load(blocks, at), scale * load(blocks, at + WIDTH)
    store(blocks, at, low)
    store(blocks, at + WIDTH, high)
    blocks[number, k, k] = inverse
    for i in range(size):
        factor = blocks[number, i, k]
        if i != k and factor != 0.0:
            to, share = first + COLUMN * i, spread(factor)
            store(blocks, to, load(blocks, to) - share * low)
            store(blocks, to + WIDTH, load(blocks, to + WIDTH) - share * high)
            blocks[number, i, k] = -factor * inverse


@kernel
def factorise(pattern: Pattern, blocks: FloatArray) -> int:
    """Factorise in place; return the sign of the determinant, 0 where a block on the diagonal has no inverse.

    Diagonal blocks become inverses, those below the diagonal those of L.
    """
    steps, sign = pattern.factor, 1
    for s in range(steps.shape[0]):
        kind, target, size, inner = steps[s, 0], steps[s, 1], steps[s, 4], steps[s, 5]
        if kind == SUBTRACT:
            _subtract(blocks, target, steps[s, 2], steps[s, 3], size, inner)
        elif kind == DIVIDE:
            _divide(blocks, target, steps[s, 2], inner)
        elif kind == INVERT_DEFINITE:
            for k in range(size):
                _eliminate(blocks, target, k, size)
        elif kind == PLACE:
            for k in range(size):
                blocks[target, steps[s, 3] + k, steps[s, 2] + k] = inner
        else:
            sign *= invert(blocks, target, size, pattern.exchanges)
            if sign == 0:
                return 0
    return sign


@kernel
def _subtract(blocks: FloatArray, target: int, left: int, right: int, columns: int, inner: int) -> None:
    """Subtract the product of two blocks, of which ``right`` is zero beyond (inner, columns)."""
    for j in range(columns):
        to, column = BLOCK * target + COLUMN * j, BLOCK * left
        low, high = load(blocks, to), load(blocks, to + WIDTH)
        for k in range(inner):
            factor = spread(blocks[right, j, k])
            low -= factor * load(blocks, column)
            high -= factor * load(blocks, column + WIDTH)
            column += COLUMN
        store(blocks, to, low)
        store(blocks, to + WIDTH, high)


@kernel
def _divide(blocks: FloatArray, target: int, inverse: int, columns: int) -> None:
    """Multiply a block that is zero beyond so many columns by an inverse from the right."""
    at = BLOCK * target
    a, b, c = load(blocks, at), load(blocks, at + COLUMN), load(blocks, at + 2 * COLUMN)
    d, e, f = (load(blocks, at + 3 * COLUMN), load(blocks, at + 4 * COLUMN), load(blocks, at + 5 * COLUMN))
    second = at + WIDTH
    p, q, r = load(blocks, second), load(blocks, second + COLUMN), load(blocks, second + 2 * COLUMN)
    s, t, u = (
        load(blocks, second + 3 * COLUMN),
        load(blocks, second + 4 * COLUMN),
        load(blocks, second + 5 * COLUMN),
    )
    for j in range(columns):
        to, column = at + COLUMN * j, blocks[inverse, j]
        x, y, z = spread(column[0]), spread(column[1]), spread(column[2])
        low, high = x * a + y * b + z * c, x * p + y * q + z * r
        x, y, z = spread(column[3]), spread(column[4]), spread(column[5])
        store(blocks, to, low + x * d + y * e + z * f)
        store(blocks, to + WIDTH, high + x * s + y * t + z * u)


@kernel
def solve(pattern: Pattern, blocks: FloatArray, x: FloatArray) -> None:
    """Replace right-hand sides ``x`` (n_nodes, 8) by the solution."""
    _substitute(pattern.forward, blocks, x)
    _substitute(pattern.backward, blocks, x)


@kernel
def _substitute(steps: IntArray, blocks: FloatArray, x: FloatArray) -> None:
    """Subtract products of blocks with nodes; a node with itself is multiplied by its inverse.

    Where more than six unknowns are named, what the node held before does not count.
    """
    nothing = zeros()
    for s in range(steps.shape[0]):
        block, to, node = BLOCK * steps[s, 0], steps[s, 1], x[steps[s, 2]]
        a, b, c = spread(node[0]), spread(node[1]), spread(node[2])
        low = a * load(blocks, block) + b * load(blocks, block + COLUMN)
        low += c * load(blocks, block + 2 * COLUMN)
        second = block + WIDTH
        high = a * load(blocks, second) + b * load(blocks, second + COLUMN)
        high += c * load(blocks, second + 2 * COLUMN)
        if steps[s, 3] > 3:
            a, b, c = spread(node[3]), spread(node[4]), spread(node[5])
            block, second = block + 3 * COLUMN, second + 3 * COLUMN
            low += a * load(blocks, block)
            low += b * load(blocks, block + COLUMN)
            low += c * load(blocks, block + 2 * COLUMN)
            high += a * load(blocks, second)
            high += b * load(blocks, second + COLUMN)
            high += c * load(blocks, second + 2 * COLUMN)
        first = COLUMN * to
        if steps[s, 3] > N:
            low, high = nothing - low, nothing - high
        elif to != steps[s, 2]:
            low, high = load(x, first) - low, load(x, first + WIDTH) - high
        store(x, first, low)
        store(x, first + WIDTH, high)
