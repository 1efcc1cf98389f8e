"""The order of elimination: cost linear in bodies, and pivots that are regular."""

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.kernels.mechanism.blocks import INVERT_DEFINITE, factorise, solve
from tribodyn.mechanism.assembly.ordering import Rows, elimination_order, make_pattern, n_blocks


def _loop() -> tuple[FloatArray, list[Rows], dict[tuple[int, int], int]]:
    """Return a random saddle-point matrix of a closed loop of three bodies with rows of 5, 4, 5 and 3."""
    rng = np.random.default_rng(4)
    rows = [Rows(3, (0,), True), Rows(4, (0, 1), False), Rows(5, (1, 2), False), Rows(6, (2,), True)]
    matrix = np.zeros((42, 42))
    block_of = {(k, k): k for k in range(7)}
    for b in range(3):
        root = rng.normal(size=(6, 6))
        matrix[6 * b : 6 * b + 6, 6 * b : 6 * b + 6] = root @ root.T + np.eye(6)
    for row, n_rows in zip(rows, (5, 4, 5, 3), strict=True):
        first = 6 * row.node
        matrix[first : first + 6, first : first + 6] = np.diag([1e-12] * n_rows + [1.0] * (6 - n_rows))
        for b in row.bodies:
            block = np.zeros((6, 6))
            block[:n_rows] = rng.normal(size=(n_rows, 6))
            matrix[first : first + 6, 6 * b : 6 * b + 6] = block
            matrix[6 * b : 6 * b + 6, first : first + 6] = -block.T
            block_of[row.node, b] = len(block_of)
            block_of[b, row.node] = len(block_of)
    return matrix, rows, block_of


@pytest.mark.parametrize("inverted", [None, 3], ids=["pivoting in blocks", "definite blocks"])
def test_elimination_without_pivoting_between_blocks_is_accurate(inverted: int | None) -> None:
    matrix, rows, block_of = _loop()
    order = elimination_order(7, 3, rows, [pair for pair in block_of if pair[0] < pair[1]])
    given = dict(block_of)
    sizes = [6, 6, 6, 5, 4, 5, 3]
    pattern = make_pattern(order, block_of, sizes, inverted)
    blocks = np.zeros((n_blocks(pattern), 6, 8))
    for (i, j), number in given.items():
        blocks[number, :, :6] = matrix[6 * i : 6 * i + 6, 6 * j : 6 * j + 6].T
    if inverted is not None:
        for b in set(range(inverted)) - set(pattern.factor[pattern.factor[:, 0] == INVERT_DEFINITE, 1]):
            blocks[b, :, :6] = np.linalg.inv(blocks[b, :, :6])
    wanted = np.random.default_rng(5).normal(size=(7, 6))
    for node, size in enumerate(sizes):
        wanted[node, size:] = 0.0
    x = np.zeros((7, 8))
    x[:, :6] = (matrix @ wanted.ravel()).reshape(7, 6)
    assert factorise(pattern, blocks)
    solve(pattern, blocks, x)
    # Condition 1e3 to 1e4.
    assert x[:, :6] == pytest.approx(wanted, abs=1e-10)
