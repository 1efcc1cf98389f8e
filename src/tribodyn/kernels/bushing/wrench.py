"""Wrench of the bushing on the trunnion, with its derivatives in the same pass, Eqs. 44-45.

The wrench is (F_x, F_y, M_x, M_y, M_z): normal pressure and friction together, M_x right-handed,
M_y left-handed, M_z about the trunnion axis. Its nine arguments are the eight states
(e_x, e_y, φ_x, φ_y and their rates) and the vane speed ω_v, which traction depends on.

In one row of nodes everything depends on five numbers: the offset (a, b) of the trunnion axis,
its velocity (v_a, v_b) and ω_v. So the derivatives are summed with respect to those five and
carried to the nine arguments once a row.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.nodes import (
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
    gather,
    rewind,
    row_motion,
)
from tribodyn.kernels.bushing.pressure import node_pressure, reference_velocity, total_pressure
from tribodyn.kernels.bushing.window import contact_window
from tribodyn.kernels.jit import inlined, kernel, summing
from tribodyn.kernels.lookup import cubic, offset

LEAST_SQUARE: Final = 1.0e-300
"""What stands for a squared slip velocity of zero, which a friction moment may have."""


@inlined
def friction_law(joint: BushingData, sign: float) -> tuple[float, float, float]:
    """Return (r, κ, u_s²) of the friction ratio τ/P_c = r − κ u/√(u² + u_s²).

    Traction: κ = μ_f, r = 0. Friction moment: κ = 0, r = s' μ_f r_b/r_j, so that both give their
    moment with the arm r_j.
    """
    steady = (1.0 - joint.tangential) * sign * joint.friction_coefficient
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
def friction_ratio(joint: BushingData, slip: float, sign: float) -> tuple[float, float]:
    """Return the same for a single point."""
    return ratio_at(friction_law(joint, sign), slip)


@kernel
def wrench(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` with the wrench.

    Parameters
    ----------
    joint
        Constants of the joint.
    entry_velocity
        Remembered δ̇₋ [m/s], shape (n_z + 2, n_theta), 0 where there is none.
    y
        The eight states, shape (8,).
    omega
        Vane speed ω_v [rad/s].
    sign
        s' of Eq. 45, −1 when the ideal vane speed is positive; used by the friction moment only.
    out
        (F_x, F_y, M_x, M_y, M_z) [N, N m], shape (5,).
    """
    for k in range(5):
        out[k] = 0.0
    rewind(joint)
    n = gather(joint, entry_velocity, y, omega, 0.0)
    while n > 0:
        _add_nodes(joint, sign, n, out)
        n = gather(joint, entry_velocity, y, omega, 0.0)


@summing
def _add_nodes(joint: BushingData, sign: float, n: int, out: FloatArray) -> None:
    """Add the wrench of the ``n`` nodes in the list."""
    work, cubics = joint.listed.work, joint.table.cubics
    law = friction_law(joint, sign)
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
        m_y -= moment * push_x
        torque += area * tau
    out[0] += f_x
    out[1] += f_y
    out[2] += m_x
    out[3] += m_y
    out[4] += joint.journal_radius * torque


@kernel
def _add_row(
    area: float, z: float, y: FloatArray, radius: float, gradient: FloatArray, jacobian: FloatArray
) -> None:
    """Carry the gradient of (f_x, f_y, τ) in (a, b, v_a, v_b, ω) of one row to the nine arguments."""
    tan_x = math.tan(y[2])
    tan_y = math.tan(y[3])
    sec2_x = 1.0 + tan_x * tan_x
    sec2_y = 1.0 + tan_y * tan_y
    for k in range(3):
        g_a = area * gradient[k, 0]
        g_b = area * gradient[k, 1]
        g_va = area * gradient[k, 2]
        g_vb = area * gradient[k, 3]
        d_phi_x = -z * sec2_x * (g_b + 2.0 * y[6] * tan_x * g_vb)
        d_phi_y = -z * sec2_y * (g_a + 2.0 * y[7] * tan_y * g_va)
        row = (g_a, g_b, d_phi_x, d_phi_y, g_va, g_vb, -z * sec2_x * g_vb, -z * sec2_y * g_va)
        for m in range(8):
            if k == 2:
                jacobian[4, m] += radius * row[m]
            else:
                jacobian[k, m] += row[m]
                jacobian[3 - k, m] -= z * row[m]
        d_omega = area * gradient[k, 4]
        if k == 2:
            jacobian[4, 8] += radius * d_omega
        else:
            jacobian[k, 8] += d_omega
            jacobian[3 - k, 8] -= z * d_omega


@kernel
def wrench_and_jacobian(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
    jacobian: FloatArray,
    gradient: FloatArray,
) -> None:
    """Fill ``out`` with the wrench and ``jacobian`` with its derivatives.

    Parameters
    ----------
    joint, entry_velocity, y, omega, sign, out
        As for :func:`wrench`.
    jacobian
        ∂(F_x, F_y, M_x, M_y, M_z)/∂(e_x, e_y, φ_x, φ_y, ė_x, ė_y, φ̇_x, φ̇_y, ω_v), shape (5, 9).
    gradient
        Scratch, shape (3, 5).
    """
    n_theta = joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    clear(jacobian)
    for k in range(5):
        out[k] = 0.0
    for j in range(joint.z.size):
        area, z = joint.area[j], joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        first, count = contact_window(joint.clearance, a, b, limit, n_theta)
        if area == 0.0 or count == 0:
            continue
        motion = (a, b, v_a, v_b, omega * joint.journal_radius)
        clear(gradient)
        until = min(first + count, n_theta)
        for start, stop in ((first, until), (0, first + count - until)):
            f_x, f_y, torque = _add_piece(joint, entry_velocity, j, start, stop, motion, sign, gradient)
            out[0] += area * f_x
            out[1] += area * f_y
            out[2] -= area * z * f_y
            out[3] -= area * z * f_x
            out[4] += area * joint.journal_radius * torque
        _add_row(area, z, y, joint.journal_radius, gradient, jacobian)


@summing
def _add_piece(
    joint: BushingData,
    entry_velocity: FloatArray,
    row: int,
    first: int,
    until: int,
    motion: tuple[float, float, float, float, float],
    sign: float,
    gradient: FloatArray,
) -> tuple[float, float, float]:
    """Return (Σ f_x, Σ f_y, Σ τ) of nodes ``first`` to ``until`` of a row and add their gradient.

    ``motion`` holds the offset and the velocity of the axis in this row and the surface speed ω_v r_j.
    """
    a, b, v_a, v_b, speed = motion
    cos, sin, wear = joint.cos_theta, joint.sin_theta, joint.wear
    law = friction_law(joint, sign)
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
            joint.clearance + a * c + b * s + wear[j, i],
            -(v_a * c + v_b * s),
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
