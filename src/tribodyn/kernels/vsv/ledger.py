"""The two energy ledgers: rates at an instant, and their integrals along the motion.

Works and heats are integrated with Simpson's rule over every part of an accepted step, from forces
times velocities. Energies are functions of the state. What is left over measures the integration.

The clearance ledger follows the clearance motion alone, q̇ᵀ(N q̈ − Q), with N = Σ m_r δr δrᵀ and q̈
taken from the velocities of the numerical solution, not from the equations of motion.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import copy
from tribodyn.kernels.bushing import report as joint_report
from tribodyn.kernels.bushing.joint import report_and_slide
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.vsv.data import VsvData, VsvMemory
from tribodyn.kernels.vsv.equations import drive_moment, set_up, solve_accelerations
from tribodyn.kernels.vsv.layout import (
    BIAS,
    E_X,
    N_RATES,
    N_ROWS,
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

DRIVE, LOADS, FRICTION, COLLAR_FRICTION, COLLAR_TILT, DAMPING = 0, 1, 2, 3, 4, 5
"""Whole mechanism: work of the drive and of the air loads, of friction, of the collar; damping heat."""
CLEARANCE_LOADS, CLEARANCE_FRICTION, CLEARANCE_COLLAR, CLEARANCE_INERTIA = 6, 7, 8, 9
"""Clearance motion: work of everything but the joint, of joint friction, of the collar; inertia."""
N_INTEGRALS = N_RATES + 1

PEAK_FORCE, PEAK_FORCE_TIME, PEAK_PRESSURE, PEAK_PRESSURE_TIME = 0, 1, 2, 3
"""Largest contact force [N] and pressure [Pa] at any mark, and when [s]."""
LEAST_SEPARATION, LIFT_OFF = 4, 5
"""Smallest gap between mean planes [m]; time during which the collar carries nothing [s]."""
CLIPPED = 6
"""Time integral of the share of the contact area where the tensile clip acts [s]."""
N_EXTREMES = 7

KINETIC, GRAVITY = 0, 1


@kernel
def evaluate(
    data: VsvData, t: float, y: FloatArray, memory: VsvMemory, with_energy: bool, duration: float
) -> float:
    """Fill all scratch arrays of one instant, joint report included, and return F_cz [N].

    The pressure then is taken to slide for ``duration`` [s], with the speed |ω_v| r_j.
    """
    scratch = memory.scratch
    omega = set_up(data, t, y, memory)
    distance = duration * abs(scratch.motion[THETA_V, VELOCITY]) * data.joint.journal_radius
    out = scratch.report
    report_and_slide(
        data.joint,
        memory.entry_velocity,
        y,
        omega,
        -memory.regime[0],
        with_energy,
        out,
        distance,
        memory.sliding_load,
    )
    scratch.wrench[0] = out[joint_report.F_CX] + out[joint_report.F_FX]
    scratch.wrench[1] = out[joint_report.F_CY] + out[joint_report.F_FY]
    scratch.wrench[2] = out[joint_report.M_JCX] + out[joint_report.M_FX]
    scratch.wrench[3] = out[joint_report.M_JCY] + out[joint_report.M_FY]
    scratch.wrench[4] = out[joint_report.M_JF]
    return solve_accelerations(data, y, memory, 1)


@kernel
def clearance_velocity(motion: FloatArray, row: int, y: FloatArray) -> float:
    """Return the part of a row's velocity that the clearance motion makes."""
    return motion[row, 1] * y[4] + motion[row, 2] * y[5] + motion[row, 3] * y[6] + motion[row, 4] * y[7]


@kernel
def fill_rates(data: VsvData, y: FloatArray, memory: VsvMemory, f_cz: float) -> None:
    """Fill ``scratch.rates`` [W] and ``scratch.momentum`` from the scratch arrays of this instant."""
    scratch = memory.scratch
    motion, force, collar, rates = scratch.motion, scratch.force, scratch.collar, scratch.rates
    out = scratch.report
    omega_v = motion[THETA_V, VELOCITY]
    air_moment = force[THETA_V] - scratch.wrench[4]
    tilt_power = f_cz * (collar[PHI_X] * y[6] + collar[PHI_Y] * y[7])
    rates[DRIVE] = drive_moment(scratch) * motion[THETA_A, VELOCITY]
    rates[LOADS] = (
        force[OV_X] * motion[OV_X, VELOCITY] + force[OV_Y] * motion[OV_Y, VELOCITY] + air_moment * omega_v
    )
    rates[FRICTION] = out[joint_report.POWER_FRICTION]
    rates[COLLAR_FRICTION] = f_cz * collar[THETA_V] * omega_v
    rates[COLLAR_TILT] = tilt_power
    rates[DAMPING] = out[joint_report.HEAT_DAMPING]

    total = 0.0
    for j in range(4):
        scratch.momentum[j] = 0.0
    for row in range(N_ROWS):
        v = clearance_velocity(motion, row, y)
        inertia = data.inertia[row]
        if row < E_X:
            total += v * (force[row] - inertia * motion[row, BIAS])
        if inertia != 0.0:
            for j in range(4):
                scratch.momentum[j] += inertia * v * motion[row, 1 + j]
    omega_c = clearance_velocity(motion, THETA_V, y)
    rates[CLEARANCE_LOADS] = total - scratch.wrench[4] * omega_c
    rates[CLEARANCE_FRICTION] = (
        out[joint_report.F_FX] * y[4]
        + out[joint_report.F_FY] * y[5]
        + (1.0 + math.tan(y[2]) ** 2) * out[joint_report.M_FX] * y[6]
        + (1.0 + math.tan(y[3]) ** 2) * out[joint_report.M_FY] * y[7]
        + out[joint_report.M_JF] * omega_c
    )
    rates[CLEARANCE_COLLAR] = tilt_power + f_cz * collar[THETA_V] * omega_c


@kernel
def begin(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Set the mark at ``t``, from which :func:`add_part` goes on."""
    f_cz = evaluate(data, t, y, memory, False, 0.0)
    fill_rates(data, y, memory, f_cz)
    copy(memory.scratch.rates, memory.rates)
    copy(memory.scratch.momentum, memory.last_momentum)
    copy(y, memory.last_state)
    memory.last_time[0] = t


@kernel
def note_extremes(t: float, h: float, f_cz: float, memory: VsvMemory) -> None:
    """Keep the peaks at the end ``t`` of a part of length ``h`` [s]; output times would miss them."""
    extremes, out = memory.extremes, memory.scratch.report
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
def add_part(
    data: VsvData, t_a: float, t_b: float, y_m: FloatArray, y_b: FloatArray, memory: VsvMemory
) -> None:
    """Add the path integrals over ``[t_a, t_b]`` by Simpson's rule and move the mark to ``t_b``.

    The sliding load takes the middle of the part for all of it.
    """
    h = t_b - t_a
    y_a = memory.last_state
    integrals = memory.integrals
    inertia = 0.0
    for i in range(4):
        v_a, v_m, v_b = y_a[4 + i], y_m[4 + i], y_b[4 + i]
        inertia += memory.last_momentum[i] * (-3.0 * v_a + 4.0 * v_m - v_b)
    for k in range(N_RATES):
        integrals[k] += h / 6.0 * memory.rates[k]
    f_cz = evaluate(data, 0.5 * (t_a + t_b), y_m, memory, False, h)
    fill_rates(data, y_m, memory, f_cz)
    for i in range(4):
        inertia += 4.0 * memory.scratch.momentum[i] * (y_b[4 + i] - y_a[4 + i])
    for k in range(N_RATES):
        integrals[k] += h / 6.0 * 4.0 * memory.scratch.rates[k]
    f_cz = evaluate(data, t_b, y_b, memory, False, 0.0)
    fill_rates(data, y_b, memory, f_cz)
    note_extremes(t_b, h, f_cz, memory)
    for i in range(4):
        v_a, v_m, v_b = y_a[4 + i], y_m[4 + i], y_b[4 + i]
        inertia += memory.scratch.momentum[i] * (v_a - 4.0 * v_m + 3.0 * v_b)
    for k in range(N_RATES):
        integrals[k] += h / 6.0 * memory.scratch.rates[k]
    integrals[CLEARANCE_INERTIA] += inertia / 6.0
    copy(memory.scratch.rates, memory.rates)
    copy(memory.scratch.momentum, memory.last_momentum)
    copy(y_b, memory.last_state)
    memory.last_time[0] = t_b


@kernel
def fill_energies(data: VsvData, memory: VsvMemory, energies: FloatArray) -> None:
    """Fill kinetic and gravity energy [J] from the scratch arrays of this instant."""
    motion = memory.scratch.motion
    kinetic = 0.0
    for row in range(N_ROWS):
        kinetic += 0.5 * data.inertia[row] * motion[row, VELOCITY] ** 2
    gravity = 0.0
    for row in (O1_Z, O2_Z, O3_Z):
        gravity -= data.weight[row] * motion[row, VALUE]
    energies[KINETIC] = kinetic
    energies[GRAVITY] = gravity
