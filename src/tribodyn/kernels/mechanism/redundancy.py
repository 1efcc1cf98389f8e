"""Constraint rows that follow from the others, where there are more than can be independent."""

import math
from typing import Final

from mebdf.arrays import FloatArray, FloatMatrix
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.lanes import WIDTH, load, spread, store
from tribodyn.kernels.mechanism.data import NONE, Now, Parts
from tribodyn.kernels.mechanism.solution import set_compliance

PREFERRED: Final = 10.0  #: Advantage that a row needs to take the place of one that was independent before.
SMALL: Final = 48  #: Number of rows up to which dependent ones are looked for after every step.


@entry
def row_scale(parts: Parts, now: Now) -> None:
    """Fill the scale of every row where the bodies are: the diagonal of G M⁻¹ Gᵀ."""
    for k in range(parts.couplings.size):
        for m in range(parts.couplings[k].n_rows):
            now.couplings[k].scale[m] = _product(parts, now, k, m, k, m)


@kernel
def _product(parts: Parts, now: Now, k: int, m: int, other: int, n: int) -> float:
    """Return the entry of G M⁻¹ Gᵀ that belongs to two rows; rows of elements are sums over their legs."""
    total, one = 0.0, k
    while one != NONE:
        another = other
        while another != NONE:
            total += _of_couplings(parts, now, one, m, another, n)
            another = parts.couplings[another].next_leg
        one = parts.couplings[one].next_leg
    return total


@kernel
def _meet(parts: Parts, k: int, other: int) -> bool:
    """Return whether two couplings share a body; those of several legs may."""
    a, b, ground = parts.couplings[k], parts.couplings[other], parts.bodies.size
    legs = a.next_leg != NONE or b.next_leg != NONE
    socket = a.socket != ground and (a.socket == b.socket or a.socket == b.shaft)
    return legs or socket or (a.shaft != ground and (a.shaft == b.socket or a.shaft == b.shaft))


@kernel
def _of_couplings(parts: Parts, now: Now, k: int, m: int, other: int, n: int) -> float:
    """Return the block of a row of one coupling and a row of another."""
    total = 0.0
    a, b = parts.couplings[k], parts.couplings[other]
    for side in range(2):
        body = a.socket if side == 0 else a.shaft
        if body == parts.bodies.size:
            continue
        for opposite in range(2):
            if body == (b.socket if opposite == 0 else b.shaft):
                left, right = now.couplings[k].G[m], now.couplings[other].G[n]
                total += _in_body(parts.bodies[body], left[6 * side :], right[6 * opposite :])
    return total


@kernel
def _in_body(body: Record, left: FloatArray, right: FloatArray) -> float:
    """Return the product of two rows over the inverse mass of one body."""
    total = 0.0
    for i in range(3):
        total += left[i] * right[i] / body.mass
        for j in range(3):
            total += left[3 + i] * body.inverse[i, j] * right[3 + j]
    return total


@entry
def choose_rows(parts: Parts, now: Now, matrix: FloatMatrix) -> None:
    """Mark the rows that are dependent, by Cholesky's decomposition of G M⁻¹ Gᵀ with pivoting.

    ``matrix`` (n_rows, n_rows) is work space. Most of its entries are zero: few rows share bodies.
    """
    n = matrix.shape[0]
    whole = n - n % WIDTH
    matrix[:] = 0.0
    for k in range(parts.couplings.size):
        for other in range(parts.couplings.size):
            if not _meet(parts, k, other):
                continue
            for m in range(parts.couplings[k].n_rows):
                row = parts.couplings[k].first_row + m
                for j in range(parts.couplings[other].n_rows):
                    column = parts.couplings[other].first_row + j
                    scale = now.couplings[k].scale[m] * now.couplings[other].scale[j]
                    matrix[row, column] = _product(parts, now, k, m, other, j) / math.sqrt(scale)
    for _ in range(min(parts.constants.rank, n)):
        best_k, best_m, best = 0, 0, -1.0
        for k in range(parts.couplings.size):
            state = now.couplings[k]
            for m in range(parts.couplings[k].n_rows):
                row = parts.couplings[k].first_row + m
                pivot = matrix[row, row] * (PREFERRED if state.dependent[m] == 0.0 else 1.0)
                if state.dependent[m] < 2.0 and pivot > best:
                    best_k, best_m, best = k, m, pivot
        row = parts.couplings[best_k].first_row + best_m
        now.couplings[best_k].dependent[best_m] += 2.0
        for i in range(n):
            if i != row and matrix[i, row] != 0.0:
                factor = matrix[i, row] / matrix[row, row]
                for j in range(0, whole, WIDTH):
                    share = spread(factor) * load(matrix, n * row + j)
                    store(matrix, n * i + j, load(matrix, n * i + j) - share)
                for j in range(whole, n):
                    matrix[i, j] -= factor * matrix[row, j]
        for i in range(n):
            matrix[i, row] = matrix[row, i] = 0.0
    for k in range(parts.couplings.size):
        state = now.couplings[k]
        for m in range(parts.couplings[k].n_rows):
            state.dependent[m] = 0.0 if state.dependent[m] >= 2.0 else 1.0
    set_compliance(parts, now)
