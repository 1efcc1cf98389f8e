"""The iteration matrix of implicit methods by blocks: solutions with 1 − γ ∂f/∂y.

With the right-hand sides r, position and velocity of a body change by

    δπ = S δV + s,   S = γ (1, E),   δω ∘ (1, u)/(1 + u²) = (…, E δω),   u = γ ω/2,

because a product of quaternions from the right by 1 − u is what the quaternion's own rate makes of it. What
remains is of the form of the equations of motion, over the changes of velocity and of γ times the
multipliers:

    [M + γ (C + K_v + K_q S)] δV − Gᵀ δλ = M r_V − γ K_q s,
    [G + γ (Γ_v + Γ_q S)] δV + ε δλ = G r_V − γ Γ_q s.

Of an element with a force law, λ = F, both G of the second line are left out, ε is 1, and Γ are the
derivatives of −F.

The ``entries`` that ``jac`` leaves are all that is in it but γ: ``N_BODY`` numbers of each body, then those
of each coupling from its ``first_entry`` on. These are K_q and K_v, (6, 6), of each pair of its moving sides,
rows before columns and socket before shaft; and where it has rows, Γ_q, Γ_v and G of each side, (n_terms, 6),
and six compliances. ``factorise`` puts γ and the entries before the blocks, so that ``solve`` finds them.
"""

from typing import Final

from mebdf.arrays import FloatArray, IntArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.mechanism import blocks as algebra
from tribodyn.kernels.mechanism.data import (
    COLUMN,
    N_STATES,
    NONE,
    ORIENTATION,
    TURNING,
    VELOCITY,
    MechanismData,
    N,
    Now,
    Parts,
)

#: Entries that have a place in ∂f/∂y, before all others: of each body, what its own place does to its
#: acceleration.
N_PLACES: Final = 18
#: Of each body: quaternion (4), angular velocity (3), derivative of the gyroscopic moment (9).
N_BODY: Final = 16
GYROSCOPIC: Final = 7
N_PAIR: Final = 72  #: Of a pair of sides: K_q, K_v (6, 6).
KV: Final = 36
N_ROW: Final = 18  #: Of a row and a side: rows of Γ_q, Γ_v, G.
N_COMPLIANCE: Final = 6


@kernel
def _n_sides(coupling: Record, n_bodies: int) -> int:
    """Return the number of a coupling's two bodies that move."""
    return (1 if coupling.socket < n_bodies else 0) + (1 if coupling.shaft < n_bodies else 0)


@kernel
def _body_of(coupling: Record, side: int, n_bodies: int) -> int:
    """Return the body of a side among those that move: 0 is the first of them."""
    return int(coupling.socket if side == 0 and coupling.socket < n_bodies else coupling.shaft)


@kernel
def fill_entries(data: Parts, memory: Now, entries: FloatArray) -> None:
    """Fill the entries from what bodies and couplings hold."""
    n_bodies = data.bodies.size
    _fill_bound(data, memory, entries)
    entries = entries[N_PLACES * n_bodies :]
    for b in range(n_bodies):
        first, now = N_BODY * b, memory.bodies[b]
        for i in range(4):
            entries[first + i] = now.p[i]
        for i in range(3):
            entries[first + 4 + i] = now.w[i]
            for j in range(3):
                entries[first + GYROSCOPIC + 3 * i + j] = memory.bodies[b].gyroscopic[i, j]
    for k in range(data.couplings.size):
        coupling = data.couplings[k]
        _fill_coupling(coupling, memory.couplings[k], n_bodies, entries[coupling.first_entry :])


@kernel
def _fill_coupling(coupling: Record, now: Record, n_bodies: int, entries: FloatArray) -> None:
    """Fill the entries of a coupling, which ``entries`` begin with."""
    sides, at = _n_sides(coupling, n_bodies), 0
    first = 0 if coupling.socket < n_bodies else 6
    for rows in range(sides):
        for side in range(sides):
            for i in range(6):
                for j in range(6):
                    entries[at + 6 * i + j] = now.Kq[first + 6 * rows + i, first + 6 * side + j]
                    entries[at + KV + 6 * i + j] = now.Kv[first + 6 * rows + i, first + 6 * side + j]
            at += N_PAIR
    if coupling.node == NONE:
        return
    n = coupling.n_terms
    for side in range(sides):
        for m in range(n):
            for j in range(6):
                column, to = first + 6 * side + j, at + 6 * m + j
                entries[to], entries[to + 6 * n] = now.Gq[m, column], now.Gv[m, column]
                entries[to + 12 * n] = now.G[m, column]
        at += N_ROW * n
    for m in range(6):
        entries[at + m] = now.compliance[m]


@kernel
def _fill_bound(data: Parts, memory: Now, entries: FloatArray) -> None:
    """Fill the entries that have a place, of the forces alone: enough to tell what rounding does."""
    n_bodies = data.bodies.size
    for i in range(N_PLACES * n_bodies):
        entries[i] = 0.0
    for k in range(data.couplings.size):
        coupling, now = data.couplings[k], memory.couplings[k]
        for side in range(2):
            b = coupling.socket if side == 0 else coupling.shaft
            if b == n_bodies:
                continue
            body = data.bodies[b]
            for i in range(6):
                inverse = 1.0 / body.mass if i < 3 else body.inverse[i - 3, i - 3]
                for j in range(3):
                    stiffness = now.Kq[6 * side + i, 6 * side + j]
                    if coupling.law != 0:
                        stiffness += now.G[0, 6 * side + i] * now.Gq[0, 6 * side + j]
                    entries[N_PLACES * b + 3 * i + j] += inverse * abs(stiffness)


@kernel
def _turning(entries: FloatArray, body: int, gamma: float, e: FloatArray) -> None:
    """Fill E (3, 3) of a body: E δω = (δω + δω × u)/(1 + u²)."""
    first, half = N_BODY * body + 4, 0.5 * gamma
    square = 1.0
    for i in range(3):
        square += (half * entries[first + i]) ** 2
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        e[i, i] = 1.0 / square
        # δω × u = −[u]× δω.
        e[i, j] = half * entries[first + k] / square
        e[j, i] = -half * entries[first + k] / square


@entry
def factorise(
    gamma: float, data: MechanismData, jacobian: FloatArray, factors: FloatArray, pivots: IntArray
) -> int:
    """Prepare solutions with 1 − γ ∂f/∂y; return the sign of its determinant, 0 where it is singular.

    That is the sign for the blocks: it is positive for γ = 0, and what leads to the blocks has a positive
    determinant for any γ.
    """
    parts = data.parts
    n_bodies = parts.bodies.size
    entries = jacobian[N_PLACES * n_bodies :]
    n_entries = entries.size
    factors[0] = gamma
    for i in range(n_entries):
        factors[1 + i] = entries[i]
    for i in range(1 + n_entries, factors.size):
        factors[i] = 0.0
    turns, blocks = _split(factors, n_entries, n_bodies)
    for b in range(n_bodies):
        _turning(entries, b, gamma, turns[b])
        _body_block(parts.bodies[b], entries[N_BODY * b + GYROSCOPIC :], gamma, blocks[b])
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        _coupling_blocks(coupling, n_bodies, entries[coupling.first_entry :], gamma, turns, blocks)
    return algebra.factorise(data.newton, blocks)


@kernel
def _split(factors: FloatArray, n_entries: int, n_bodies: int) -> tuple[FloatArray, FloatArray]:
    """Return E of all bodies, shape (n_bodies, 3, 3), and the blocks by columns, shape (n_blocks, 6, 8)."""
    first = 1 + n_entries
    last = first + 9 * n_bodies
    blocks = factors[last:].reshape((-1, N, COLUMN))
    return factors[first:last].reshape((n_bodies, 3, 3)), blocks


@kernel
def _body_block(body: Record, gyroscopic: FloatArray, gamma: float, block: FloatArray) -> None:
    """Fill M + γ C of a body."""
    for i in range(3):
        block[i, i] = body.mass
        for j in range(3):
            block[3 + j, 3 + i] = body.inertia[i, j] + gamma * gyroscopic[3 * i + j]


@kernel
def _add(
    entries: FloatArray,
    at: int,
    velocity: int,
    gamma: float,
    turn: FloatArray,
    block: FloatArray,
    n_rows: int,
) -> None:
    """Add γ (K_v + K_q S) to a block, with rows of six from ``at`` and ``velocity`` on."""
    for i in range(n_rows):
        q, v = at + 6 * i, velocity + 6 * i
        for j in range(3):
            block[j, i] += gamma * (entries[v + j] + gamma * entries[q + j])
            turned = entries[q + 3] * turn[0, j] + entries[q + 4] * turn[1, j] + entries[q + 5] * turn[2, j]
            block[3 + j, i] += gamma * (entries[v + 3 + j] + gamma * turned)


@kernel
def _coupling_blocks(
    coupling: Record, n_bodies: int, entries: FloatArray, gamma: float, turns: FloatArray, blocks: FloatArray
) -> None:
    """Add the entries of a coupling to the blocks; ``entries`` begin with its own."""
    sides, n = _n_sides(coupling, n_bodies), coupling.n_terms
    first = 0 if coupling.socket < n_bodies else 1
    for side in range(sides):
        body = _body_of(coupling, side, n_bodies)
        turn = turns[body]
        for rows in range(sides):
            # Rows of one body, columns of another: below or above the diagonal.
            number = body if rows == side else coupling.bodies_block[rows]
            at = N_PAIR * (sides * rows + side)
            _add(entries, at, at + KV, gamma, turn, blocks[number], 6)
        if coupling.node == NONE:
            continue
        numbers, at = coupling.rows_block[first + side], N_PAIR * sides * sides + N_ROW * n * side
        below, beside = blocks[numbers[0]], blocks[numbers[1]]
        for m in range(n):
            for j in range(6):
                value = entries[at + 12 * n + 6 * m + j]
                if coupling.law == 0:
                    below[j, m] += value
                beside[m, j] -= value
        _add(entries, at, at + 6 * n, gamma, turn, below, n)
    if coupling.node != NONE and coupling.first_leg == NONE:
        diagonal, at = blocks[coupling.node], N_PAIR * sides * sides + N_ROW * n * sides
        for m in range(6):
            diagonal[m, m] += entries[at + m] if m < coupling.n_rows else 1.0


@entry
def solve(data: MechanismData, factors: FloatArray, pivots: IntArray, x: FloatArray) -> None:
    """Replace ``x`` (n,) by the solution."""
    parts = data.parts
    n_bodies = parts.bodies.size
    n_entries = parts.constants.n_entries
    gamma, entries = factors[0], factors[1 : 1 + n_entries]
    _, blocks = _split(factors, n_entries, n_bodies)
    n_nodes = parts.constants.n_nodes
    work = blocks[blocks.shape[0] - parts.constants.n_work :].reshape((-1, COLUMN))
    nodes, still = work[:n_nodes], work[n_nodes : n_nodes + n_bodies]
    for k in range(n_nodes):
        for i in range(6):
            nodes[k, i] = 0.0
    for b in range(n_bodies):
        _load_body(parts.bodies[b], entries, b, gamma, x, nodes[b], still[b])
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        _load_coupling(coupling, n_bodies, entries[coupling.first_entry :], gamma, x, nodes, still)
    algebra.solve(data.newton, blocks, nodes)
    for b in range(n_bodies):
        _unload_body(entries, b, gamma, nodes[b], x)


@kernel
def _halves(entries: FloatArray, body: int, gamma: float, out: FloatArray) -> float:
    """Fill ``out`` (3,) with u = γ ω/2; return 1 + u²."""
    square = 1.0
    for i in range(3):
        out[i] = 0.5 * gamma * entries[N_BODY * body + 4 + i]
        square += out[i] * out[i]
    return square


@kernel
def _unturned(entries: FloatArray, body: int, x: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (4,) with 2 p⁻¹ ∘ r of a body: what lengthens the quaternion, then what turns it."""
    p, r = entries[N_BODY * body :], x[N_STATES * body + ORIENTATION :]
    scale = 2.0 / (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    out[0] = scale * (p[0] * r[0] + p[1] * r[1] + p[2] * r[2] + p[3] * r[3])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        turned = p[0] * r[1 + i] - r[0] * p[1 + i] - p[1 + j] * r[1 + k] + p[1 + k] * r[1 + j]
        out[1 + i] = scale * turned


@kernel
def _load_body(
    body: Record,
    entries: FloatArray,
    number: int,
    gamma: float,
    x: FloatArray,
    node: FloatArray,
    still: FloatArray,
) -> None:
    """Fill M r_V, and the part s of the change of position that does not depend on velocities."""
    first = N_STATES * number
    r = x[first:]
    u = node[:3]  # free until it is filled
    square = _halves(entries, number, gamma, u)
    _unturned(entries, number, x, still[2:])
    # Its vector part is in 3..5 and the scalar one in 2: s_θ = (ρ + ρ_0 u + ρ × u)/(1 + u²).
    a, b, c, scalar = still[3], still[4], still[5], still[2]
    still[3] = (a + scalar * u[0] + b * u[2] - c * u[1]) / square
    still[4] = (b + scalar * u[1] + c * u[0] - a * u[2]) / square
    still[5] = (c + scalar * u[2] + a * u[1] - b * u[0]) / square
    for i in range(3):
        still[i] = r[i]
    for i in range(3):
        node[i] = body.mass * r[VELOCITY + i]
        node[3 + i] = 0.0
        for j in range(3):
            node[3 + i] += body.inertia[i, j] * r[TURNING + j]


@kernel
def _load_coupling(
    coupling: Record,
    n_bodies: int,
    entries: FloatArray,
    gamma: float,
    x: FloatArray,
    nodes: FloatArray,
    still: FloatArray,
) -> None:
    """Add −γ K_q s, and G r_V − γ Γ_q s, of a coupling; ``entries`` begin with its own."""
    held = 1.0 if coupling.law == 0 else 0.0
    sides, n = _n_sides(coupling, n_bodies), coupling.n_terms
    for side in range(sides):
        body = _body_of(coupling, side, n_bodies)
        way, r = still[body], x[N_STATES * body + VELOCITY :]
        for rows in range(sides):
            other = _body_of(coupling, rows, n_bodies)
            _load_rows(entries[N_PAIR * (sides * rows + side) :], gamma, way, nodes[other])
        if coupling.node == NONE:
            continue
        at = N_PAIR * sides * sides + N_ROW * n * side
        for m in range(n):
            total = 0.0
            for j in range(6):
                total += held * entries[at + 12 * n + j] * r[j] - gamma * entries[at + j] * way[j]
            nodes[coupling.node, m] += total
            at += 6


@kernel
def _load_rows(entries: FloatArray, gamma: float, way: FloatArray, node: FloatArray) -> None:
    """Add −γ K_q, which ``entries`` begin with, times a change of position."""
    a, b, c, d, e, f = way[0], way[1], way[2], way[3], way[4], way[5]
    for i in range(6):
        row = entries[6 * i :]
        total = row[0] * a + row[1] * b + row[2] * c + row[3] * d + row[4] * e + row[5] * f
        node[i] -= gamma * total


@kernel
def _unload_body(entries: FloatArray, number: int, gamma: float, node: FloatArray, x: FloatArray) -> None:
    """Put the change of a body's state where its right-hand side was."""
    first = N_STATES * number
    p = entries[N_BODY * number :]
    # 2 p⁻¹ ∘ r + γ (0, δω), from the right by (1, u)/(1 + u²), and back by ½ p ∘.
    u_x, u_y, u_z = 0.5 * gamma * p[4], 0.5 * gamma * p[5], 0.5 * gamma * p[6]
    square = 1.0 + u_x * u_x + u_y * u_y + u_z * u_z
    r = x[first + VELOCITY : first + VELOCITY + 4]
    _unturned(entries, number, x, r)
    s, a, b, c = r[0], r[1] + gamma * node[3], r[2] + gamma * node[4], r[3] + gamma * node[5]
    scalar = (s - a * u_x - b * u_y - c * u_z) / square
    t_x = (a + s * u_x + b * u_z - c * u_y) / square
    t_y = (b + s * u_y + c * u_x - a * u_z) / square
    t_z = (c + s * u_z + a * u_y - b * u_x) / square
    q = x[first + ORIENTATION : first + VELOCITY]
    q[0] = 0.5 * (p[0] * scalar - p[1] * t_x - p[2] * t_y - p[3] * t_z)
    q[1] = 0.5 * (p[0] * t_x + p[1] * scalar + p[2] * t_z - p[3] * t_y)
    q[2] = 0.5 * (p[0] * t_y + p[2] * scalar + p[3] * t_x - p[1] * t_z)
    q[3] = 0.5 * (p[0] * t_z + p[3] * scalar + p[1] * t_y - p[2] * t_x)
    for i in range(3):
        x[first + i] += gamma * node[i]
        x[first + VELOCITY + i] = node[i]
        x[first + TURNING + i] = node[3 + i]
