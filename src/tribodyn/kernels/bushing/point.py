"""A bushing that touches at one point of the clearance circle at each end, as multibody programs have it.

At z = ±l_z/2 the trunnion axis is at (a, b), ρ from the axis of the bushing. Where ρ > c the smooth circles
overlap by ρ − c, and one force acts along the line of centres: at the bushing point named by cos θ = −a/ρ,
sin θ = −b/ρ. So the formulas are those of a single node whose place follows from the state. The contact
table holds the force of one end [N] instead of a pressure, over (c − ρ)/σ, so that it takes the place of a
pressure times an area; there is no pressure field and no wear.

The functions take the arguments of those of the same name for the surface contact.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.nodes import row_motion
from tribodyn.kernels.bushing.pressure import node_pressure, reference_velocity
from tribodyn.kernels.bushing.report import (
    CLIPPED,
    F_CX,
    F_CY,
    F_FX,
    F_FY,
    F_KX,
    F_KY,
    HEAT_DAMPING,
    M_FX,
    M_FY,
    M_JCX,
    M_JCY,
    M_JF,
    M_KX,
    M_KY,
    N_REPORT,
    POWER_FRICTION,
    SEPARATION_MIN,
)
from tribodyn.kernels.bushing.wrench import friction_ratio
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.lookup import stored_energy

N_ENDS = 2


@inlined
def _end(joint: BushingData, k: int) -> int:
    """Return the row of nodes that stands on end ``k``, 0 at the bottom and 1 at the top."""
    return k * (joint.z.size - 1)


@kernel
def _force(
    joint: BushingData, entry_velocity: FloatArray, j: int, gap: float, approach: float
) -> tuple[float, float, float, float]:
    """Return rigid force, total force [N] and the derivatives of the total in gap and approach speed."""
    return node_pressure(
        joint.table,
        joint.roughness,
        joint.minimum_entry_velocity,
        joint.clip,
        gap,
        approach,
        entry_velocity[j, 0],
    )


@kernel
def wrench(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` (5,) with the wrench of both ends."""
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(5):
        out[k] = 0.0
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        if rho <= joint.clearance:
            continue
        c, s = -a / rho, -b / rho
        _, force, _, _ = _force(joint, entry_velocity, j, joint.clearance - rho, -(v_a * c + v_b * s))
        ratio, _ = friction_ratio(joint, omega * joint.journal_radius + v_a * s - v_b * c, sign)
        tau = ratio * force
        f_x = force * c + joint.tangential * tau * s
        f_y = force * s - joint.tangential * tau * c
        out[0] += f_x
        out[1] += f_y
        out[2] -= z * f_y
        out[3] -= z * f_x
        out[4] += joint.journal_radius * tau


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
    """Fill ``out`` (5,) and ``jacobian`` (5, 9); ``gradient`` (3, 5) is scratch.

    Other than at a node, cos θ and sin θ change with the state: with the turn dθ = (s da − c db)/ρ they do
    so by dc = −s dθ and ds = c dθ.
    """
    wrench(joint, entry_velocity, y, omega, sign, out)
    clear(jacobian)
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        if rho <= joint.clearance:
            continue
        c, s = -a / rho, -b / rho
        approach = -(v_a * c + v_b * s)
        _, force, d_gap, d_approach = _force(joint, entry_velocity, j, joint.clearance - rho, approach)
        side = v_a * s - v_b * c
        ratio, d_ratio = friction_ratio(joint, omega * joint.journal_radius + side, sign)
        tau = ratio * force
        for m in range(5):  # a, b, v_a, v_b, ω
            turn = (s if m == 0 else -c if m == 1 else 0.0) / rho  # dc = −s·turn, ds = c·turn
            gap_m = c if m == 0 else s if m == 1 else 0.0
            approach_m = side * turn - (c if m == 2 else s if m == 3 else 0.0)
            slip_m = -approach * turn + (
                s if m == 2 else -c if m == 3 else joint.journal_radius if m == 4 else 0.0
            )
            force_m = d_gap * gap_m + d_approach * approach_m
            tau_m = ratio * force_m + d_ratio * slip_m * force
            gradient[0, m] = force_m * c - force * s * turn + joint.tangential * (tau_m * s + tau * c * turn)
            gradient[1, m] = force_m * s + force * c * turn - joint.tangential * (tau_m * c - tau * s * turn)
            gradient[2, m] = joint.journal_radius * tau_m
        _carry(z, y, tan_x, tan_y, gradient, jacobian)


@kernel
def _carry(
    z: float, y: FloatArray, tan_x: float, tan_y: float, gradient: FloatArray, jacobian: FloatArray
) -> None:
    """Carry the gradient of (f_x, f_y, M_z) in (a, b, v_a, v_b, ω) of one end to the nine arguments."""
    sec2_x, sec2_y = 1.0 + tan_x * tan_x, 1.0 + tan_y * tan_y
    for k in range(3):
        g_a, g_b, g_va, g_vb, g_omega = (
            gradient[k, 0],
            gradient[k, 1],
            gradient[k, 2],
            gradient[k, 3],
            gradient[k, 4],
        )
        d_phi_x = -z * sec2_x * (g_b + 2.0 * y[6] * tan_x * g_vb)
        d_phi_y = -z * sec2_y * (g_a + 2.0 * y[7] * tan_y * g_va)
        row = (g_a, g_b, d_phi_x, d_phi_y, g_va, g_vb, -z * sec2_x * g_vb, -z * sec2_y * g_va, g_omega)
        for m in range(9):
            if k == 2:
                jacobian[4, m] += row[m]
            else:
                jacobian[k, m] += row[m]
                jacobian[3 - k, m] -= z * row[m]


@kernel
def report(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` (N_REPORT,) as that of the surface contact does; pressure and contact area are zero."""
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(N_REPORT):
        out[k] = 0.0
    out[SEPARATION_MIN] = joint.clearance
    touching = pulling = 0
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        gap = joint.clearance - rho
        out[SEPARATION_MIN] = min(out[SEPARATION_MIN], gap)
        if gap >= 0.0:
            continue
        c, s = -a / rho, -b / rho
        approach = -(v_a * c + v_b * s)
        rigid, force, _, _ = _force(joint, entry_velocity, j, gap, approach)
        slip = omega * joint.journal_radius + v_a * s - v_b * c
        ratio, _ = friction_ratio(joint, slip, sign)
        tau = ratio * force
        f_fx, f_fy = joint.tangential * tau * s, -joint.tangential * tau * c
        out[F_CX] += force * c
        out[F_CY] += force * s
        out[M_JCX] -= z * force * s
        out[M_JCY] -= z * force * c
        out[F_KX] += rigid * c
        out[F_KY] += rigid * s
        out[M_KX] -= z * rigid * s
        out[M_KY] -= z * rigid * c
        out[F_FX] += f_fx
        out[F_FY] += f_fy
        out[M_FX] -= z * f_fy
        out[M_FY] -= z * f_fx
        out[M_JF] += joint.journal_radius * tau
        out[HEAT_DAMPING] += (force - rigid) * approach
        out[POWER_FRICTION] += tau * (slip if joint.tangential > 0.0 else omega * joint.journal_radius)
        touching += 1
        if force <= 0.0:
            pulling += 1
    if touching > 0:
        out[CLIPPED] = pulling / touching


@kernel
def stored(joint: BushingData, y: FloatArray) -> float:
    """Return the stored contact energy of both ends [J]."""
    tan_x, tan_y, total = math.tan(y[2]), math.tan(y[3]), 0.0
    for k in range(N_ENDS):
        a, b, _, _ = row_motion(y, tan_x, tan_y, joint.z[_end(joint, k)])
        gap = joint.clearance - math.sqrt(a * a + b * b)
        if gap < 0.0:
            total += joint.roughness * stored_energy(joint.table, gap / joint.roughness)
    return total


@kernel
def update_entry_velocity(
    joint: BushingData, y: FloatArray, entry_velocity: FloatArray, at_start: float
) -> None:
    """Let the ends enter and leave contact at the end of an accepted step, where the circles meet."""
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(N_ENDS):
        j = _end(joint, k)
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, joint.z[j])
        rho = math.sqrt(a * a + b * b)
        if rho <= joint.clearance:
            entry_velocity[j, 0] = 0.0
        elif entry_velocity[j, 0] == 0.0:
            if at_start > 0.0:
                entry_velocity[j, 0] = joint.minimum_entry_velocity
            else:
                approach = (a * v_a + b * v_b) / rho
                entry_velocity[j, 0] = reference_velocity(0.0, approach, joint.minimum_entry_velocity)
