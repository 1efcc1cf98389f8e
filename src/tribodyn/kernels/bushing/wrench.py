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

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.pressure import node_pressure
from tribodyn.kernels.bushing.window import contact_window
from tribodyn.kernels.jit import inlined, kernel


@inlined
def row_motion(y: FloatArray, tan_x: float, tan_y: float, z: float) -> tuple[float, float, float, float]:
    """Return offset (a, b) [m] and velocity (v_a, v_b) [m/s] of the trunnion axis at height ``z`` [m].

    ``tan_x`` and ``tan_y`` are the tangents of the tilts, the same for every row.
    """
    a = y[0] - z * tan_y
    b = y[1] - z * tan_x
    v_a = y[4] - z * y[7] * (1.0 + tan_y * tan_y)
    v_b = y[5] - z * y[6] * (1.0 + tan_x * tan_x)
    return a, b, v_a, v_b


@inlined
def friction_ratio(joint: BushingData, slip: float, sign: float) -> tuple[float, float]:
    """Return friction per normal pressure and its derivative with respect to slip [s/m].

    Traction: τ/P_c = −μ_f u/√(u² + u_s²). Friction moment: s' μ_f r_b/r_j, so that both give
    their moment with the arm r_j.
    """
    if joint.tangential > 0.0:
        u_s = joint.slip_velocity
        norm = math.sqrt(slip * slip + u_s * u_s)
        ratio = -joint.friction_coefficient * slip / norm
        return ratio, -joint.friction_coefficient * u_s * u_s / (norm * norm * norm)
    return sign * joint.friction_coefficient * joint.bore_radius / joint.journal_radius, 0.0


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
    n_theta = joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(5):
        out[k] = 0.0
    for j in range(joint.z.size):
        area = joint.area[j]
        if area == 0.0:
            continue
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        first, count = contact_window(joint.clearance, a, b, limit, n_theta)
        f_x = f_y = torque = 0.0
        i = first % n_theta - 1
        for _ in range(count):
            i = i + 1 if i + 1 < n_theta else 0
            c = joint.cos_theta[i]
            s = joint.sin_theta[i]
            gap = joint.clearance + a * c + b * s + joint.wear[j, i]
            if gap < limit:
                _, p, _, _ = node_pressure(
                    joint.table,
                    joint.roughness,
                    joint.minimum_entry_velocity,
                    joint.clip,
                    gap,
                    -(v_a * c + v_b * s),
                    entry_velocity[j, i],
                )
                slip = omega * joint.journal_radius + v_a * s - v_b * c
                ratio, _ = friction_ratio(joint, slip, sign)
                tau = ratio * p
                f_x += p * c + joint.tangential * tau * s
                f_y += p * s - joint.tangential * tau * c
                torque += tau
        out[0] += area * f_x
        out[1] += area * f_y
        out[2] -= area * z * f_y
        out[3] -= area * z * f_x
        out[4] += area * joint.journal_radius * torque


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
    r_j = joint.journal_radius
    tangential = joint.tangential
    clear(jacobian)
    for k in range(5):
        out[k] = 0.0
    for j in range(joint.z.size):
        area = joint.area[j]
        if area == 0.0:
            continue
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        first, count = contact_window(joint.clearance, a, b, limit, n_theta)
        f_x = f_y = torque = 0.0
        # Stiffness k = ∂P/∂h and damping d = ∂P/∂δ̇, summed with products of cos θ and sin θ.
        k_cc = k_cs = k_ss = d_cc = d_cs = d_ss = 0.0
        # The same for traction: κ = ∂τ/∂h, λ = −∂τ/∂δ̇, ρ = ∂τ/∂u.
        kappa_cc = kappa_cs = kappa_ss = kappa_c = kappa_s = 0.0
        lambda_cc = lambda_cs = lambda_ss = lambda_c = lambda_s = 0.0
        rho_cc = rho_cs = rho_ss = rho_c = rho_s = rho = 0.0
        i = first % n_theta - 1
        for _ in range(count):
            i = i + 1 if i + 1 < n_theta else 0
            c = joint.cos_theta[i]
            s = joint.sin_theta[i]
            gap = joint.clearance + a * c + b * s + joint.wear[j, i]
            if gap < limit:
                _, p, d_gap, d_approach = node_pressure(
                    joint.table,
                    joint.roughness,
                    joint.minimum_entry_velocity,
                    joint.clip,
                    gap,
                    -(v_a * c + v_b * s),
                    entry_velocity[j, i],
                )
                slip = omega * r_j + v_a * s - v_b * c
                ratio, d_ratio = friction_ratio(joint, slip, sign)
                tau = ratio * p
                f_x += p * c + tangential * tau * s
                f_y += p * s - tangential * tau * c
                torque += tau
                cc = c * c
                cs = c * s
                ss = s * s
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
        if count == 0:
            continue
        out[0] += area * f_x
        out[1] += area * f_y
        out[2] -= area * z * f_y
        out[3] -= area * z * f_x
        out[4] += area * r_j * torque
        gradient[0, 0] = k_cc + tangential * kappa_cs
        gradient[0, 1] = k_cs + tangential * kappa_ss
        gradient[0, 2] = -d_cc + tangential * (lambda_cs + rho_ss)
        gradient[0, 3] = -d_cs + tangential * (lambda_ss - rho_cs)
        gradient[0, 4] = tangential * r_j * rho_s
        gradient[1, 0] = k_cs - tangential * kappa_cc
        gradient[1, 1] = k_ss - tangential * kappa_cs
        gradient[1, 2] = -d_cs - tangential * (lambda_cc + rho_cs)
        gradient[1, 3] = -d_ss - tangential * (lambda_cs - rho_cc)
        gradient[1, 4] = -tangential * r_j * rho_c
        gradient[2, 0] = kappa_c
        gradient[2, 1] = kappa_s
        gradient[2, 2] = lambda_c + rho_s
        gradient[2, 3] = lambda_s - rho_c
        gradient[2, 4] = r_j * rho
        _add_row(area, z, y, r_j, gradient, jacobian)
