"""Everything about the joint at one instant that a person or a ledger asks for."""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing import nodes
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.nodes import gather, look_up, rewind, row_motion
from tribodyn.kernels.bushing.pressure import reference_velocity, total_pressure
from tribodyn.kernels.bushing.wrench import friction_law, ratio_at
from tribodyn.kernels.extremes import larger, smaller
from tribodyn.kernels.jit import kernel, summing
from tribodyn.kernels.lookup import stored_energy

F_CX, F_CY, M_JCX, M_JCY = 0, 1, 2, 3
"""Normal pressure: forces [N] and moments [N m]."""
F_KX, F_KY = 4, 5
"""Rigid part of the normal forces [N]."""
F_FX, F_FY, M_FX, M_FY, M_JF = 6, 7, 8, 9, 10
"""Friction: forces [N] and moments [N m]."""
HEAT_DAMPING, POWER_FRICTION, STORED = 11, 12, 13
"""Damping heat ∬(P_c − P_k) δ̇ dA [W], friction power ∬τ u dA [W], stored contact energy [J]."""
P_MAX, SEPARATION_MIN = 14, 15
"""Peak pressure, edges included [Pa]; smallest gap between mean planes [m]."""
CLIPPED, CONTACT_FRACTION = 16, 17
"""Share of the nominal contact area where the tensile clip acts, and share of the bushing in contact [1]."""
M_KX, M_KY = 18, 19
"""Moments of the rigid part [N m]."""
N_REPORT = 20


@kernel
def report(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` (N_REPORT,) with the quantities named above; arguments as for ``wrench``.

    The stored energy takes a look-up of its own at every node and is left to :func:`stored`.
    The pressures are kept in ``joint.kept`` until the next report, for :func:`slide`.
    """
    for k in range(N_REPORT):
        out[k] = 0.0
    out[SEPARATION_MIN] = math.inf
    joint.kept_pieces[0, 0] = joint.kept_pieces[0, 1] = 0
    rewind(joint)
    n = gather(joint, entry_velocity, y, omega, 1.0)
    while n > 0:
        look_up(joint, n)
        _add_nodes(joint, omega, sign, n, out)
        _keep(joint, n)
        n = gather(joint, entry_velocity, y, omega, 1.0)
    nearest = out[SEPARATION_MIN]
    out[SEPARATION_MIN] = _separation(joint, nearest) if nearest < math.inf else _far_separation(joint, y)
    total = 0.0
    for j in range(joint.area.size):
        total += joint.cos_theta.size * joint.area[j]
    contact = out[CONTACT_FRACTION]
    out[CONTACT_FRACTION] = contact / total
    if contact > 0.0:
        out[CLIPPED] /= contact


@kernel
def _keep(joint: BushingData, n: int) -> None:
    """Append the pressures of the list to those kept so far."""
    pieces, kept_pieces = joint.listed.pieces, joint.kept_pieces
    before, kept = kept_pieces[0, 0], kept_pieces[0, 1]
    for k in range(n):
        joint.kept[kept + k] = joint.listed.work[nodes.PRESSURE + k]
    kept_pieces[0, 1] = kept + n
    for piece in range(1, pieces[0, 0] + 1):
        for column in range(3):
            kept_pieces[before + piece, column] = pieces[piece, column]
    kept_pieces[0, 0] = before + pieces[0, 0]


@kernel
def slide(joint: BushingData, distance: float, load: FloatArray) -> None:
    """Add P_c of the last report times ``distance`` [m] to the sliding load (n_z + 2, n_theta) [N/m]."""
    pieces, at = joint.kept_pieces, 0
    for piece in range(1, pieces[0, 0] + 1):
        row, first, size = pieces[piece, 0], pieces[piece, 1], pieces[piece, 2]
        for k in range(size):
            load[row, first + k] += distance * joint.kept[at + k]
        at += size


@kernel
def stored(joint: BushingData, entry_velocity: FloatArray, y: FloatArray) -> float:
    """Return the stored contact energy [J] alone; arguments as for ``wrench``."""
    total = 0.0
    rewind(joint)
    n = gather(joint, entry_velocity, y, 0.0, 0.0)
    while n > 0:
        total += _stored(joint, n)
        n = gather(joint, entry_velocity, y, 0.0, 0.0)
    return total


@summing
def _add_nodes(joint: BushingData, omega: float, sign: float, n: int, out: FloatArray) -> None:
    """Add the sums over the ``n`` nodes in the list to ``out``; separations are places in the table."""
    work = joint.listed.work
    law = friction_law(joint, sign)
    v_min, clip = joint.minimum_entry_velocity, joint.clip
    tangential, turning = joint.tangential, (1.0 - joint.tangential) * omega * joint.journal_radius
    onset = (joint.onset - joint.table.h_first) * joint.table.inverse_step + 1.0
    f_cx = f_cy = m_cx = m_cy = f_kx = f_ky = m_kx = m_ky = f_fx = f_fy = m_fx = m_fy = 0.0
    torque = heat = power = contact = clipped = 0.0
    highest, nearest = out[P_MAX], out[SEPARATION_MIN]
    for k in range(min(n, nodes.PART)):
        place = work[nodes.INTERVAL + k] + work[nodes.FRACTION + k]
        approach, slip = work[nodes.APPROACH + k], work[nodes.SLIP + k]
        c, s = work[nodes.COS + k], work[nodes.SIN + k]
        area, moment = work[nodes.AREA + k], work[nodes.MOMENT + k]
        reference = reference_velocity(work[nodes.ENTRY + k], approach, v_min)
        rigid, damping = work[nodes.RIGID + k], work[nodes.DAMPING + k]
        p = total_pressure(rigid, damping, approach / reference, clip)
        ratio, _ = ratio_at(law, slip)
        tau = ratio * p
        work[nodes.PRESSURE + k] = p
        highest = larger(highest, p)
        nearest = smaller(nearest, place)
        p_c, p_s = p * c, p * s
        tau_c, tau_s = tangential * tau * c, tangential * tau * s
        f_cx += area * p_c
        f_cy += area * p_s
        m_cx -= moment * p_s
        m_cy -= moment * p_c
        k_c, k_s = rigid * c, rigid * s
        f_kx += area * k_c
        f_ky += area * k_s
        m_kx -= moment * k_s
        m_ky -= moment * k_c
        f_fx += area * tau_s
        f_fy -= area * tau_c
        m_fx += moment * tau_c
        m_fy -= moment * tau_s
        torque += area * tau
        heat += area * (p - rigid) * approach
        power += area * tau * (tangential * slip + turning)
        touching = area if place < onset else 0.0
        contact += touching
        clipped += touching if p <= 0.0 else 0.0
    sums = (f_cx, f_cy, m_cx, m_cy, f_kx, f_ky, f_fx, f_fy, m_fx, m_fy)
    for i in range(10):
        out[i] += sums[i]
    out[P_MAX], out[SEPARATION_MIN] = highest, nearest
    out[M_JF] += joint.journal_radius * torque
    out[HEAT_DAMPING] += heat
    out[POWER_FRICTION] += power
    out[CONTACT_FRACTION] += contact
    out[CLIPPED] += clipped
    out[M_KX] += m_kx
    out[M_KY] += m_ky


@kernel
def _separation(joint: BushingData, place: float) -> float:
    """Return the gap [m] that belongs to a place in the contact table."""
    table = joint.table
    return joint.roughness * (table.h_first + (place - 1.0) / table.inverse_step)


@kernel
def _far_separation(joint: BushingData, y: FloatArray) -> float:
    """Return the least unworn gap [m] of a trunnion out of reach of contact."""
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    farthest = 0.0
    for j in range(joint.z.size):
        a, b, _, _ = row_motion(y, tan_x, tan_y, joint.z[j])
        farthest = max(farthest, math.sqrt(a * a + b * b))
    return joint.clearance - farthest


@kernel
def _stored(joint: BushingData, n: int) -> float:
    """Return the stored contact energy of the nodes in the list [J]."""
    work, total = joint.listed.work, 0.0
    for k in range(n):
        place = work[nodes.INTERVAL + k] + work[nodes.FRACTION + k]
        h_star = joint.table.h_first + (place - 1.0) / joint.table.inverse_step
        total += work[nodes.AREA + k] * stored_energy(joint.table, h_star)
    return joint.roughness * total
