"""Order in which the blocks of a mechanism's matrices are eliminated.

Minimum degree, with one condition that makes pivoting between blocks needless. The rows of a joint, or the
equation of an element over up to four bodies, are eliminated only after one of its bodies, and only while
the bodies eliminated with it, held together by joints eliminated before, touch no more than one other body
(or the ground). Then their relative motion is free but for constraints among themselves, and the pivot is
what the rows see of it: regular unless the rows are truly dependent. For a tree that is elimination from the
leaves to the root; a loop is closed before the body it hangs on. The nodes of force laws, whose pivot is 1,
come before all others.
"""

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from mebdf.arrays import IntArray
from tribodyn.kernels.mechanism.blocks import DIVIDE, INVERT, INVERT_DEFINITE, PLACE, SUBTRACT
from tribodyn.kernels.mechanism.data import NONE, N, Pattern
from tribodyn.kernels.mechanism.newton import N_BODY, N_COMPLIANCE, N_PAIR, N_ROW


@dataclass(frozen=True)
class Rows:
    """Constraint rows of a joint, or the equation of an element, as a node."""

    node: int  #: Its number.
    bodies: tuple[int, ...]  #: Its bodies, without the ground.
    grounded: bool  #: Whether the ground is one of its bodies.


class _Anchors:
    """Bodies not yet eliminated that the clusters of eliminated bodies are tied to by eliminated joints."""

    def __init__(self, n_bodies: int) -> None:
        self.cluster = list(range(n_bodies))
        self.anchors: list[set[int]] = [set() for _ in range(n_bodies)]
        self.gone = [False] * n_bodies
        self.ground = n_bodies

    def _of(self, rows: Rows) -> tuple[set[int], set[int]]:
        """Return the clusters that a joint ties together, and all that they are tied to then."""
        clusters = {self.cluster[b] for b in rows.bodies if self.gone[b]}
        tied = {b for b in rows.bodies if not self.gone[b]} | ({self.ground} if rows.grounded else set())
        for c in clusters:
            tied |= {b for b in self.anchors[c] if b == self.ground or not self.gone[b]}
        return clusters, tied

    def allows(self, rows: Rows) -> bool:
        """Tell whether a joint may be eliminated."""
        clusters, tied = self._of(rows)
        return bool(clusters) and len(tied) <= 1

    def tie(self, rows: Rows) -> None:
        """Eliminate a joint."""
        clusters, tied = self._of(rows)
        first = min(clusters)
        self.cluster = [first if c in clusters else c for c in self.cluster]
        self.anchors[first] = tied

    def eliminate(self, body: int) -> None:
        """Eliminate a body; clusters that were tied to it alone are one with it."""
        self.gone[body] = True
        for c, tied in enumerate(self.anchors):
            if body in tied and self.cluster[c] == c:
                tied.discard(body)
                self.cluster = [self.cluster[body] if k == c else k for k in self.cluster]
                self.anchors[self.cluster[body]] |= tied


def elimination_order(
    sizes: Sequence[int], n_bodies: int, rows: list[Rows], edges: list[tuple[int, int]]
) -> list[int]:
    """Return all nodes in the order of their elimination; bodies are the first, edges pairs with a block.

    Other nodes without constraint rows belong to force laws. Where many nodes are left in the end that are
    all coupled, those with few of the unknowns ``sizes`` are.
    """
    order = _order_of(len(sizes), n_bodies, rows, edges, [0] * len(sizes))
    if _crowd(order, _later(order, [*edges, *((b, a) for a, b in edges)]), n_bodies):
        return _order_of(len(sizes), n_bodies, rows, edges, sizes)
    return order


def _order_of(
    n_nodes: int, n_bodies: int, rows: list[Rows], edges: list[tuple[int, int]], sizes: Sequence[int]
) -> list[int]:
    """Return the order with minimum degree; of several nodes those with many unknowns come first."""
    neighbours: list[set[int]] = [set() for _ in range(n_nodes)]
    for a, b in edges:
        neighbours[a].add(b)
        neighbours[b].add(a)
    of_node = {r.node: r for r in rows}
    anchors, order, left = _Anchors(n_bodies), [], set(range(n_nodes))
    laws = {k for k in left if k >= n_bodies and k not in of_node}
    while left:
        nearest = sorted(laws & left or left, key=lambda k: (len(neighbours[k]), k < n_bodies, -sizes[k], k))
        node = next(k for k in nearest if k < n_bodies or k in laws or anchors.allows(of_node[k]))
        order.append(node)
        left.discard(node)
        if node < n_bodies:
            anchors.eliminate(node)
        elif node in of_node:
            anchors.tie(of_node[node])
        around = neighbours[node]
        for k in around:
            neighbours[k] |= around - {k}
            neighbours[k].discard(node)
    return order


_CROWD: Final = 16  #: Number of nodes, all coupled at the end, from which on their unknowns are packed.


class _Operations:
    """Operations that factorise and solve, as they come up; blocks that fill in join ``block_of``."""

    def __init__(self, block_of: dict[tuple[int, int], int], sizes: Sequence[int]) -> None:
        self.block_of, self.sizes = block_of, list(sizes)
        self.factor: list[tuple[int, ...]] = []
        self.forward: list[tuple[int, ...]] = []
        self.backward: list[list[tuple[int, ...]]] = []  #: Of each node, the last of which come first.
        self.changed: set[int] = set()

    def block(self, row: int, column: int) -> int:
        """Return the number of a block, a new one if it has none."""
        return self.block_of.setdefault((row, column), len(self.block_of))

    def subtract(self, target: int, left: int, right: int, columns: int, inner: int) -> None:
        """Subtract the product of two blocks from a third one."""
        self.changed.add(target)
        self.factor.append((SUBTRACT, target, left, right, columns, inner))

    def eliminate(self, node: int, later: set[int], below: list[int], kind: int | None) -> None:
        """Eliminate a node, before the nodes ``later``, of which ``below`` are the same in their order.

        ``kind``: how its block on the diagonal is inverted, where it is.
        """
        block, sizes = self.block, self.sizes
        diagonal, size = block(node, node), sizes[node]
        if kind is not None:
            self.factor.append((kind, diagonal, 0, 0, size, size))
        self.factor.extend((DIVIDE, block(i, node), diagonal, 0, size, size) for i in below)
        for i, j in itertools.product(below, below):
            self.subtract(block(i, j), block(i, node), block(node, j), sizes[j], size)
        self.forward.extend((block(i, node), i, node, size) for i in below)
        solved = [(block(node, j), node, j, sizes[j]) for j in later]
        self.backward.append([*solved, (diagonal, node, node, size)])

    def pack(self, groups: list[list[int]]) -> dict[int, int]:
        """Put the unknowns of each group of nodes into a new node; return the new node of each old one.

        With E, which takes the unknowns of old nodes out of those of new ones, blocks become Eᵀ S E,
        right-hand sides Eᵀ x, and solutions are E x: products as all others, once the entries of E are there.
        """
        given, new, into, out = dict(self.block_of), {}, {}, {}
        for number, group in enumerate(groups, len(self.sizes)):
            total = 0
            for i in group:
                new[i], size, known = number, self.sizes[i], 0 if total else N
                into[i], out[i] = self.block(NONE, i), self.block(i, NONE)
                self.factor.append((PLACE, into[i], total, 0, size, -1))
                self.factor.append((PLACE, out[i], 0, total, size, -1))
                self.forward.append((into[i], number, i, known + size))
                self.backward.append([(out[i], i, number, N + size)])
                total += size
            self.sizes.append(total)
            self.factor.append((PLACE, self.block(number, number), total, total, N - total, 1))
        halves = {}
        for (row, column), number in given.items():
            place = row, new.get(column, column)
            halves[place] = self.block(*place)
            if column in new:
                self.subtract(halves[place], number, out[column], self.sizes[place[1]], self.sizes[column])
        for (row, column), number in halves.items():
            if row in new:
                target = self.block(new[row], column)
                self.subtract(target, into[row], number, self.sizes[column], self.sizes[row])
        return new


def make_pattern(
    order: list[int], block_of: dict[tuple[int, int], int], sizes: Sequence[int], inverted: int | None = None
) -> Pattern:
    """Return the operations that factorise and solve in an order; blocks that fill in join ``block_of``.

    This numbers the blocks by row and column, both of each pair. Beyond the unknowns of a node, at most six,
    blocks on the diagonal are unit matrices, others zero. Of the first ``inverted`` nodes, bodies, blocks on
    the diagonal are symmetric and positive definite, and inverses to begin with where nothing is subtracted
    from them. Where many nodes are left in the end that are all coupled, as the joints are that close the
    loops of all vanes over one ring, their unknowns are packed into few.
    """
    steps, n_nodes = _Operations(block_of, sizes), len(sizes)
    later = _later(order, block_of)
    if crowd := _crowd(order, later, inverted or 0):
        new = steps.pack(_groups(crowd, sizes))
        order = [*(k for k in order if k not in new), *range(n_nodes, len(steps.sizes))]
        later = _later(order, {(new.get(a, a), new.get(b, b)) for a, b in block_of if {a, b} <= later.keys()})
    place = {node: i for i, node in enumerate(order)}
    for node in order:
        kind: int | None = INVERT
        if inverted is not None:
            fixed = node < inverted and steps.block(node, node) not in steps.changed
            kind = None if fixed else INVERT_DEFINITE
        steps.eliminate(node, later[node], sorted(later[node], key=place.__getitem__), kind)
    backward = [step for solved in reversed(steps.backward) for step in solved]
    lists = _array(steps.factor, 6), _array(steps.forward, 4), _array(backward, 4)
    return Pattern(*lists, np.zeros(6, dtype=np.int64))


def _later(order: list[int], pairs: Iterable[tuple[int, int]]) -> dict[int, set[int]]:
    """Return the nodes after each one that it is coupled with when it is eliminated."""
    place = {node: i for i, node in enumerate(order)}
    later: dict[int, set[int]] = {node: set() for node in order}
    for a, b in pairs:
        if place[a] < place[b]:
            later[a].add(b)
    for node in order:
        below = sorted(later[node], key=place.__getitem__)
        for i in below:
            later[i] |= {j for j in below if place[j] > place[i]}
    return later


def _crowd(order: list[int], later: dict[int, set[int]], n_bodies: int) -> list[int]:
    """Return the nodes at the end, but bodies, that are all coupled; none where they are few."""
    first = len(order)
    while first > 0 and order[first - 1] >= n_bodies and len(later[order[first - 1]]) == len(order) - first:
        first -= 1
    return order[first:] if len(order) - first >= _CROWD else []


def _groups(nodes: list[int], sizes: Sequence[int]) -> list[list[int]]:
    """Return nodes in groups that have up to six unknowns."""
    groups: list[list[int]] = []
    for node in nodes:
        if not groups or sum(sizes[i] for i in (*groups[-1], node)) > N:
            groups.append([])
        groups[-1].append(node)
    return groups


def _array(operations: Sequence[tuple[int, ...]], width: int) -> IntArray:
    """Return operations as an array."""
    return np.array(operations, dtype=np.int64).reshape(-1, width)


_KEPT: Final = 8  #: Structures of mechanisms whose patterns are kept.


def n_blocks(pattern: Pattern) -> int:
    """Return the number of blocks that a pattern works on."""
    numbers = pattern.factor[:, 1], pattern.forward[:, 0], pattern.backward[:, 0]
    return 1 + int(np.max(np.concatenate(numbers)))


def n_nodes(pattern: Pattern) -> int:
    """Return the number of nodes, with those into which others are packed."""
    return 1 + int(np.max(pattern.backward[:, 1]))


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
    order = elimination_order(sizes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    mass = make_pattern(order, dict(block_of), sizes, n_bodies)
    for k, (_, socket, shaft, *_) in enumerate(couplings):
        if socket < n_bodies and shaft < n_bodies:
            bodies_block[k] = block(socket, shaft), block(shaft, socket)
    order = elimination_order(sizes, n_bodies, rows, [(a, b) for a, b in block_of if a < b])
    return mass, make_pattern(order, dict(block_of), sizes), rows_block, bodies_block
