"""Everything about the joint at one instant that a person or a ledger asks for."""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.pressure import node_pressure
from tribodyn.kernels.bushing.window import contact_window
from tribodyn.kernels.bushing.wrench import friction_ratio, row_motion
from tribodyn.kernels.jit import kernel
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
N_REPORT = 18


@kernel
def report(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    with_energy: bool,
    out: FloatArray,
) -> None:
    """Fill ``out`` (N_REPORT,) with the quantities named above; arguments as for ``wrench``.

    The stored energy takes a look-up of its own at every node and is left at zero unless ``with_energy``.
    """
    n_theta = joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    onset = joint.onset * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    for k in range(N_REPORT):
        out[k] = 0.0
    out[SEPARATION_MIN] = 1.0e30
    contact_area = clipped_area = 0.0
    for j in range(joint.z.size):
        area = joint.area[j]
        z = joint.z[j]
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, z)
        first, count = contact_window(joint.clearance, a, b, limit, n_theta)
        f_cx = f_cy = f_kx = f_ky = f_fx = f_fy = torque = heat = power = stored = 0.0
        i = first % n_theta - 1
        for _ in range(count):
            i = i + 1 if i + 1 < n_theta else 0
            c = joint.cos_theta[i]
            s = joint.sin_theta[i]
            gap = joint.clearance + a * c + b * s + joint.wear[j, i]
            out[SEPARATION_MIN] = min(out[SEPARATION_MIN], gap)
            if gap >= limit:
                continue
            approach = -(v_a * c + v_b * s)
            rigid, p, _, _ = node_pressure(
                joint.table,
                joint.roughness,
                joint.minimum_entry_velocity,
                joint.clip,
                gap,
                approach,
                entry_velocity[j, i],
            )
            slip = omega * joint.journal_radius + v_a * s - v_b * c
            ratio, _ = friction_ratio(joint, slip, sign)
            tau = ratio * p
            f_cx += p * c
            f_cy += p * s
            f_kx += rigid * c
            f_ky += rigid * s
            f_fx += joint.tangential * tau * s
            f_fy -= joint.tangential * tau * c
            torque += tau
            heat += (p - rigid) * approach
            if joint.tangential > 0.0:
                power += tau * slip
            else:
                power += tau * omega * joint.journal_radius
            if with_energy:
                stored += joint.roughness * stored_energy(joint.table, gap / joint.roughness)
            out[P_MAX] = max(out[P_MAX], p)
            if gap < onset:
                contact_area += area
                if p <= 0.0:
                    clipped_area += area
        if count == 0:
            e = (a * a + b * b) ** 0.5
            out[SEPARATION_MIN] = min(out[SEPARATION_MIN], joint.clearance - e)
        out[F_CX] += area * f_cx
        out[F_CY] += area * f_cy
        out[M_JCX] -= area * z * f_cy
        out[M_JCY] -= area * z * f_cx
        out[F_KX] += area * f_kx
        out[F_KY] += area * f_ky
        out[F_FX] += area * f_fx
        out[F_FY] += area * f_fy
        out[M_FX] -= area * z * f_fy
        out[M_FY] -= area * z * f_fx
        out[M_JF] += area * joint.journal_radius * torque
        out[HEAT_DAMPING] += area * heat
        out[POWER_FRICTION] += area * power
        out[STORED] += area * stored
    total_area = n_theta * joint.area.sum()
    out[CONTACT_FRACTION] = contact_area / total_area
    if contact_area > 0.0:
        out[CLIPPED] = clipped_area / contact_area
