"""Wrench of the bushing on the trunnion, with its derivatives in the same pass, Eqs. 44-45.

Normal pressure and friction together, see ``kernels/joints/pose.py`` for the components. Friction as a moment
acts about the axis alone and opposes the direction of the pose.

In one row of nodes everything depends on five numbers: the offset (a, b) of the trunnion axis,
its velocity (v_a, v_b) and the speed ω_z of its rotation. So the derivatives are summed with respect to those
five and carried to the pose once a row.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined, kernel, summing
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.nodes import gather, rewind, row_motion
from tribodyn.kernels.joints.cylinder.window import contact_window
from tribodyn.kernels.joints.listed import (
    APPROACH,
    AREA,
    COS,
    ENTRY,
    FRACTION,
    INTERVAL,
    MOMENT,
    PART,
    SIN,
    SLIP,
)
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.pose import F_X, F_Y, M_X, M_Y, M_Z, PHI, D, V, W
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity, total_pressure
from tribodyn.kernels.lookup import cubic, offset

LEAST_SQUARE: Final = 1.0e-300
"""What stands for a squared slip velocity of zero, which a friction moment may have."""


@inlined
def friction_law(joint: BushingData, direction: float) -> tuple[float, float, float]:
    """Return (r, κ, u_s²) of the friction ratio τ/P_c = r − κ u/√(u² + u_s²).

    Traction: κ = μ_f, r = 0. Friction moment: κ = 0, r = s' μ_f r_b/r_j, so that both give their
    moment with the arm r_j; s' of Eq. 45 is minus the direction of rotation.
    """
    steady = -(1.0 - joint.tangential) * direction * joint.friction_coefficient
    steady *= joint.bore_radius / joint.journal_radius
    steepness = joint.tangential * joint.friction_coefficient
    return steady, steepness, max(joint.slip_velocity * joint.slip_velocity, LEAST_SQUARE)


@inlined
def ratio_at(law: tuple[float, float, float], slip: float) -> tuple[float, float]:
    """Return friction per normal pressure and its derivative with respect to slip [s/m]."""
    steady, steepness, square = law
    norm_square = slip * slip + square
    slope = steepness / math.sqrt(norm_square)
    return steady - slope * slip, -slope * square / norm_square


@inlined
def friction_ratio(joint: BushingData, slip: float, direction: float) -> tuple[float, float]:
    """Return the same for a single point."""
    return ratio_at(friction_law(joint, direction), slip)


@kernel
def wrench(joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray) -> None:
    """Fill ``out`` with the wrench.

    Parameters
    ----------
    joint
        Constants of the joint.
    memory
        Its memory, whose scratch alone is changed.
    pose
        Where the trunnion is and how it moves, see ``kernels/joints/pose.py``.
    out
        The wrench [N, N m], shape (6,).
    """
    for k in range(6):
        out[k] = 0.0
    rewind(memory)
    n = gather(joint, memory, pose, 0.0)
    while n > 0:
        _add_nodes(joint, memory, pose.direction, n, out)
        n = gather(joint, memory, pose, 0.0)


@summing
def _add_nodes(joint: BushingData, memory: JointMemory, direction: float, n: int, out: FloatArray) -> None:
    """Add the wrench of the ``n`` nodes in the list."""
    work, cubics = memory.scratch.listed.work, joint.table.cubics
    law = friction_law(joint, direction)
    v_min, clip, tangential = joint.minimum_entry_velocity, joint.clip, joint.tangential
    f_x = f_y = m_x = m_y = torque = 0.0
    for k in range(min(n, PART)):
        first, x = offset(work[INTERVAL + k]), work[FRACTION + k]
        approach, slip = work[APPROACH + k], work[SLIP + k]
        c, s = work[COS + k], work[SIN + k]
        area, moment = work[AREA + k], work[MOMENT + k]
        reference = reference_velocity(work[ENTRY + k], approach, v_min)
        rigid, damping = cubic(cubics, first, x), cubic(cubics, first + np.uint64(4), x)
        p = total_pressure(rigid, damping, approach / reference, clip)
        ratio, _ = ratio_at(law, slip)
        tau = ratio * p
        push_x, push_y = p * c + tangential * tau * s, p * s - tangential * tau * c
        f_x += area * push_x
        f_y += area * push_y
        m_x -= moment * push_y
        m_y += moment * push_x
        torque += area * tau
    out[F_X] += f_x
    out[F_Y] += f_y
    out[M_X] += m_x
    out[M_Y] += m_y
    out[M_Z] += joint.journal_radius * torque


@kernel
def add_row(
    area: float, z: float, pose: Record, radius: float, gradient: FloatArray, jacobian: FloatArray
) -> None:
    """Carry the gradient of (f_x, f_y, τ) in (a, b, v_a, v_b, u) at one height to the derivative (6, 12).

    M_x = −z F_y, M_y = z F_x and M_z = r τ.
    """
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    sec2_x, sec2_y = 1.0 + tan_x * tan_x, 1.0 + tan_y * tan_y
    columns = (D, D + 1, PHI, PHI + 1, V, V + 1, W, W + 1, W + 2)
    for k in range(3):
        g_a, g_b = area * gradient[k, 0], area * gradient[k, 1]
        g_va, g_vb = area * gradient[k, 2], area * gradient[k, 3]
        d_phi_x = -z * sec2_x * (g_b + 2.0 * pose.w_x * tan_x * g_vb)
        d_phi_y = z * sec2_y * (g_a + 2.0 * pose.w_y * tan_y * g_va)
        d_w_x, d_w_y, d_omega = -z * sec2_x * g_vb, z * sec2_y * g_va, area * gradient[k, 4]
        row = (g_a, g_b, d_phi_x, d_phi_y, g_va, g_vb, d_w_x, d_w_y, d_omega)
        for m in range(9):
            if k == 2:
                jacobian[M_Z, columns[m]] += radius * row[m]
            elif k == 1:
                jacobian[F_Y, columns[m]] += row[m]
                jacobian[M_X, columns[m]] -= z * row[m]
            else:
                jacobian[F_X, columns[m]] += row[m]
                jacobian[M_Y, columns[m]] += z * row[m]


@kernel
def wrench_and_jacobian(
    joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray, jacobian: FloatArray
) -> None:
    """Fill ``out`` with the wrench and ``jacobian`` with its derivatives.

    Parameters
    ----------
    joint, memory, pose, out
        As for :func:`wrench`.
    jacobian
        Its derivatives in displacement, tilt, velocity and rates of turning, shape (6, 12).
    """
    n_theta, gradient = joint.cos_theta.size, memory.scratch.gradient
    limit, clearance = joint.table.h_last * joint.roughness, joint.clearance + pose.opening
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clear(jacobian)
    for k in range(6):
        out[k] = 0.0
    for j in range(joint.z.size):
        area, z = joint.area[j], joint.z[j]
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, z)
        first, count = contact_window(clearance, a, b, limit, n_theta)
        if area == 0.0 or count == 0:
            continue
        motion = (clearance, a, b, pose.v_opening, v_a, v_b, pose.w_z * joint.journal_radius)
        clear(gradient)
        until = min(first + count, n_theta)
        for start, stop in ((first, until), (0, first + count - until)):
            f_x, f_y, torque = _add_piece(
                joint, memory.entry_velocity, j, start, stop, motion, pose.direction, gradient
            )
            out[F_X] += area * f_x
            out[F_Y] += area * f_y
            out[M_X] -= area * z * f_y
            out[M_Y] += area * z * f_x
            out[M_Z] += area * joint.journal_radius * torque
        add_row(area, z, pose, joint.journal_radius, gradient, jacobian)


@summing
def _add_piece(
    joint: BushingData,
    entry_velocity: FloatArray,
    row: int,
    first: int,
    until: int,
    motion: tuple[float, float, float, float, float, float, float],
    direction: float,
    gradient: FloatArray,
) -> tuple[float, float, float]:
    """Return (Σ f_x, Σ f_y, Σ τ) of nodes ``first`` to ``until`` of a row and add their gradient.

    ``motion`` holds the clearance, the offset of the axis in this row, the velocities of these, and the
    surface speed ω_z r_j.
    """
    clearance, a, b, v_opening, v_a, v_b, speed = motion
    cos, sin, wear = joint.cos_theta, joint.sin_theta, joint.wear
    law = friction_law(joint, direction)
    tangential, r_j = joint.tangential, joint.journal_radius
    f_x = f_y = torque = 0.0
    # Stiffness k = ∂P/∂h and damping d = ∂P/∂δ̇, summed with products of cos θ and sin θ.
    k_cc = k_cs = k_ss = d_cc = d_cs = d_ss = 0.0
    # The same for traction: κ = ∂τ/∂h, λ = −∂τ/∂δ̇, ρ = ∂τ/∂u.
    kappa_cc = kappa_cs = kappa_ss = kappa_c = kappa_s = 0.0
    lambda_cc = lambda_cs = lambda_ss = lambda_c = lambda_s = 0.0
    rho_cc = rho_cs = rho_ss = rho_c = rho_s = rho = 0.0
    j = np.uint64(row)
    for i in range(np.uint64(first), np.uint64(until)):
        c, s = cos[i], sin[i]
        _, p, d_gap, d_approach = node_pressure(
            joint.table,
            joint.roughness,
            joint.minimum_entry_velocity,
            joint.clip,
            clearance + a * c + b * s + wear[j, i],
            -(v_a * c + v_b * s + v_opening),
            entry_velocity[j, i],
        )
        slip = speed + v_a * s - v_b * c
        ratio, d_ratio = ratio_at(law, slip)
        tau = ratio * p
        f_x += p * c + tangential * tau * s
        f_y += p * s - tangential * tau * c
        torque += tau
        cc, cs, ss = c * c, c * s, s * s
        k_cc += d_gap * cc
        k_cs += d_gap * cs
        k_ss += d_gap * ss
        d_cc += d_approach * cc
        d_cs += d_approach * cs
        d_ss += d_approach * ss
        kappa = ratio * d_gap
        kappa_cc += kappa * cc
        kappa_cs += kappa * cs
        kappa_ss += kappa * ss
        kappa_c += kappa * c
        kappa_s += kappa * s
        lam = -ratio * d_approach
        lambda_cc += lam * cc
        lambda_cs += lam * cs
        lambda_ss += lam * ss
        lambda_c += lam * c
        lambda_s += lam * s
        slope = d_ratio * p
        rho_cc += slope * cc
        rho_cs += slope * cs
        rho_ss += slope * ss
        rho_c += slope * c
        rho_s += slope * s
        rho += slope
    gradient[0, 0] += k_cc + tangential * kappa_cs
    gradient[0, 1] += k_cs + tangential * kappa_ss
    gradient[0, 2] += -d_cc + tangential * (lambda_cs + rho_ss)
    gradient[0, 3] += -d_cs + tangential * (lambda_ss - rho_cs)
    gradient[0, 4] += tangential * r_j * rho_s
    gradient[1, 0] += k_cs - tangential * kappa_cc
    gradient[1, 1] += k_ss - tangential * kappa_cs
    gradient[1, 2] += -d_cs - tangential * (lambda_cc + rho_cs)
    gradient[1, 3] += -d_ss - tangential * (lambda_cs - rho_cc)
    gradient[1, 4] += -tangential * r_j * rho_c
    gradient[2, 0] += kappa_c
    gradient[2, 1] += kappa_s
    gradient[2, 2] += lambda_c + rho_s
    gradient[2, 3] += lambda_s - rho_c
    gradient[2, 4] += r_j * rho
    return f_x, f_y, torque
