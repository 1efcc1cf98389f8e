"""Everything about a surface at one instant that a person or a ledger asks for."""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.core.tables import ContactTable
from tribodyn.kernels.extremes import larger, smaller
from tribodyn.kernels.jit import kernel, summing
from tribodyn.kernels.joints.pressure import reference_velocity, total_pressure
from tribodyn.kernels.joints.surface import listed
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.listed import PITCH
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, look_up, node_gap, rewind
from tribodyn.kernels.joints.surface.wrench import slip_square
from tribodyn.kernels.lookup import stored_energy


@kernel
def report(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> None:
    """Fill the report of surface ``s`` but for its forces, left in the scratch.

    What slides is kept in ``memory`` until the next report, for ``slide``.
    """
    surface, out, scratch = data.surfaces[s], memory.reports[s], memory.scratch
    for k in range(6):
        scratch.normal[k] = scratch.rigid[k] = scratch.friction[k] = 0.0
    table, work, kept = table_of(data, surface), scratch.listed.work, 0
    cubics = table.cubics
    nearest, out.p_max = math.inf, 0.0
    rewind(surface, memory)
    n = gather(data, surface, memory, station, 1.0)
    while n > 0:
        look_up(cubics, work, n)
        out.energy_contact += surface.roughness * _energy(table, surface, work, n)
        nearest = min(nearest, _add_nodes(surface, scratch, station, n, out))
        _keep(memory, surface.first_node + kept, n)
        kept += n
        n = gather(data, surface, memory, station, 1.0)
    memory.n_touched[s] = kept
    if nearest < float(surface.last_interval - surface.first_interval - 1):
        h_star = surface.h_first + (nearest - 1.0) / surface.inverse_step
        out.separation_min = surface.roughness * h_star
    else:
        out.separation_min = _far_separation(data, surface, station.d, scratch.tilt.phi)
    contact = out.contact_fraction
    out.contact_fraction = contact / surface.area
    if contact > 0.0:
        out.tensile_clip_share /= contact


@kernel
def _keep(memory: SurfaceMemory, at: int, n: int) -> None:
    """Keep the sliding of the list and the nodes that it belongs to, from place ``at`` on."""
    work, node = memory.scratch.listed.work, memory.scratch.listed.node
    for k in range(n):
        memory.sliding[at + k] = work[listed.SLIDING + k]
        memory.touched[at + k] = node[k]


@kernel
def slide(data: SurfaceData, s: int, memory: SurfaceMemory, h: float) -> None:
    """Let surface ``s`` slide for ``h`` [s] as it did at the last report: add to the sliding load."""
    first = data.surfaces[s].first_node
    for k in range(first, first + memory.n_touched[s]):
        memory.sliding_load[memory.touched[k]] += h * memory.sliding[k]


@kernel
def _far_separation(data: SurfaceData, surface: Record, d: FloatArray, phi: FloatArray) -> float:
    """Return the least gap [m] of a shaft out of reach of contact: around rings, and at nodes of patches."""
    least = math.inf
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        if row.whole > 0.0:
            for i in range(row.first, row.first + row.count):
                least = min(least, node_gap(data.nodes, i, d, phi))
        else:
            a, b = row.normal[0] * d[0] + row.arm * phi[1], row.normal[0] * d[1] - row.arm * phi[0]
            least = min(least, row.least - row.normal[2] * d[2] - math.sqrt(a * a + b * b))
    return least


@summing
def _add_nodes(surface: Record, scratch: Record, station: Record, n: int, out: Record) -> float:
    """Add the sums over the ``n`` nodes in the list and return the least place in the contact table."""
    work = scratch.listed.work
    v_min, clip, mu = surface.minimum_entry_velocity, surface.tensile_clip, surface.friction_coefficient
    square, onset = slip_square(surface), (surface.onset - surface.h_first) * surface.inverse_step + 1.0
    v_x, v_y, v_z = station.slip[0], station.slip[1], station.slip[2]
    w_x, w_y, w_z = station.w[0], station.w[1], station.w[2]
    g_x = g_y = g_z = l_x = l_y = l_z = 0.0
    heat = power = contact = clipped = 0.0
    highest, nearest = out.p_max, math.inf
    for k in range(min(n, listed.PART)):
        interval = work[listed.INTERVAL + k] + work[listed.FRACTION + k]
        approach, area = work[listed.APPROACH + k], work[listed.AREA + k]
        x, y = work[listed.POSITION + k], work[listed.POSITION + PITCH + k]
        z = work[listed.POSITION + 2 * PITCH + k]
        n_x, n_y = work[listed.NORMAL + k], work[listed.NORMAL + PITCH + k]
        n_z = work[listed.NORMAL + 2 * PITCH + k]
        reference = reference_velocity(work[listed.ENTRY + k], approach, v_min)
        rigid = work[listed.RIGID + k]
        p = total_pressure(rigid, work[listed.DAMPING + k], approach / reference, clip)
        s_x, s_y, s_z = v_x + w_y * z - w_z * y, v_y + w_z * x - w_x * z, v_z + w_x * y - w_y * x
        along = n_x * s_x + n_y * s_y + n_z * s_z
        s_x, s_y, s_z = s_x - along * n_x, s_y - along * n_y, s_z - along * n_z
        speed = s_x * s_x + s_y * s_y + s_z * s_z
        drag = -mu * area * p / math.sqrt(speed + square)
        t_x, t_y, t_z = drag * s_x, drag * s_y, drag * s_z
        work[listed.SLIDING + k] = p * math.sqrt(speed)
        work[listed.RIGID + k] = area * rigid
        highest = larger(highest, p)
        nearest = smaller(nearest, interval)
        g_x += t_x
        g_y += t_y
        g_z += t_z
        l_x += y * t_z - z * t_y
        l_y += z * t_x - x * t_z
        l_z += x * t_y - y * t_x
        heat += area * (p - rigid) * approach
        power += drag * speed
        touching = area if interval < onset else 0.0
        contact += touching
        clipped += touching if p <= 0.0 else 0.0
        work[listed.AREA + k] = area * p
    for i in range(3):
        scratch.friction[i] += (g_x, g_y, g_z)[i]
        scratch.friction[3 + i] += (l_x, l_y, l_z)[i]
    for i in range(6):
        column, pressed, carried = listed.NORMAL + i * PITCH, 0.0, 0.0
        for k in range(min(n, listed.PART)):
            pressed += work[listed.AREA + k] * work[column + k]
            carried += work[listed.RIGID + k] * work[column + k]
        scratch.normal[i] -= pressed
        scratch.rigid[i] -= carried
    out.damping_power += heat
    out.friction_power += power
    out.p_max = highest
    out.contact_fraction += contact
    out.tensile_clip_share += clipped
    return nearest


@kernel
def _energy(table: ContactTable, surface: Record, work: FloatArray, n: int) -> float:
    """Return the stored energy over σ of the ``n`` nodes in the list [N]."""
    total = 0.0
    for k in range(n):
        place = work[listed.INTERVAL + k] + work[listed.FRACTION + k]
        total += work[listed.AREA + k] * stored_energy(
            table, surface.h_first + (place - 1.0) / surface.inverse_step
        )
    return total
