"""Everything about the joint at one instant that a person or a ledger asks for."""

from __future__ import annotations

import math

import numpy as np

from tribodyn.core.quantities import Record
from tribodyn.kernels.extremes import larger, smaller
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints import listed
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.nodes import gather, lean, look_up, rewind, row_motion
from tribodyn.kernels.joints.cylinder.wrench import LEAST_SQUARE, friction_law, ratio_at
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.pressure import reference_velocity, total_pressure
from tribodyn.kernels.lookup import stored_energy


@kernel
def report(joint: BushingData, memory: JointMemory, pose: Record) -> None:
    """Fill the report in ``memory.scratch``; arguments as for ``wrench``, moments right-handed.

    The stored energy takes a look-up of its own at every node and is left to :func:`stored`.
    Pressures times sliding speed are kept in ``memory`` until the next report, for :func:`slide`.
    """
    memory.scratch.report = memory.scratch.blank
    out = memory.scratch.report
    out.separation_min = math.inf
    memory.pieces[0, 0] = memory.pieces[0, 1] = 0
    rewind(memory)
    n = gather(joint, memory, pose, 1.0)
    while n > 0:
        look_up(joint, memory, n)
        _add_nodes(joint, memory, pose.w_z, pose.direction, lean(pose), n, out)
        _note_pieces(memory, n)
        n = gather(joint, memory, pose, 1.0)
    nearest = out.separation_min
    out.separation_min = _separation(joint, nearest) if nearest < math.inf else _far_separation(joint, pose)
    total = 0.0
    for j in range(joint.area.size):
        total += joint.cos_theta.size * joint.area[j]
    contact = out.contact_fraction
    out.contact_fraction = contact / total
    if contact > 0.0:
        out.tensile_clip_share /= contact


@kernel
def _note_pieces(memory: JointMemory, n: int) -> None:
    """Note where the ``n`` nodes in the list come from, behind those noted so far."""
    pieces, kept = memory.scratch.listed.pieces, memory.pieces
    before = kept[0, 0]
    for piece in range(1, pieces[0, 0] + 1):
        for column in range(3):
            kept[before + piece, column] = pieces[piece, column]
    kept[0, 0] = before + pieces[0, 0]
    kept[0, 1] += n


@kernel
def slide(memory: JointMemory, h: float) -> None:
    """Let the trunnion slide for ``h`` [s] as it did at the last report: add to the sliding load."""
    pieces, load, at = memory.pieces, memory.sliding_load, 0
    for piece in range(1, pieces[0, 0] + 1):
        row, first, size = pieces[piece, 0], pieces[piece, 1], pieces[piece, 2]
        for k in range(size):
            load[row, first + k] += h * memory.sliding[at + k]
        at += size


@kernel
def stored(joint: BushingData, memory: JointMemory, pose: Record) -> float:
    """Return the stored contact energy [J] alone; arguments as for ``wrench``."""
    total = 0.0
    rewind(memory)
    n = gather(joint, memory, pose, 0.0)
    while n > 0:
        total += _stored(joint, memory, n)
        n = gather(joint, memory, pose, 0.0)
    return total


@kernel
def squeeze(joint: BushingData, memory: JointMemory, pose: Record) -> float:
    """Return ∫P_k dA [N], minus the derivative of the stored energy in the clearance."""
    total = 0.0
    rewind(memory)
    n = gather(joint, memory, pose, 0.0)
    while n > 0:
        look_up(joint, memory, n)
        work = memory.scratch.listed.work
        for k in range(n):
            total += work[listed.AREA + k] * work[listed.RIGID + k]
        n = gather(joint, memory, pose, 0.0)
    return total


@kernel
def _add_nodes(
    joint: BushingData,
    memory: JointMemory,
    omega: float,
    direction: float,
    leaning: tuple[float, float, float, float],
    n: int,
    out: Record,
) -> None:
    """Add the sums over the ``n`` nodes in the list to ``out``, and append what slides to ``memory``.

    Separations are places in the table.
    """
    work, sliding, at = memory.scratch.listed.work, memory.sliding, np.uint64(memory.pieces[0, 1])
    speed = abs(omega) * joint.journal_radius
    law = friction_law(joint, direction)
    v_min, clip = joint.minimum_entry_velocity, joint.clip
    tangential, turning = joint.tangential, (1.0 - joint.tangential) * omega * joint.journal_radius
    onset = (joint.onset - joint.table.h_first) * joint.table.inverse_step + 1.0
    shift_a, shift_b = joint.journal_radius * leaning[0], joint.journal_radius * leaning[1]
    f_cx = f_cy = m_cx = m_cy = f_kx = f_ky = m_kx = m_ky = f_fx = f_fy = m_fx = m_fy = 0.0
    torque = heat = power = contact = clipped = 0.0
    highest, nearest = out.p_max, out.separation_min
    for k in range(min(n, listed.PART)):
        place = work[listed.INTERVAL + k] + work[listed.FRACTION + k]
        approach, slip = work[listed.APPROACH + k], work[listed.SLIP + k]
        c, s = work[listed.COS + k], work[listed.SIN + k]
        area, moment = work[listed.AREA + k], work[listed.MOMENT + k]
        reference = reference_velocity(work[listed.ENTRY + k], approach, v_min)
        rigid, damping = work[listed.RIGID + k], work[listed.DAMPING + k]
        p = total_pressure(rigid, damping, approach / reference, clip)
        ratio, _ = ratio_at(law, slip)
        tau = ratio * p
        sliding[at + np.uint64(k)] = speed * p
        highest = larger(highest, p)
        nearest = smaller(nearest, place)
        p_c, p_s = p * c, p * s
        tau_c, tau_s = tangential * tau * c, tangential * tau * s
        f_cx += area * p_c
        f_cy += area * p_s
        across = moment - area * (shift_a * c + shift_b * s)
        m_cx -= across * p_s
        m_cy += across * p_c
        k_c, k_s = rigid * c, rigid * s
        f_kx += area * k_c
        f_ky += area * k_s
        m_kx -= across * k_s
        m_ky += across * k_c
        f_fx += area * tau_s
        f_fy -= area * tau_c
        m_fx += moment * tau_c
        m_fy += moment * tau_s
        torque += area * tau
        heat += area * (p - rigid) * approach
        power += area * tau * (tangential * slip + turning)
        touching = area if place < onset else 0.0
        contact += touching
        clipped += touching if p <= 0.0 else 0.0
    out.F_cx += f_cx
    out.F_cy += f_cy
    out.M_jcx += m_cx
    out.M_jcy += m_cy
    out.F_kx += f_kx
    out.F_ky += f_ky
    out.M_kx += m_kx
    out.M_ky += m_ky
    out.F_fx += f_fx
    out.F_fy += f_fy
    out.M_fx += m_fx
    out.M_fy += m_fy
    out.M_jf += joint.journal_radius * torque
    out.damping_power += heat
    out.friction_power += power
    out.p_max, out.separation_min = highest, nearest
    out.contact_fraction += contact
    out.tensile_clip_share += clipped


@kernel
def _separation(joint: BushingData, place: float) -> float:
    """Return the gap [m] that belongs to a place in the contact table."""
    table = joint.table
    return joint.roughness * (table.h_first + (place - 1.0) / table.inverse_step)


@kernel
def _far_separation(joint: BushingData, pose: Record) -> float:
    """Return the least unworn gap [m] of a trunnion out of reach of contact.

    The second-order term of the tilt is taken where the gap is least without it.
    """
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    l_a, l_b, _, _ = lean(pose)
    farthest = 0.0
    for j in range(joint.z.size):
        a, b, _, _ = row_motion(pose, tan_x, tan_y, joint.z[j])
        square = a * a + b * b
        along = (a * l_a + b * l_b) ** 2 / max(square, LEAST_SQUARE)
        farthest = max(farthest, math.sqrt(square) + 0.5 * joint.journal_radius * along)
    return joint.clearance + pose.opening - farthest


@kernel
def _stored(joint: BushingData, memory: JointMemory, n: int) -> float:
    """Return the stored contact energy of the nodes in the list [J]."""
    work, total = memory.scratch.listed.work, 0.0
    for k in range(n):
        place = work[listed.INTERVAL + k] + work[listed.FRACTION + k]
        h_star = joint.table.h_first + (place - 1.0) / joint.table.inverse_step
        total += work[listed.AREA + k] * stored_energy(joint.table, h_star)
    return joint.roughness * total
