"""The two energy ledgers: rates at an instant, and their integrals along the motion.

Works and heats are integrated over every part of an accepted step with one evaluation at its end. Energies
are functions of the state. What is left over measures the integration.

The clearance ledger follows the clearance motion alone, q̇ᵀ(N q̈ − Q), with N = Σ m_r δr δrᵀ and q̈
taken from the velocities of the numerical solution, not from the equations of motion: over a part inertia
takes in ½ (p_a + p_b)·(q̇_b − q̇_a), p = N q̇, which is exact where N does not change. Its works are
integrals of forces over displacements, which oscillate between impacts where the forces hardly do.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import copy
from tribodyn.kernels.bushing import report as joint_report
from tribodyn.kernels.bushing.joint import report, slide
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.vsv.books import (
    CLIPPED,
    COLLAR,
    COLLAR_FRICTION,
    COLLAR_TILT,
    DAMPING,
    DRIVE,
    EARLIER,
    FRICTION,
    INERTIA,
    JOINT_FRICTION,
    LEAST_SEPARATION,
    LIFT_OFF,
    LOADS,
    OTHERS,
    PEAK_FORCE,
    PEAK_FORCE_TIME,
    PEAK_PRESSURE,
    PEAK_PRESSURE_TIME,
    SPEED,
    TIME,
)
from tribodyn.kernels.vsv.data import Mechanism, Scratch, VsvData, VsvMemory
from tribodyn.kernels.vsv.equations import drive_moment, set_up, solve_accelerations
from tribodyn.kernels.vsv.layout import (
    BIAS,
    E_X,
    N_BODY,
    N_RATES,
    N_WORKS,
    O1_Z,
    O2_Z,
    O3_Z,
    OV_X,
    OV_Y,
    PHI_X,
    PHI_Y,
    THETA_A,
    THETA_V,
    VALUE,
    VELOCITY,
)

NEAR = 0.2
"""Marks closer than this part of the next interval do not tell how the rates bend."""

KINETIC, GRAVITY = 0, 1


@kernel
def evaluate(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> float:
    """Fill all scratch arrays of one instant, joint report included, and return F_cz [N]."""
    scratch = memory.scratch
    omega = set_up(data.mechanism, t, y, memory)
    out = scratch.report
    report(data.joint, memory.entry_velocity, y, omega, -memory.regime[0], out)
    scratch.wrench[0] = out[joint_report.F_CX] + out[joint_report.F_FX]
    scratch.wrench[1] = out[joint_report.F_CY] + out[joint_report.F_FY]
    scratch.wrench[2] = out[joint_report.M_JCX] + out[joint_report.M_FX]
    scratch.wrench[3] = out[joint_report.M_JCY] + out[joint_report.M_FY]
    scratch.wrench[4] = out[joint_report.M_JF]
    return solve_accelerations(data.mechanism, y, memory)


@kernel
def clearance_velocity(motion: FloatArray, row: int, y: FloatArray) -> float:
    """Return the part of a row's velocity that the clearance motion makes."""
    return motion[row, 1] * y[4] + motion[row, 2] * y[5] + motion[row, 3] * y[6] + motion[row, 4] * y[7]


@kernel
def fill_rates(y: FloatArray, memory: VsvMemory) -> None:
    """Fill ``scratch.rates`` [W] from the scratch arrays of this instant."""
    scratch = memory.scratch
    motion, force, collar, rates = scratch.motion, scratch.force, scratch.collar, scratch.rates
    omega_v, f_cz = motion[THETA_V, VELOCITY], scratch.f_cz
    air_moment = force[THETA_V] - scratch.wrench[4]
    rates[DRIVE] = drive_moment(scratch) * motion[THETA_A, VELOCITY]
    rates[LOADS] = (
        force[OV_X] * motion[OV_X, VELOCITY] + force[OV_Y] * motion[OV_Y, VELOCITY] + air_moment * omega_v
    )
    rates[FRICTION] = scratch.report[joint_report.POWER_FRICTION]
    rates[COLLAR_FRICTION] = f_cz * collar[THETA_V] * omega_v
    rates[COLLAR_TILT] = f_cz * (collar[PHI_X] * y[6] + collar[PHI_Y] * y[7])


@kernel
def fill_clearance_forces(mechanism: Mechanism, y: FloatArray, memory: VsvMemory) -> None:
    """Fill ``scratch.forces`` (N_WORKS, 4) on the clearance coordinates and ``scratch.momentum``."""
    scratch = memory.scratch
    motion, forces, out = scratch.motion, scratch.forces, scratch.report
    sec2_x, sec2_y = 1.0 + math.tan(y[2]) ** 2, 1.0 + math.tan(y[3]) ** 2
    forces[DAMPING, 0] = out[joint_report.F_KX] - out[joint_report.F_CX]
    forces[DAMPING, 1] = out[joint_report.F_KY] - out[joint_report.F_CY]
    forces[DAMPING, 2] = sec2_x * (out[joint_report.M_KX] - out[joint_report.M_JCX])
    forces[DAMPING, 3] = sec2_y * (out[joint_report.M_KY] - out[joint_report.M_JCY])
    forces[JOINT_FRICTION, 0] = out[joint_report.F_FX]
    forces[JOINT_FRICTION, 1] = out[joint_report.F_FY]
    forces[JOINT_FRICTION, 2] = sec2_x * out[joint_report.M_FX]
    forces[JOINT_FRICTION, 3] = sec2_y * out[joint_report.M_FY]
    for j in range(4):
        turning = motion[THETA_V, 1 + j]
        forces[JOINT_FRICTION, j] += out[joint_report.M_JF] * turning
        forces[OTHERS, j] = -scratch.wrench[4] * turning
        forces[COLLAR, j] = scratch.f_cz * scratch.collar[THETA_V] * turning
        scratch.momentum[j] = 0.0
    forces[COLLAR, 2] += scratch.f_cz * scratch.collar[PHI_X]
    forces[COLLAR, 3] += scratch.f_cz * scratch.collar[PHI_Y]
    for row in range(N_BODY):
        inertia = mechanism.inertia[row]
        applied = scratch.force[row] - inertia * motion[row, BIAS] if row < E_X else 0.0
        momentum = inertia * clearance_velocity(motion, row, y)
        for j in range(4):
            forces[OTHERS, j] += applied * motion[row, 1 + j]
            scratch.momentum[j] += momentum * motion[row, 1 + j]


@kernel
def begin(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Set the mark at ``t``, from which :func:`add_part` goes on."""
    _evaluate_mark(data, t, y, memory)
    _set_mark(data, t, y, memory)
    memory.books.mark[EARLIER] = t


@kernel
def _evaluate_mark(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Fill the scratch arrays of one instant, rates and forces included."""
    scratch = memory.scratch
    scratch.f_cz = evaluate(data, t, y, memory)
    fill_rates(y, memory)
    fill_clearance_forces(data.mechanism, y, memory)
    scratch.marked = 1.0


@kernel
def is_at_mark(t: float, y: FloatArray, memory: VsvMemory) -> bool:
    """Tell whether the scratch arrays hold the evaluation of this instant that the ledger made."""
    same = memory.scratch.marked > 0.0 and memory.books.mark[TIME] == t
    for i in range(8):
        same = same and memory.books.last_state[i] == y[i]
    return same


@kernel
def _set_mark(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Take over what the scratch arrays hold as the values at the mark."""
    scratch, mark = memory.scratch, memory.books.mark
    copy(scratch.rates, memory.books.rates[0])
    for k in range(N_WORKS):
        copy(scratch.forces[k], memory.books.forces[0, k])
    copy(scratch.momentum, memory.books.last_momentum)
    copy(y, memory.books.last_state)
    mark[TIME] = t
    mark[SPEED] = abs(scratch.motion[THETA_V, VELOCITY]) * data.joint.journal_radius


@kernel
def note_extremes(t: float, h: float, f_cz: float, memory: VsvMemory) -> None:
    """Keep the peaks at the end ``t`` of a part of length ``h`` [s]; output times would miss them."""
    extremes, out = memory.books.extremes, memory.scratch.report
    force = math.hypot(out[joint_report.F_CX], out[joint_report.F_CY])
    if force > extremes[PEAK_FORCE]:
        extremes[PEAK_FORCE], extremes[PEAK_FORCE_TIME] = force, t
    if out[joint_report.P_MAX] > extremes[PEAK_PRESSURE]:
        extremes[PEAK_PRESSURE], extremes[PEAK_PRESSURE_TIME] = out[joint_report.P_MAX], t
    extremes[LEAST_SEPARATION] = min(extremes[LEAST_SEPARATION], out[joint_report.SEPARATION_MIN])
    if f_cz == 0.0:
        extremes[LIFT_OFF] += h
    extremes[CLIPPED] += h * out[joint_report.CLIPPED]


@kernel
def add_part(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Add the path integrals from the mark to ``t`` and move the mark there."""
    mark, scratch = memory.books.mark, memory.scratch
    h = t - mark[TIME]
    slide(data.joint, 0.5 * h * mark[SPEED], memory.sliding_load)
    _evaluate_mark(data, t, y, memory)
    note_extremes(t, h, scratch.f_cz, memory)
    _integrate(h, y, memory)
    _set_mark(data, t, y, memory)
    slide(data.joint, 0.5 * h * mark[SPEED], memory.sliding_load)


@kernel
def _integrate(h: float, y: FloatArray, memory: VsvMemory) -> None:
    """Add the works of a part of length ``h`` [s] that ends at ``y``.

    Rates and forces are the parabolas through three marks: the earliest is the one before the last, or one
    before that where marks are close together. Where it is too near for its parabola to be trusted, as after
    a restart, the straight line through the last two is taken.
    """
    mark = memory.books.mark
    back = mark[TIME] - mark[EARLIER]
    known = back > NEAR * h
    _integrate_rates(h, back, known, memory)
    _integrate_works(h, back, known, y, memory)
    if h > NEAR * back:
        copy(memory.books.rates[0], memory.books.rates[1])
        for k in range(N_WORKS):
            copy(memory.books.forces[0, k], memory.books.forces[1, k])
        mark[EARLIER] = mark[TIME]


@kernel
def _bend(now: float, last: float, earlier: float, h: float, back: float, known: bool) -> float:
    """Return half the second derivative of the parabola through three values, times h²; 0 if not known."""
    return h * (now - last - h / back * (last - earlier)) / (h + back) if known else 0.0


@kernel
def _integrate_rates(h: float, back: float, known: bool, memory: VsvMemory) -> None:
    """Add ∫ f dt = h (f_a + f_b)/2 − h b/6 of the parabola with the bend b."""
    now, rates = memory.scratch.rates, memory.books.rates
    for k in range(N_RATES):
        bend = _bend(now[k], rates[0, k], rates[1, k], h, back, known)
        memory.books.integrals[k] += h * (0.5 * (now[k] + rates[0, k]) - bend / 6.0)


@kernel
def _integrate_works(h: float, back: float, known: bool, y: FloatArray, memory: VsvMemory) -> None:
    """Add ∫ F dq of the parabola F and the cubic Hermite polynomial q, and what inertia takes in.

    With Δq = q_b − q_a and the bend b of the force that is Δq (F_a + F_b)/2 + h ΔF Δq̇/12 −
    b (Δq/5 − h (q̇_a + q̇_b)/60): exact for a constant force, whatever oscillates.
    """
    now, forces, before = memory.scratch.forces, memory.books.forces, memory.books.last_state
    for i in range(4):
        way, change = y[i] - before[i], y[4 + i] - before[4 + i]
        curved = 0.2 * way - h / 60.0 * (y[4 + i] + before[4 + i])
        for k in range(N_WORKS):
            last = forces[0, k, i]
            bend = _bend(now[k, i], last, forces[1, k, i], h, back, known)
            work = 0.5 * way * (now[k, i] + last) + h / 12.0 * change * (now[k, i] - last) - bend * curved
            memory.books.integrals[N_RATES + k] += work
        momentum = 0.5 * (memory.books.last_momentum[i] + memory.scratch.momentum[i])
        memory.books.integrals[INERTIA] += momentum * change


@kernel
def fill_energies(mechanism: Mechanism, scratch: Scratch, energies: FloatArray) -> None:
    """Fill kinetic and gravity energy [J] from the scratch arrays of this instant."""
    motion = scratch.motion
    kinetic = 0.0
    for row in range(N_BODY):
        kinetic += 0.5 * mechanism.inertia[row] * motion[row, VELOCITY] ** 2
    gravity = 0.0
    for row in (O1_Z, O2_Z, O3_Z):
        gravity -= mechanism.weight[row] * motion[row, VALUE]
    energies[KINETIC] = kinetic
    energies[GRAVITY] = gravity
