"""The order of elimination: cost linear in bodies, and pivots that are regular."""

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.kernels.mechanism.blocks import INVERT_DEFINITE, factorise, solve
from tribodyn.kernels.mechanism.data import Pattern
from tribodyn.mechanism.assembly.ordering import Rows, elimination_order, make_pattern, n_blocks, n_nodes

#: Bodies, whether the ground is one, and rows.
_Joints = list[tuple[tuple[int, ...], bool, int]]


def _loop() -> tuple[int, _Joints]:
    """Return the number of bodies and the joints of a closed loop of three bodies."""
    return 3, [((0,), True, 5), ((0, 1), False, 4), ((1, 2), False, 5), ((2,), True, 3)]


def _star(n: int) -> tuple[int, _Joints]:
    """Return those of a guided ring with so many vanes, all tied to it and to the ground."""
    joints: _Joints = [((0,), True, 4)]
    joints += [((b,), True, 5) for b in range(1, n + 1)]
    return n + 1, joints + [((0, b), False, 1) for b in range(1, n + 1)]


def _matrix(n_bodies: int, joints: _Joints) -> tuple[FloatArray, list[Rows], dict[tuple[int, int], int]]:
    """Return a random saddle-point matrix of a mechanism, its rows, and the numbers of its blocks."""
    rng, n = np.random.default_rng(4), n_bodies + len(joints)
    matrix = np.zeros((6 * n, 6 * n))
    block_of = {(k, k): k for k in range(n)}
    for b in range(n_bodies):
        root = rng.normal(size=(6, 6))
        matrix[6 * b : 6 * b + 6, 6 * b : 6 * b + 6] = root @ root.T + np.eye(6)
    for node, (bodies, _, n_rows) in enumerate(joints, n_bodies):
        first = 6 * node
        matrix[first : first + 6, first : first + 6] = np.diag([1e-12] * n_rows + [1.0] * (6 - n_rows))
        for b in bodies:
            block = np.zeros((6, 6))
            block[:n_rows] = rng.normal(size=(n_rows, 6))
            matrix[first : first + 6, 6 * b : 6 * b + 6] = block
            matrix[6 * b : 6 * b + 6, first : first + 6] = -block.T
            block_of[node, b] = len(block_of)
            block_of[b, node] = len(block_of)
    rows = [Rows(node, bodies, grounded) for node, (bodies, grounded, _) in enumerate(joints, n_bodies)]
    return matrix, rows, block_of


def _pattern(
    n_bodies: int, joints: _Joints, inverted: int | None
) -> tuple[Pattern, FloatArray, list[int], dict[tuple[int, int], int]]:
    """Return the pattern of a mechanism, its matrix, the sizes of its nodes, and the blocks given."""
    matrix, rows, block_of = _matrix(n_bodies, joints)
    sizes, given = [6] * n_bodies + [n_rows for *_, n_rows in joints], dict(block_of)
    order = elimination_order(sizes, n_bodies, rows, [pair for pair in block_of if pair[0] < pair[1]])
    return make_pattern(order, block_of, sizes, inverted), matrix, sizes, given


@pytest.mark.parametrize("definite", [False, True], ids=["pivoting in blocks", "definite blocks"])
@pytest.mark.parametrize("mechanism", [_loop(), _star(5), _star(30)], ids=["loop", "5 vanes", "30 vanes"])
def test_elimination_without_pivoting_between_blocks_is_accurate(
    mechanism: tuple[int, _Joints], definite: bool
) -> None:
    n_bodies, joints = mechanism
    pattern, matrix, sizes, given = _pattern(n_bodies, joints, n_bodies if definite else None)
    blocks = np.zeros((n_blocks(pattern), 6, 8))
    for (i, j), number in given.items():
        blocks[number, :, :6] = matrix[6 * i : 6 * i + 6, 6 * j : 6 * j + 6].T
    if definite:
        for b in set(range(n_bodies)) - set(pattern.factor[pattern.factor[:, 0] == INVERT_DEFINITE, 1]):
            blocks[b, :, :6] = np.linalg.inv(blocks[b, :, :6])
    n = len(sizes)
    wanted = np.random.default_rng(5).normal(size=(n, 6))
    for node, size in enumerate(sizes):
        wanted[node, size:] = 0.0
    # What nodes hold into which others are packed does not matter, even where it is no number.
    x = np.full((n_nodes(pattern), 8), np.nan)
    x[:n] = 0.0
    x[:n, :6] = (matrix @ wanted.ravel()).reshape(n, 6)
    assert factorise(pattern, blocks)
    solve(pattern, blocks, x)
    # Conditions are 1e3 to 1e6.
    assert x[:n, :6] == pytest.approx(wanted, abs=1e-14 * float(np.linalg.cond(matrix)))


def test_many_loops_over_one_body_do_not_couple_all_their_blocks() -> None:
    of_30, of_60 = (len(_pattern(*_star(n), n + 1)[0].factor) for n in (30, 60))
    # Three times; every loop with every other one would take eight times as many.
    assert of_60 < 3.2 * of_30
