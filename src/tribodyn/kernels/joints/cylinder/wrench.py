"""Wrench of the bushing on the trunnion, with its derivatives in the same pass, Eqs. 44-45.

Normal pressure and friction together, see ``kernels/joints/pose.py`` for the components. Friction as a moment
acts about the axis alone and opposes the direction of the pose.

In one row of nodes everything depends on nine numbers: the offset (a, b) of the trunnion axis,
its velocity (v_a, v_b), the speed ω_z of its rotation, and its slope l with its rate, see ``nodes``. So the
derivatives are summed with respect to those nine and carried to the pose once a row. The lever arm of the
pressure is z − r_j w, that of the traction z.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.nodes import gather, lean, least_clearance, rewind, row_motion
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
        _add_nodes(joint, memory, pose.direction, lean(pose), n, out)
        n = gather(joint, memory, pose, 0.0)


@kernel
def _add_nodes(
    joint: BushingData,
    memory: JointMemory,
    direction: float,
    leaning: tuple[float, float, float, float],
    n: int,
    out: FloatArray,
) -> None:
    """Add the wrench of the ``n`` nodes in the list."""
    work, cubics = memory.scratch.listed.work, joint.table.cubics
    law = friction_law(joint, direction)
    v_min, clip, tangential = joint.minimum_entry_velocity, joint.clip, joint.tangential
    shift_a, shift_b = joint.journal_radius * leaning[0], joint.journal_radius * leaning[1]
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
        shifted = area * p * (shift_a * c + shift_b * s)
        f_x += area * push_x
        f_y += area * push_y
        m_x -= moment * push_y - shifted * s
        m_y += moment * push_x - shifted * c
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
    """Carry the gradient (5, 9) at one height to the derivative (6, 12).

    It is that of (f_x, f_y, τ, q_x, q_y) in (a, b, v_a, v_b, u) and the slope with its rate:
    M_x = −z f_y − q_y, M_y = z f_x + q_x and M_z = r τ.
    """
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    sec2_x, sec2_y = 1.0 + tan_x * tan_x, 1.0 + tan_y * tan_y
    columns = (D, D + 1, PHI, PHI + 1, V, V + 1, W, W + 1, W + 2)
    for k in range(5):
        g_a, g_b = area * gradient[k, 0], area * gradient[k, 1]
        g_va, g_vb = area * gradient[k, 2], area * gradient[k, 3]
        g_la, g_lb = z * g_a + area * gradient[k, 5], z * g_b + area * gradient[k, 6]
        g_vla, g_vlb = z * g_va + area * gradient[k, 7], z * g_vb + area * gradient[k, 8]
        d_phi_x = -sec2_x * (g_lb + 2.0 * pose.w_x * tan_x * g_vlb)
        d_phi_y = sec2_y * (g_la + 2.0 * pose.w_y * tan_y * g_vla)
        d_w_x, d_w_y, d_omega = -sec2_x * g_vlb, sec2_y * g_vla, area * gradient[k, 4]
        row = (g_a, g_b, d_phi_x, d_phi_y, g_va, g_vb, d_w_x, d_w_y, d_omega)
        for m in range(9):
            if k == 2:
                jacobian[M_Z, columns[m]] += radius * row[m]
            elif k == 3:
                jacobian[M_Y, columns[m]] += row[m]
            elif k == 4:
                jacobian[M_X, columns[m]] -= row[m]
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
    leaning, least = lean(pose), least_clearance(joint, pose)
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clear(jacobian)
    for k in range(6):
        out[k] = 0.0
    for j in range(joint.z.size):
        area, z = joint.area[j], joint.z[j]
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, z)
        first, count = contact_window(least, a, b, limit, n_theta)
        if area == 0.0 or count == 0:
            continue
        motion = (clearance, a, b, pose.v_opening, v_a, v_b, pose.w_z * joint.journal_radius)
        clear(gradient)
        until = min(first + count, n_theta)
        for start, stop in ((first, until), (0, first + count - until)):
            f_x, f_y, torque, q_x, q_y = _add_piece(
                joint, memory.entry_velocity, j, start, stop, motion, leaning, pose.direction, gradient
            )
            out[F_X] += area * f_x
            out[F_Y] += area * f_y
            out[M_X] -= area * (z * f_y + q_y)
            out[M_Y] += area * (z * f_x + q_x)
            out[M_Z] += area * joint.journal_radius * torque
        add_row(area, z, pose, joint.journal_radius, gradient, jacobian)


@kernel
def _add_piece(
    joint: BushingData,
    entry_velocity: FloatArray,
    row: int,
    first: int,
    until: int,
    motion: tuple[float, float, float, float, float, float, float],
    leaning: tuple[float, float, float, float],
    direction: float,
    gradient: FloatArray,
) -> tuple[float, float, float, float, float]:
    """Return (Σ f_x, Σ f_y, Σ τ, Σ q_x, Σ q_y) of nodes ``first`` to ``until`` of a row; add their gradient.

    ``motion`` holds the clearance, the offset of the axis in this row, the velocities of these, and the
    surface speed ω_z r_j; q = −r_j w P (cos θ, sin θ) is the second-order moment of the pressure.
    """
    clearance, a, b, v_opening, v_a, v_b, speed = motion
    cos, sin, wear = joint.cos_theta, joint.sin_theta, joint.wear
    law = friction_law(joint, direction)
    tangential, r_j = joint.tangential, joint.journal_radius
    l_a, l_b, v_la, v_lb = leaning
    f_x = f_y = torque = q_x = q_y = 0.0
    # Stiffness k = ∂P/∂h and damping d = ∂P/∂δ̇, summed with products of cos θ and sin θ.
    k_cc = k_cs = k_ss = d_cc = d_cs = d_ss = 0.0
    # The same for traction: κ = ∂τ/∂h, λ = −∂τ/∂δ̇, ρ = ∂τ/∂u.
    kappa_cc = kappa_cs = kappa_ss = kappa_c = kappa_s = 0.0
    lambda_cc = lambda_cs = lambda_ss = lambda_c = lambda_s = 0.0
    rho_cc = rho_cs = rho_ss = rho_c = rho_s = rho = 0.0
    # The same for the slope: ξ = ∂P/∂w, ζ = ∂P/∂ẇ.
    xi_cc = xi_cs = xi_ss = zeta_cc = zeta_cs = zeta_ss = 0.0
    xi_tcc = xi_tcs = xi_tss = xi_tc = xi_ts = zeta_tcc = zeta_tcs = zeta_tss = zeta_tc = zeta_ts = 0.0
    xi_wcc = xi_wcs = xi_wss = zeta_wcc = zeta_wcs = zeta_wss = 0.0
    k_wcc = k_wcs = k_wss = d_wcc = d_wcs = d_wss = 0.0
    j = np.uint64(row)
    for i in range(np.uint64(first), np.uint64(until)):
        c, s = cos[i], sin[i]
        w, v_w = l_a * c + l_b * s, v_la * c + v_lb * s
        arm = -r_j * w
        _, p, d_gap, d_approach = node_pressure(
            joint.table,
            joint.roughness,
            joint.minimum_entry_velocity,
            joint.clip,
            clearance + a * c + b * s + 0.5 * arm * w + wear[j, i],
            -(v_a * c + v_b * s + v_opening + arm * v_w),
            entry_velocity[j, i],
        )
        slip = speed + v_a * s - v_b * c
        ratio, d_ratio = ratio_at(law, slip)
        tau = ratio * p
        f_x += p * c + tangential * tau * s
        f_y += p * s - tangential * tau * c
        torque += tau
        q_x += arm * p * c
        q_y += arm * p * s
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
        xi, zeta = arm * d_gap + r_j * v_w * d_approach, -arm * d_approach
        xi_cc += xi * cc
        xi_cs += xi * cs
        xi_ss += xi * ss
        zeta_cc += zeta * cc
        zeta_cs += zeta * cs
        zeta_ss += zeta * ss
        xi_t, zeta_t = ratio * xi, ratio * zeta
        xi_tcc += xi_t * cc
        xi_tcs += xi_t * cs
        xi_tss += xi_t * ss
        xi_tc += xi_t * c
        xi_ts += xi_t * s
        zeta_tcc += zeta_t * cc
        zeta_tcs += zeta_t * cs
        zeta_tss += zeta_t * ss
        zeta_tc += zeta_t * c
        zeta_ts += zeta_t * s
        xi_w, zeta_w = arm * xi - r_j * p, arm * zeta
        xi_wcc += xi_w * cc
        xi_wcs += xi_w * cs
        xi_wss += xi_w * ss
        zeta_wcc += zeta_w * cc
        zeta_wcs += zeta_w * cs
        zeta_wss += zeta_w * ss
        k_w, d_w = arm * d_gap, arm * d_approach
        k_wcc += k_w * cc
        k_wcs += k_w * cs
        k_wss += k_w * ss
        d_wcc += d_w * cc
        d_wcs += d_w * cs
        d_wss += d_w * ss
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
    gradient[0, 5] += xi_cc + tangential * xi_tcs
    gradient[0, 6] += xi_cs + tangential * xi_tss
    gradient[0, 7] += zeta_cc + tangential * zeta_tcs
    gradient[0, 8] += zeta_cs + tangential * zeta_tss
    gradient[1, 5] += xi_cs - tangential * xi_tcc
    gradient[1, 6] += xi_ss - tangential * xi_tcs
    gradient[1, 7] += zeta_cs - tangential * zeta_tcc
    gradient[1, 8] += zeta_ss - tangential * zeta_tcs
    gradient[2, 5] += xi_tc
    gradient[2, 6] += xi_ts
    gradient[2, 7] += zeta_tc
    gradient[2, 8] += zeta_ts
    gradient[3, 0] += k_wcc
    gradient[3, 1] += k_wcs
    gradient[3, 2] -= d_wcc
    gradient[3, 3] -= d_wcs
    gradient[3, 5] += xi_wcc
    gradient[3, 6] += xi_wcs
    gradient[3, 7] += zeta_wcc
    gradient[3, 8] += zeta_wcs
    gradient[4, 0] += k_wcs
    gradient[4, 1] += k_wss
    gradient[4, 2] -= d_wcs
    gradient[4, 3] -= d_wss
    gradient[4, 5] += xi_wcs
    gradient[4, 6] += xi_wss
    gradient[4, 7] += zeta_wcs
    gradient[4, 8] += zeta_wss
    return f_x, f_y, torque, q_x, q_y
