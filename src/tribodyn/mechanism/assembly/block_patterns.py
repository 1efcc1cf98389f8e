"""Blocks of the linear systems of a mechanism, and places of the entries of the iteration matrix."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import IntArray
from tribodyn.kernels.mechanism.data import NONE, Pattern
from tribodyn.kernels.mechanism.newton import N_BODY, N_COMPLIANCE, N_PAIR, N_ROW
from tribodyn.mechanism.assembly.ordering import Rows, elimination_order, make_pattern

_KEPT: Final = 8
"""Structures of mechanisms whose patterns are kept."""


def n_blocks(pattern: Pattern) -> int:
    """Return the number of blocks that a pattern works on."""
    return 1 + int(np.max(np.append(pattern.forward[:, 0], pattern.backward[:, 0])))


def patterns(n_bodies: int, couplings: Any) -> tuple[Pattern, Pattern]:
    """Return the patterns of the equations of motion and of the iteration matrix; number the blocks."""
    numbers = [couplings[name] for name in ("node", "socket", "shaft", "n_terms")]
    structure = np.ascontiguousarray(np.stack([*numbers, couplings.law != 0], axis=1), np.int64)
    mass, newton, rows_block, bodies_block = _patterns_of(n_bodies, structure.tobytes())
    couplings.rows_block[:], couplings.bodies_block[:] = rows_block, bodies_block
    return _copy(mass), _copy(newton)


def number_entries(n_bodies: int, couplings: Any) -> int:
    """Fill the beginnings of the couplings' entries in the iteration matrix; return their number."""
    sides = (couplings.socket < n_bodies).astype(int) + (couplings.shaft < n_bodies)
    of_rows = N_ROW * sides * couplings.n_terms + N_COMPLIANCE
    numbers = N_PAIR * sides**2 + np.where(couplings.node != NONE, of_rows, 0)
    ends = N_BODY * n_bodies + np.cumsum(numbers)
    couplings.first_entry[:] = ends - numbers
    return int(ends[-1]) if ends.size else N_BODY * n_bodies


def _copy(pattern: Pattern) -> Pattern:
    return Pattern(*(array.copy() for array in pattern))


@lru_cache(_KEPT)
def _patterns_of(n_bodies: int, structure: bytes) -> tuple[Pattern, Pattern, IntArray, IntArray]:
    """Return both patterns, and the blocks of rows, (n, 2, 2), and of pairs of bodies, (n, 2).

    ``structure`` holds node, socket, shaft and rows of each coupling, and whether it has a law.
    """
    couplings: list[list[int]] = np.frombuffer(structure, np.int64).reshape(-1, 5).tolist()
    n_nodes = max([n_bodies, *(1 + node for node, *_ in couplings)])
    block_of, sizes = {(k, k): k for k in range(n_nodes)}, [6] * n_nodes
    of_node: dict[int, list[int]] = {}
    rows_block, bodies_block = np.full((len(couplings), 2, 2), NONE), np.full((len(couplings), 2), NONE)
    laws = {node for node, *_, law in couplings if law}
    for node, *_, n_terms, _ in couplings:
        if node != NONE:
            sizes[node] = n_terms

    def block(row: int, column: int) -> int:
        return block_of.setdefault((row, column), len(block_of))

    for k, (node, *ends, _, _) in enumerate(couplings):
        bodies = [b if b < n_bodies else NONE for b in ends]
        if node != NONE:
            of_node.setdefault(node, []).extend(bodies)
            for side, body in enumerate(bodies):
                if body != NONE:
                    rows_block[k, side] = block(node, body), block(body, node)
    rows = [
        Rows(node, tuple(b for b in dict.fromkeys(bodies) if b != NONE), NONE in bodies)
        for node, bodies in of_node.items()
        if node not in laws
    ]
    order = elimination_order(n_nodes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    mass = make_pattern(order, dict(block_of), sizes, n_bodies)
    for k, (_, socket, shaft, *_) in enumerate(couplings):
        if socket < n_bodies and shaft < n_bodies:
            bodies_block[k] = block(socket, shaft), block(shaft, socket)
    order = elimination_order(n_nodes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    return mass, make_pattern(order, dict(block_of), sizes), rows_block, bodies_block
