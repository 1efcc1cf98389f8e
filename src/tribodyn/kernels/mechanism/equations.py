"""The equations of motion as one sparse linear system: its blocks, and its solutions for the multipliers.

See ``kernels/mechanism/solution.py`` for what is solved.
"""

from typing import Annotated, Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import entry, inlined, kernel
from tribodyn.kernels.lanes import WIDTH, store, zeros
from tribodyn.kernels.mechanism.blocks import factorise, solve
from tribodyn.kernels.mechanism.data import NONE, Coupling, Now, Parts, Pattern

ROUNDS: Final = 3
#: Most solutions for the multipliers; part of the energy that the last one may change where the factors are
#: those of another position: one more would change less than the square of it.
NEGLIGIBLE: Final = 1.0e-12


@entry
def has_law(coupling: Annotated[Record, Coupling]) -> bool:
    """Return whether a coupling is the first leg of an element with a force law."""
    found: bool = coupling.law != 0 and coupling.first_leg == NONE
    return found


@kernel
def assemble(parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray) -> None:
    """Fill the blocks of the equations of motion and factorise them."""
    nothing = zeros()
    for at in range(0, blocks.size, WIDTH):
        store(blocks, at, nothing)
    for b in range(parts.bodies.size):
        body = parts.bodies[b]
        mass, inertia = body.mass, body.inertia
        if body.inverted == 1:
            mass, inertia = 1.0 / body.mass, body.inverse
        for i in range(3):
            blocks[b, i, i] = mass
            for j in range(3):
                blocks[b, 3 + i, 3 + j] = inertia[i, j]
    for k in range(parts.couplings.size):
        if parts.couplings[k].node != NONE:
            _fill_blocks(parts.couplings[k], now.couplings[k], blocks)
    factorise(pattern, blocks)


@kernel
def _fill_blocks(coupling: Record, state: Record, blocks: FloatArray) -> None:
    """Fill the blocks of the rows of a coupling, or add those of a later leg of an element."""
    if coupling.n_rows == 0:
        if has_law(coupling):
            for m in range(6):
                blocks[coupling.node, m, m] = 1.0
        _add_leg(coupling, state, blocks)
        return
    for m in range(6):
        blocks[coupling.node, m, m] = state.compliance[m] if m < coupling.n_rows else 1.0
    for side in range(2):
        block, transposed = coupling.rows_block[side, 0], coupling.rows_block[side, 1]
        if block == NONE:
            continue
        for m in range(coupling.n_rows):
            for j in range(6):
                blocks[block, j, m] = state.G[m, 6 * side + j]
                blocks[transposed, m, j] = -state.G[m, 6 * side + j]


@kernel
def _add_leg(coupling: Record, state: Record, blocks: FloatArray) -> None:
    """Add the only row of a leg to the blocks that it shares with the first leg of its element.

    The row of a force law holds no motion.
    """
    for side in range(2):
        block, transposed = coupling.rows_block[side, 0], coupling.rows_block[side, 1]
        if block == NONE:
            continue
        for j in range(6):
            if coupling.law == 0:
                blocks[block, j, 0] += state.G[0, 6 * side + j]
            blocks[transposed, 0, j] -= state.G[0, 6 * side + j]


@kernel
def solve_rows(
    parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray, forced: float, exact: float
) -> None:
    """Fill ``now.x`` with the solution for ``now.rest``, iterated for the multipliers.

    Force laws act where ``forced`` is 1, and not where it is 0. After a round rows miss their compliance
    times what the round has added to the multipliers; ``exact`` is the part of what they carry that they may.
    """
    _fill_left(parts, now, forced)
    for repeat in range(ROUNDS):
        _add_solution(pattern, blocks, now, repeat == 0)
        if parts.constants.n_rows == 0 or _comply(parts, now, exact):
            break


@kernel
def solve_near(
    parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray, forced: float, known: float
) -> bool:
    """Do the same with the factors of a position close by; return whether these do.

    Each round is for what is really left, so that the last one shows if they do. ``known`` is twice an energy
    to which corrections are added, or 0: beside a large one the first round is the last.
    """
    _fill_left(parts, now, forced)
    for repeat in range(ROUNDS):
        if repeat > 0:
            _leave(parts, now)
        _add_solution(pattern, blocks, now, repeat == 0)
        if repeat > 0 or known > 0.0:
            added = _energy(parts, now, now.left)
            if added <= NEGLIGIBLE * max(known, _energy(parts, now, now.x)):
                return True
    return False


@inlined
def _add_solution(pattern: Pattern, blocks: FloatArray, now: Now, is_first: bool) -> None:
    """Solve for what is left and add it to ``now.x``."""
    x, left = now.x, now.left
    solve(pattern, blocks, left)
    for k in range(x.shape[0]):
        for i in range(6):
            x[k, i] = left[k, i] if is_first else x[k, i] + left[k, i]


@kernel
def _comply(parts: Parts, now: Now, exact: float) -> bool:
    """Fill ``now.left`` with what rows miss after a round; return whether it is too little to go on."""
    missed = carried = 0.0
    for b in range(parts.bodies.size):
        for i in range(6):
            now.left[b, i] = 0.0
    for k in range(parts.couplings.size):
        coupling, state = parts.couplings[k], now.couplings[k]
        if coupling.node == NONE or coupling.first_leg != NONE:
            continue
        left, x = now.left[coupling.node], now.x[coupling.node]
        for m in range(6):
            if m < coupling.n_rows:
                left[m] *= state.compliance[m]
                missed += left[m] * left[m] / state.scale[m]
                carried += state.scale[m] * x[m] * x[m]
            else:
                left[m] = 0.0
    return missed <= exact * exact * carried


@kernel
def _fill_left(parts: Parts, now: Now, forced: float) -> None:
    """Fill ``now.left`` with ``now.rest``, and forces of laws; unknowns without a row are zero."""
    for b in range(parts.bodies.size):
        for i in range(6):
            now.left[b, i] = now.rest[b, i]
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        for m in range(6 if coupling.n_rows > 0 else 0):
            now.left[coupling.node, m] = now.rest[coupling.node, m] if m < coupling.n_rows else 0.0
        if has_law(coupling):
            for m in range(6):
                law = now.couplings[k].law
                now.left[coupling.node, m] = law.force if forced == 1.0 and m == 0 else 0.0


@kernel
def _leave(parts: Parts, now: Now) -> None:
    """Fill ``now.left`` with what ``now.x`` leaves of ``now.rest``: without compliance, at this position."""
    x, left, n_bodies = now.x, now.left, parts.bodies.size
    for b in range(n_bodies):
        body = parts.bodies[b]
        for i in range(3):
            left[b, i] = now.rest[b, i] - body.mass * x[b, i]
            turned = 0.0
            for j in range(3):
                turned += body.inertia[i, j] * x[b, 3 + j]
            left[b, 3 + i] = now.rest[b, 3 + i] - turned
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        if coupling.node == NONE:
            continue
        if coupling.first_leg == NONE:
            for m in range(6):
                left[coupling.node, m] = now.rest[coupling.node, m] if m < coupling.n_rows else 0.0
        for side in range(2):
            body = coupling.socket if side == 0 else coupling.shaft
            if body < n_bodies:
                _leave_rows(coupling, now.couplings[k].G, 6 * side, x, left, body)


@kernel
def _leave_rows(
    coupling: Record, matrix: FloatArray, first: int, x: FloatArray, left: FloatArray, body: int
) -> None:
    """Subtract the products of rows and a body from the rest of both."""
    held = 1.0 if coupling.law == 0 else 0.0
    for m in range(coupling.n_terms):
        size, total = x[coupling.node, m], 0.0
        for j in range(6):
            left[body, j] += matrix[m, first + j] * size
            total += matrix[m, first + j] * x[body, j]
        left[coupling.node, m] -= held * total


@kernel
def _energy(parts: Parts, now: Now, x: FloatArray) -> float:
    """Return twice the energy of velocities, and of impulses of rows on the masses that these move."""
    total = 0.0
    for b in range(parts.bodies.size):
        total += _of_body(parts.bodies[b], x[b, :3], x[b, 3:6])
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        for m in range(coupling.n_rows):
            size = x[coupling.node, m]
            total += now.couplings[k].scale[m] * size * size
    return total


@kernel
def energy_of_motion(parts: Parts, now: Now) -> float:
    """Return twice the kinetic energy of the bodies."""
    total = 0.0
    for b in range(parts.bodies.size):
        total += _of_body(parts.bodies[b], now.bodies[b].v, now.bodies[b].w)
    return total


@kernel
def _of_body(body: Record, v: FloatArray, w: FloatArray) -> float:
    """Return twice the energy of a body."""
    total = body.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    for i in range(3):
        turned = body.inertia[i, 0] * w[0] + body.inertia[i, 1] * w[1] + body.inertia[i, 2] * w[2]
        total += turned * w[i]
    return total
