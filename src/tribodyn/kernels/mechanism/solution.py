"""Accelerations and reactions from one sparse linear system, and the way back to the constraints.

With accelerations a, multipliers λ and the compliances ε of the rows,

    M a − Gᵀ λ = Q,   G a + ε λ = γ + ε λ₀   (of an element with a force law: λ = F),

first from λ₀ = 0, then from the λ found: the method of multipliers, which after n rounds leaves an error
(ε/(ε + σ²))ⁿ where the rows resist with σ². What rows miss is then ε times the last change of λ, which tells
when to end: seldom after three. Positions need one round, as their residuals are small and looked at again;
so do velocities, beside which their corrections are small. Independent rows have a small compliance, which
where a mechanism passes a position in which they depend on each other lets go of them for a moment. Rows that
depend on others everywhere have as much as the bodies they hold: then they carry nothing and, because they
follow from the others, are kept all the same. For the reactions that are told all rows get the same small
compliance, which shares them among dependent rows by least norm.

On the constraints a state is put the shortest way by mass, as impulses of the joints would: near a position
in which rows become dependent corrections are large, and any other metric would change the motion that is
free.

Forces that follow reactions, such as friction of an ideal joint, are taken from the solution before, until
they no longer change. Where that does not settle soon, they take over a share of the change only, by the
last two changes r of all of them (Irons and Tuck), within bounds: ω ← −ω r₁·(r₂ − r₁)/|r₂ − r₁|².

One file because all of these steps share the factors of one linear system.
"""

import math
from typing import Annotated, Final

from mebdf.arrays import FloatArray, FloatCube
from mebdf.kernels.elementary import hypot
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import Signals
from tribodyn.kernels.jit import entry, inlined, kernel
from tribodyn.kernels.mechanism.bodies import collect, make_unit, move, own_force, place
from tribodyn.kernels.mechanism.constraints import fill_rates, fill_rows, prescribe
from tribodyn.kernels.mechanism.data import (
    ANGLE,
    COORDINATE,
    DIRECTION,
    NONE,
    PATH,
    REPORTS,
    WORK,
    CouplingNow,
    MechanismData,
    MechanismMemory,
    Now,
    Parts,
    Pattern,
)
from tribodyn.kernels.mechanism.equations import assemble, energy_of_motion, has_law, solve_near, solve_rows
from tribodyn.kernels.mechanism.forces import force
from tribodyn.kernels.mechanism.law import call_law, fill_law
from tribodyn.kernels.mechanism.relative import relative_position, relative_velocity, whole_angle

HARD: Final = 1.0e-8
SOFT: Final = 1.0  #: Compliances of rows, in units of the inverse mass that a row moves.
MOST_CORRECTIONS: Final = 6
MOST_ROUNDS: Final = 200  #: Rounds in which forces that follow reactions must settle,
PLAIN_ROUNDS: Final = 15  #: and those before they follow a share of the change.
LEAST_SHARE: Final = 0.1  #: A share below zero would find states that no compliance of bodies allows.
LARGEST_SHARE: Final = 4.0
SETTLED: Final = 1.0e-13  #: Relative change from which such forces have settled.
ROUNDED: Final = 1.0e-9  #: That up to which rounds that no longer reduce it differ by rounding, far away.
CLOSED: Final = 1.0e-14
"""Residual of constraints, relative to the size of the mechanism, that is none.

With 1e-12 mechanisms leave positions in which constraints degenerate along another branch.
"""
#: Residual, relative to the size, whose correction may turn shafts so far that whole turns count anew.
FAR: Final = 1.0e-3
EXACT: Final = 1.0e-14  #: Part of what the rows carry that their accelerations may miss.


@entry
def kinematics(parts: Parts, now: Now, signals: Signals, t: float) -> None:
    """Fill relative motion and rows of all couplings where the bodies are."""
    fill_positions(parts, now, signals, t)
    fill_velocities(parts, now)


@kernel
def fill_positions(parts: Parts, now: Now, signals: Signals, t: float) -> None:
    """Fill the quantities that velocities leave alone: displacements, rotations, rows without their rates."""
    within = min(max(t, now.course.begin), now.course.until)
    for k in range(parts.couplings.size):
        coupling, state = parts.couplings[k], now.couplings[k]
        relative_position(coupling, state, now.bodies)
        if coupling.n_terms > 0:
            prescribe(coupling, state, signals, t, within)
            fill_rows(coupling, state)
        if coupling.first_leg != NONE:
            now.couplings[coupling.first_leg].residual[0] += state.residual[0]


@kernel
def fill_velocities(parts: Parts, now: Now) -> None:
    """Fill the rest of the kinematics where positions are filled."""
    for k in range(parts.couplings.size):
        coupling, state = parts.couplings[k], now.couplings[k]
        relative_velocity(coupling, state, now.bodies)
        if coupling.n_terms > 0:
            fill_rates(coupling, state)
        if coupling.first_leg != NONE:
            first = now.couplings[coupling.first_leg]
            first.rate[0] += state.rate[0]
            first.gamma[0] += state.gamma[0]


@kernel
def forces(data: MechanismData, memory: MechanismMemory, t: float, mode: float) -> None:
    """Fill the forces of all couplings, and what else ``mode`` asks for, and sum them up at the bodies."""
    parts, now = data.parts, memory.now
    within = min(max(t, now.course.begin), now.course.until)
    for b in range(parts.bodies.size):
        own_force(parts.constants, parts.bodies[b], now.bodies[b], now.x[0, :3])
    for k in range(parts.couplings.size):
        force(data, memory, k, t, within, mode)
        coupling = parts.couplings[k]
        if coupling.socket < parts.bodies.size:
            _apply(now.couplings[k], 0, now.bodies[coupling.socket])
        if coupling.shaft < parts.bodies.size:
            _apply(now.couplings[k], 6, now.bodies[coupling.shaft])
        if has_law(coupling):
            fill_law(coupling, now.couplings[k], data.signals)


@kernel
def _apply(state: Record, first: int, body: Record) -> None:
    """Add six columns of H times the wrench of a coupling to the forces on a body."""
    for i in range(6):
        push = state.wrench[i]
        if push != 0.0:
            for j in range(6):
                body.force[j] += state.H[i, first + j] * push


@kernel
def _solve(
    parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray, forced: float, near: float, known: float
) -> None:
    """Solve; with the factors of a position close by, where ``near`` is 1, only if these do."""
    if (near == 1.0 or known > 0.0) and solve_near(parts, now, pattern, blocks, forced, known):
        return
    if near == 1.0:
        assemble(parts, now, pattern, blocks)
    solve_rows(parts, now, pattern, blocks, forced, EXACT)


@kernel
def take_accelerations(parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray, near: float) -> None:
    """Solve for accelerations and multipliers, and fill the constraint wrenches.

    The factors at hand are those of the position, or, where ``near`` is 1, of one close by.
    """
    for b in range(parts.bodies.size):
        for i in range(6):
            now.rest[b, i] = now.bodies[b].force[i]
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        for m in range(coupling.n_rows):
            now.rest[coupling.node, m] = now.couplings[k].gamma[m]
    _solve(parts, now, pattern, blocks, 1.0, near, 0.0)
    for k in range(parts.couplings.size):
        _take_multipliers(parts.couplings[k], now.couplings[k], now.x)
    if parts.constants.n_reactive > 0:
        _settle_reactive(parts, now, pattern, blocks, near)
    for b in range(parts.bodies.size):
        for i in range(6):
            now.bodies[b].acceleration[i] = now.x[b, i]


@kernel
def _settle_reactive(parts: Parts, now: Now, pattern: Pattern, blocks: FloatArray, near: float) -> None:
    """Solve again until forces that follow reactions no longer change; NaN where they never settle."""
    for k in range(parts.couplings.size):
        now.couplings[k].pushing = 0.0
    rounds, share, before = 0, 1.0, math.inf
    change = _add_reactive(parts, now, share)
    while change > SETTLED and not before <= change <= ROUNDED:
        rounds += 1
        if rounds > MOST_ROUNDS:
            now.x[0, 0] = math.nan
            break
        _solve(parts, now, pattern, blocks, 1.0, near, 0.0)
        for k in range(parts.couplings.size):
            _take_multipliers(parts.couplings[k], now.couplings[k], now.x)
        if rounds > PLAIN_ROUNDS:
            share = _share(parts, now, share)
        before, change = change, _add_reactive(parts, now, share)
    for k in range(parts.couplings.size):
        for i in range(3):
            now.couplings[k].constraint[i] += parts.couplings[k].push[i] * now.couplings[k].pushing


@kernel
def _follows(coupling: Record) -> bool:
    """Return whether forces of a coupling follow a reaction."""
    push = coupling.push
    follows: bool = coupling.load_of != NONE or push[0] != 0.0 or push[1] != 0.0 or push[2] != 0.0
    return follows


@kernel
def _reaction(parts: Parts, now: Now, number: int) -> float:
    """Return the size of the reaction that forces of a coupling follow."""
    followed = parts.couplings[number].load_of
    source = now.couplings[number if followed == NONE else followed]
    size = 0.0 if followed == NONE else hypot(source.constraint[0], source.constraint[1])
    if size == 0.0 and (followed == NONE or parts.couplings[followed].about != 0.0):
        size = abs(source.multiplier[0])  # also of a leg that applies a torque alone
    return size


@kernel
def _share(parts: Parts, now: Now, share: float) -> float:
    """Return the share of the changes of reactions that is to be taken over, after the last one."""
    along = square = 0.0
    for k in range(parts.couplings.size):
        if _follows(parts.couplings[k]):
            state = now.couplings[k]
            turn = _reaction(parts, now, k) - state.pushing - state.missed
            along, square = along + state.missed * turn, square + turn * turn
    return min(max(-share * along / square, LEAST_SHARE), LARGEST_SHARE) if square > 0.0 else share


@kernel
def _add_reactive(parts: Parts, now: Now, share: float) -> float:
    """Let forces follow a share of the change of reactions; return their largest change over the largest."""
    change = largest = 0.0
    for b in range(parts.bodies.size):
        for i in range(6):
            now.rest[b, i] = now.bodies[b].force[i]
    for k in range(parts.couplings.size):
        coupling, state = parts.couplings[k], now.couplings[k]
        if not _follows(coupling):
            continue
        size = _reaction(parts, now, k)
        state.missed = size - state.pushing
        change, largest = max(change, abs(state.missed)), max(largest, size)
        state.pushing = size if share == 1.0 else max(state.pushing + share * state.missed, 0.0)
        if coupling.load_of != NONE:
            state.law.followed = now.couplings[coupling.load_of].multiplier[0]
            state.law.normal = state.pushing
            if share != 1.0:
                state.law.table[0] = state.law.table[1] = 0.0  # no extrapolation of its own
            call_law(coupling, state)
        for i in range(3):
            for j in range(6 if coupling.push[i] != 0.0 else 0):
                if coupling.socket < parts.bodies.size:
                    now.rest[coupling.socket, j] += state.H[i, j] * coupling.push[i] * state.pushing
                if coupling.shaft < parts.bodies.size:
                    now.rest[coupling.shaft, j] += state.H[i, 6 + j] * coupling.push[i] * state.pushing
    return change / largest if largest > 0.0 else 0.0


@kernel
def _take_multipliers(coupling: Record, state: Record, x: FloatArray) -> None:
    """Fill multipliers and the wrench Nᵀ λ of a coupling."""
    for i in range(6):
        total = 0.0
        for m in range(coupling.n_terms):
            state.multiplier[m] = x[coupling.node, m]
            total += state.N[m, i] * state.multiplier[m]
        state.constraint[i] = total


@inlined
def accelerations(data: MechanismData, memory: MechanismMemory, t: float, y: FloatArray, mode: float) -> None:
    """Fill kinematics, forces, accelerations and multipliers at a state."""
    parts, now = data.parts, memory.now
    place(y, now.bodies)
    kinematics(parts, now, data.signals, t)
    forces(data, memory, t, mode)
    assemble(parts, now, data.mass, memory.blocks)
    take_accelerations(parts, now, data.mass, memory.blocks, 0.0)


@kernel
def largest_residual(parts: Parts, now: Now, unit: float) -> float:
    """Return the largest residual of the constraints, angles in radians and lengths in a ``unit`` [m]."""
    largest = 0.0
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        for m in range(coupling.n_rows):
            size = 1.0 if coupling.row_kind[m] in (DIRECTION, ANGLE) else unit
            largest = max(largest, abs(now.couplings[k].residual[m]) / size)
    return largest


@kernel
def _at_rest(parts: Parts, now: Now) -> None:
    """Clear the right-hand side of the bodies."""
    for b in range(parts.bodies.size):
        for i in range(6):
            now.rest[b, i] = 0.0


@kernel
def _gap(parts: Parts, now: Now) -> float:
    """Fill the right-hand side of a correction of positions; return the largest residual."""
    _at_rest(parts, now)
    for k in range(parts.couplings.size):
        coupling = parts.couplings[k]
        for m in range(coupling.n_rows):
            now.rest[coupling.node, m] = -now.couplings[k].residual[m]
    return largest_residual(parts, now, 1.0)


@entry
def mark_angles(couplings: Annotated[Record, CouplingNow, 1]) -> None:
    """Count whole turns from here."""
    for k in range(couplings.size):
        couplings[k].angle_mark = whole_angle(couplings[k])


@entry
def close(parts: Parts, now: Now, signals: Signals, pattern: Pattern, blocks: FloatCube, t: float) -> int:
    """Move the bodies onto the constraints, the shortest way by mass, and fill the positions there.

    Those of where the bodies are must have been filled. Return how many corrections it took; the factors are
    those of where the bodies were before the last one.
    """
    closed, corrections = CLOSED * parts.constants.extent, 0
    gap = _gap(parts, now)
    while corrections < MOST_CORRECTIONS and not gap <= closed:
        corrections += 1
        assemble(parts, now, pattern, blocks)
        solve_rows(parts, now, pattern, blocks, 0.0, min(0.1 * closed / gap, 0.1))
        for b in range(parts.bodies.size):
            move(now.bodies[b], now.x[b], now.rest[b, :4])
        fill_positions(parts, now, signals, t)
        if gap > FAR * parts.constants.extent:
            mark_angles(now.couplings)
        before = gap
        gap = _gap(parts, now)
        if not gap < 0.5 * before:
            break
    return corrections


@entry
def correct_velocities(parts: Parts, now: Now, pattern: Pattern, blocks: FloatCube, near: float) -> None:
    """Make velocities those that the constraints allow, by impulses, and fill the kinematics with them.

    The positions must have been filled. With ``near`` 1 the factors at hand are those of a position close by;
    with 0 the position is factorised.
    """
    if near == 0.0:
        assemble(parts, now, pattern, blocks)
    _at_rest(parts, now)
    for k in range(parts.couplings.size):
        if parts.couplings[k].node != NONE:
            _load_rates(parts, now, k)
    _solve(parts, now, pattern, blocks, 0.0, near, energy_of_motion(parts, now))
    for b in range(parts.bodies.size):
        body = now.bodies[b]
        for i in range(3):
            body.v[i] += now.x[b, i]
            body.w[i] += now.x[b, 3 + i]
    fill_velocities(parts, now)


@kernel
def _load_rates(parts: Parts, now: Now, number: int) -> None:
    """Fill the right-hand side with rates of rows that are to vanish; a later leg of an element adds its."""
    coupling, state = parts.couplings[number], now.couplings[number]
    rest = now.rest[coupling.node]
    for m in range(coupling.n_terms if coupling.law == 0 else 0):
        rate = state.at_rest[m]
        for side in range(2):
            body = now.bodies[coupling.socket if side == 0 else coupling.shaft]
            for i in range(3):
                rate += state.G[m, 6 * side + i] * body.v[i] + state.G[m, 6 * side + 3 + i] * body.w[i]
        rest[m] = -rate if coupling.first_leg == NONE else rest[m] - rate


@kernel
def _has_path(parts: Parts) -> bool:
    """Tell whether any row depends on the direction of a velocity."""
    for k in range(parts.couplings.size):
        if parts.couplings[k].n_terms > 0 and parts.couplings[k].row_kind[0] == PATH:
            return True
    return False


@inlined
def settle(data: MechanismData, memory: MechanismMemory, t: float, y: FloatArray) -> None:
    """Fill ``memory.settled`` with the state on the constraints next to ``y``, and all that holds there.

    Kinematics, forces, accelerations; and the reactions, of least norm where rows depend on each other.
    """
    parts, now, blocks, n_rows = data.parts, memory.now, memory.blocks, data.parts.constants.n_rows
    place(y, now.bodies)
    for b in range(parts.bodies.size):
        make_unit(now.bodies[b].p)
    fill_positions(parts, now, data.signals, t)
    near = 0.0
    if n_rows == 0:
        fill_velocities(parts, now)
    else:
        near = 1.0 if close(parts, now, data.signals, data.mass, blocks, t) == 1 else 0.0
        correct_velocities(parts, now, data.mass, blocks, near)
    collect(now.bodies, memory.settled)
    forces(data, memory, t, REPORTS)
    redundant = parts.constants.rank < n_rows
    if redundant:
        share(parts, now)
    if redundant or n_rows == 0 or _has_path(parts):
        # Otherwise the factors of the correction of velocities hold.
        assemble(parts, now, data.mass, blocks)
        near = 0.0
    take_accelerations(parts, now, data.mass, blocks, near)
    if redundant:
        set_compliance(parts, now)
    for k in range(parts.couplings.size):
        state = now.couplings[k]
        if parts.couplings[k].law == 0:
            for i in range(6):
                state.powers[WORK] += state.constraint[i] * state.twist[i]


@entry
def set_offsets(parts: Parts, now: Now) -> None:
    """Let the equations of all elements hold where the kinematics were filled: angles count from there."""
    for k in range(parts.couplings.size):
        coupling, state = parts.couplings[k], now.couplings[k]
        if coupling.n_rows > 0 and coupling.row_kind[0] == COORDINATE:
            state.offset += state.residual[0]


@kernel
def share(parts: Parts, now: Now) -> None:
    """Give all rows the compliance of independent ones: multipliers then are of least norm."""
    for k in range(parts.couplings.size):
        state = now.couplings[k]
        for m in range(parts.couplings[k].n_rows):
            state.compliance[m] = HARD * state.scale[m]


@entry
def set_compliance(parts: Parts, now: Now) -> None:
    """Give every row the compliance of an independent or a dependent one."""
    for k in range(parts.couplings.size):
        state = now.couplings[k]
        for m in range(parts.couplings[k].n_rows):
            state.compliance[m] = (SOFT if state.dependent[m] > 0.0 else HARD) * state.scale[m]
