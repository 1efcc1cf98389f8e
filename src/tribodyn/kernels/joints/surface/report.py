"""Everything about a surface at one instant that a person or a ledger asks for."""

import math

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.jit import kernel, larger, smaller
from tribodyn.kernels.joints.columns import APPROACH, AREA, FRACTION, INTERVAL, PART, PRESSURE, RIGID
from tribodyn.kernels.joints.pressure import fill_pressures, weighted_sum
from tribodyn.kernels.joints.surface import listed, ring_report
from tribodyn.kernels.joints.surface.data import SurfaceData, is_ring, table_of
from tribodyn.kernels.joints.surface.jacobian import LEAST_SQUARE, add_columns, fill_forces, slip_square
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import gather, node_gap, rewind
from tribodyn.kernels.lookup import stored_energy


@kernel
def report(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> None:
    """Fill the report of surface ``s`` but for its forces, left in the scratch.

    What slides is kept in ``memory`` until the next report, for ``slide``.
    """
    surface, out, scratch = data.surfaces[s], memory.reports[s], memory.scratch
    for k in range(6):
        scratch.normal[k] = scratch.rigid[k] = scratch.friction[k] = 0.0
    scratch.rigid_load = 0.0
    if is_ring(data, surface):
        nearest = ring_report.add_rows(data, s, memory, station)
    else:
        nearest = _add_patches(data, s, memory, station)
    if nearest < float(surface.last_interval - surface.first_interval - 1):
        h_star = surface.h_first + (nearest - 1.0) / surface.inverse_step
        out.separation_min = surface.roughness * h_star
    else:
        out.separation_min = _far_separation(data, surface, station, scratch.tilt.phi)
    contact = out.contact_fraction
    out.contact_fraction = contact / surface.area
    if contact > 0.0:
        out.tensile_clip_share /= contact
        out.plastic_share /= contact


@kernel
def _add_patches(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> float:
    """Add the sums over the nodes of patches to the report; return the nearest place in the table."""
    surface, out, scratch = data.surfaces[s], memory.reports[s], memory.scratch
    table, work, kept = table_of(data, surface), scratch.listed.work, 0
    v_min, clip, most = surface.minimum_entry_velocity, surface.tensile_clip, surface.hardness
    nearest, out.p_max = math.inf, 0.0
    rewind(surface, memory)
    n = gather(data, surface, memory, station)
    while n > 0:
        fill_pressures(table.cubics, v_min, clip, most, work, n)
        fill_forces(surface, work, station, n)
        out.energy_contact += surface.roughness * _energy(table, surface, work, n)
        nearest = min(nearest, _fill_terms(surface, work, n, out))
        _add_sums(surface, scratch, n, out)
        _keep(memory, surface.first_node + kept, n)
        kept += n
        n = gather(data, surface, memory, station)
    memory.n_touched[s] = kept
    return nearest


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
    if is_ring(data, data.surfaces[s]):
        ring_report.slide(data, data.surfaces[s], memory, h)
        return
    first = data.surfaces[s].first_node
    for k in range(first, first + memory.n_touched[s]):
        memory.sliding_load[memory.touched[k]] += h * memory.sliding[k]


@kernel
def _far_separation(data: SurfaceData, surface: Record, station: Record, phi: FloatArray) -> float:
    """Return the least gap [m] of a shaft out of reach of contact: around rings, and at nodes of patches.

    Around a ring the second-order term of the tilt is taken where the gap is least without it.
    """
    least, d = math.inf, station.d
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        if row.whole > 0.0:
            for i in range(row.first, row.first + row.count):
                least = min(least, node_gap(data.nodes, i, station.d, phi) + station.opening)
        else:
            a, b = row.normal[0] * d[0] + row.arm * phi[1], row.normal[0] * d[1] - row.arm * phi[0]
            square = a * a + b * b
            along = (a * phi[1] - b * phi[0]) ** 2 / max(square, LEAST_SQUARE)
            off = math.sqrt(square) + 0.5 * surface.lean * along
            least = min(least, row.least + station.opening - row.normal[2] * d[2] - off)
    return least


@kernel
def _fill_terms(surface: Record, work: FloatArray, n: int, out: Record) -> float:
    """Fill the columns of the report, note the highest pressure, return the least place in the table."""
    mu, square = surface.friction_coefficient, slip_square(surface)
    onset = (surface.onset - surface.h_first) * surface.inverse_step + 1.0
    highest, nearest = out.p_max, math.inf
    for k in range(min(n, PART)):
        place, p, rigid = work[INTERVAL + k] + work[FRACTION + k], work[PRESSURE + k], work[RIGID + k]
        slip_2 = work[listed.SLIP_SQUARE + k]
        highest = larger(highest, p)
        nearest = smaller(nearest, place)
        work[listed.SLIDING + k] = p * math.sqrt(slip_2)
        work[RIGID + k] = work[AREA + k] * rigid
        work[listed.HEAT + k] = (p - rigid) * work[APPROACH + k]
        work[listed.POWER + k] = -mu * p * slip_2 / math.sqrt(slip_2 + square)
        touching = 1.0 if place < onset else 0.0
        work[listed.TOUCHING + k] = touching
        work[listed.CLIPPED + k] = touching if p <= 0.0 else 0.0
        work[listed.PLASTIC + k] = 1.0 if p >= surface.hardness else 0.0
    out.p_max = highest
    return nearest


@kernel
def _add_sums(surface: Record, scratch: Record, n: int, out: Record) -> None:
    """Add the sums over the ``n`` nodes in the list."""
    work = scratch.listed.work
    add_columns(work, listed.FORCE, listed.NORMAL, n, -1.0, scratch.normal)
    add_columns(work, RIGID, listed.NORMAL, n, -1.0, scratch.rigid)
    add_columns(work, listed.FORCE, listed.SLIP, n, -surface.friction_coefficient, scratch.friction)
    out.damping_power += weighted_sum(work, AREA, listed.HEAT, n)
    out.friction_power += weighted_sum(work, AREA, listed.POWER, n)
    out.contact_fraction += weighted_sum(work, AREA, listed.TOUCHING, n)
    out.tensile_clip_share += weighted_sum(work, AREA, listed.CLIPPED, n)
    out.plastic_share += weighted_sum(work, AREA, listed.PLASTIC, n)


@kernel
def _energy(table: ContactTable, surface: Record, work: FloatArray, n: int) -> float:
    """Return the stored energy over σ of the ``n`` nodes in the list [N]."""
    total = 0.0
    for k in range(n):
        place = work[INTERVAL + k] + work[FRACTION + k]
        total += work[AREA + k] * stored_energy(table, surface.h_first + (place - 1.0) / surface.inverse_step)
    return total
