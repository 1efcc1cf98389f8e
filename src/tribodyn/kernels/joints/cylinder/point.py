"""A bushing that touches at one point of the clearance circle at each end, as multibody programs have it.

At z = ±l_z/2 the trunnion axis is at (a, b), ρ from the axis of the bushing. Where ρ > c the smooth circles
overlap by ρ − c, and one force acts along the line of centres: at the bushing point named by cos θ = −a/ρ,
sin θ = −b/ρ. So the formulas are those of a single node whose place follows from the state. The contact
table holds the force of one end [N] instead of a pressure, over (c − ρ)/σ, so that it takes the place of a
pressure times an area; there is no pressure field and no wear.

As in the literature, both cross-sections are circles: the ellipse of a tilted trunnion is neglected.

The functions take the arguments of those of the same name for the surface contact.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.nodes import row_motion
from tribodyn.kernels.joints.cylinder.wrench import add_row, friction_ratio
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.pose import F_X, F_Y, M_X, M_Y, M_Z
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy

N_ENDS = 2


@inlined
def _end(joint: BushingData, k: int) -> int:
    """Return the row of nodes that stands on end ``k``, 0 at the bottom and 1 at the top."""
    return k * (joint.z.size - 1)


@kernel
def _force(
    joint: BushingData, memory: JointMemory, j: int, gap: float, approach: float
) -> tuple[float, float, float, float]:
    """Return rigid force, total force [N] and the derivatives of the total in gap and approach speed."""
    return node_pressure(
        joint.table,
        joint.roughness,
        joint.minimum_entry_velocity,
        joint.clip,
        gap,
        approach,
        memory.entry_velocity[j, 0],
    )


@kernel
def wrench(joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray) -> None:
    """Fill ``out`` (6,) with the wrench of both ends."""
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance = joint.clearance + pose.opening
    for k in range(6):
        out[k] = 0.0
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        if rho <= clearance:
            continue
        c, s = -a / rho, -b / rho
        approach = -(v_a * c + v_b * s + pose.v_opening)
        _, force, _, _ = _force(joint, memory, j, clearance - rho, approach)
        slip = pose.w_z * joint.journal_radius + v_a * s - v_b * c
        ratio, _ = friction_ratio(joint, slip, pose.direction)
        tau = ratio * force
        f_x = force * c + joint.tangential * tau * s
        f_y = force * s - joint.tangential * tau * c
        out[F_X] += f_x
        out[F_Y] += f_y
        out[M_X] -= z * f_y
        out[M_Y] += z * f_x
        out[M_Z] += joint.journal_radius * tau


@kernel
def wrench_and_jacobian(
    joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray, jacobian: FloatArray
) -> None:
    """Fill ``out`` (6,) and ``jacobian`` (6, 12).

    Other than at a node, cos θ and sin θ change with the state: with the turn dθ = (s da − c db)/ρ they do
    so by dc = −s dθ and ds = c dθ.
    """
    wrench(joint, memory, pose, out)
    clear(jacobian)
    gradient = memory.scratch.gradient
    clear(gradient)
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance = joint.clearance + pose.opening
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        if rho <= clearance:
            continue
        c, s = -a / rho, -b / rho
        towards = -(v_a * c + v_b * s)
        _, force, d_gap, d_approach = _force(joint, memory, j, clearance - rho, towards - pose.v_opening)
        side = v_a * s - v_b * c
        ratio, d_ratio = friction_ratio(joint, pose.w_z * joint.journal_radius + side, pose.direction)
        tau = ratio * force
        for m in range(5):  # a, b, v_a, v_b, ω_z
            turn = (s if m == 0 else -c if m == 1 else 0.0) / rho  # dc = −s·turn, ds = c·turn
            gap_m = c if m == 0 else s if m == 1 else 0.0
            approach_m = side * turn - (c if m == 2 else s if m == 3 else 0.0)
            slip_m = -towards * turn + (
                s if m == 2 else -c if m == 3 else joint.journal_radius if m == 4 else 0.0
            )
            force_m = d_gap * gap_m + d_approach * approach_m
            tau_m = ratio * force_m + d_ratio * slip_m * force
            gradient[0, m] = force_m * c - force * s * turn + joint.tangential * (tau_m * s + tau * c * turn)
            gradient[1, m] = force_m * s + force * c * turn - joint.tangential * (tau_m * c - tau * s * turn)
            gradient[2, m] = tau_m
        add_row(1.0, z, pose, joint.journal_radius, gradient, jacobian)


@kernel
def report(joint: BushingData, memory: JointMemory, pose: Record) -> None:
    """Fill the report as that of the surface contact does; pressure and contact area are zero."""
    memory.scratch.report = memory.scratch.blank
    out = memory.scratch.report
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    out.separation_min = clearance = joint.clearance + pose.opening
    touching = pulling = 0
    for k in range(N_ENDS):
        j = _end(joint, k)
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, z)
        rho = math.sqrt(a * a + b * b)
        gap = clearance - rho
        out.separation_min = min(out.separation_min, gap)
        if gap >= 0.0:
            continue
        c, s = -a / rho, -b / rho
        approach = -(v_a * c + v_b * s + pose.v_opening)
        rigid, force, _, _ = _force(joint, memory, j, gap, approach)
        turning = pose.w_z * joint.journal_radius
        slip = turning + v_a * s - v_b * c
        ratio, _ = friction_ratio(joint, slip, pose.direction)
        tau = ratio * force
        f_fx, f_fy = joint.tangential * tau * s, -joint.tangential * tau * c
        out.F_cx += force * c
        out.F_cy += force * s
        out.M_jcx -= z * force * s
        out.M_jcy += z * force * c
        out.F_kx += rigid * c
        out.F_ky += rigid * s
        out.M_kx -= z * rigid * s
        out.M_ky += z * rigid * c
        out.F_fx += f_fx
        out.F_fy += f_fy
        out.M_fx -= z * f_fy
        out.M_fy += z * f_fx
        out.M_jf += joint.journal_radius * tau
        out.damping_power += (force - rigid) * approach
        out.friction_power += tau * (slip if joint.tangential > 0.0 else turning)
        touching += 1
        if force <= 0.0:
            pulling += 1
    if touching > 0:
        out.tensile_clip_share = pulling / touching


@kernel
def stored(joint: BushingData, pose: Record) -> float:
    """Return the stored contact energy of both ends [J]."""
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance = joint.clearance + pose.opening
    total = 0.0
    for k in range(N_ENDS):
        a, b, _, _ = row_motion(pose, tan_x, tan_y, joint.z[_end(joint, k)])
        gap = clearance - math.sqrt(a * a + b * b)
        if gap < 0.0:
            total += joint.roughness * stored_energy(joint.table, gap / joint.roughness)
    return total


@kernel
def squeeze(joint: BushingData, pose: Record) -> float:
    """Return the sum of the rigid forces of both ends [N], minus the derivative of :func:`stored`."""
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance = joint.clearance + pose.opening
    total = 0.0
    for k in range(N_ENDS):
        a, b, _, _ = row_motion(pose, tan_x, tan_y, joint.z[_end(joint, k)])
        gap = clearance - math.sqrt(a * a + b * b)
        if gap < 0.0:
            total += pressure_and_damping(joint.table, gap / joint.roughness)[0]
    return total


@kernel
def update_entry_velocity(joint: BushingData, memory: JointMemory, pose: Record, at_start: float) -> None:
    """Let the ends enter and leave contact at the end of an accepted step, where the circles meet."""
    entry_velocity = memory.entry_velocity
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance = joint.clearance + pose.opening
    for k in range(N_ENDS):
        j = _end(joint, k)
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, joint.z[j])
        rho = math.sqrt(a * a + b * b)
        if rho <= clearance:
            entry_velocity[j, 0] = 0.0
        elif entry_velocity[j, 0] == 0.0:
            if at_start > 0.0:
                entry_velocity[j, 0] = joint.minimum_entry_velocity
            else:
                approach = (a * v_a + b * v_b) / rho - pose.v_opening
                entry_velocity[j, 0] = reference_velocity(0.0, approach, joint.minimum_entry_velocity)
