"""Report of a surface of revolution at one instant, and how it slides."""

import math
from typing import Any

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels import jit
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_windows, groups_of, rings_from
from tribodyn.kernels.joints.surface.bulk import CHANGE, PEAK, WIDENING, fill_block
from tribodyn.kernels.joints.surface.data import RADIUS, SurfaceData
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    ALONG_UNIT,
    AROUND_UNIT,
    COSINE,
    ENERGY,
    POSITION,
    PRESSURE,
    REPORT,
    RIGID,
    SINE,
    SPEED,
    STRIDE,
    BentWave,
    Wave,
    does_bend,
    motion_of,
    place_of,
)
from tribodyn.kernels.joints.surface.ring_wrench import (
    Forces,
    Pressures,
    no_forces,
    no_pressure,
    no_traction,
    one_ring,
    put_forces,
    put_pressures,
    with_pressure,
    with_pressures_of,
    with_ring,
    with_traction,
)
from tribodyn.kernels.lanes import WIDTH, above, absolute, load, parts, spread, store, total, zeros

#: Energy over σ, power of damping and of friction over −μ, areas in contact, that pull and are plastic, and
#: the power over σ of a contact that changes its extent on the energy.
Terms = tuple[Any, Any, Any, Any, Any, Any, Any]
#: Sums of rigid pressures, ∫P_k dA, the terms, highest pressure and nearest place in the table.
Rest = tuple[Pressures, Any, Terms, Any, Any]


@kernel
def add_rows(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> float:
    """Fill the sums over the nodes of rings in the report; return the nearest place in the table."""
    surface, out, scratch = data.surfaces[s], memory.reports[s], memory.scratch
    limit, kept = surface.h_last * surface.roughness, first_kept(surface)
    forces, terms = no_forces(), (zeros(), zeros(), zeros(), zeros(), zeros(), zeros(), zeros())
    rest = no_pressure(), zeros(), terms, zeros(), spread(math.inf)
    for r in range(surface.first_row, surface.last_row, WIDTH):
        found = fill_windows(data, surface, memory, station, r, limit, 1.0)
        for k in range(rings_from(surface, r)):
            memory.reached[r + k, 0], memory.reached[r + k, 1] = groups_of(memory.block, k)
        if found > 0:
            fill_block(data, surface, memory, station, r, REPORT)
            forces, rest = _with_rings(forces, rest, data.rings, surface, memory, station, r, kept)
            kept += WIDTH * found
    put_forces(surface, station, forces, scratch)
    put_pressures(rest[0], scratch.rigid)
    scratch.rigid_load = total(rest[1])
    _put_terms(surface, rest[2], out)
    a, b, c, d = parts(rest[3])
    out.p_max = jit.larger(jit.larger(a, b), jit.larger(c, d))
    if math.isnan(scratch.normal[0]):
        out.p_max = math.nan
    a, b, c, d = parts(rest[4])
    nearest = jit.smaller(jit.smaller(a, b), jit.smaller(c, d))
    return math.nan if math.isnan(scratch.rigid_load) else nearest


@inlined
def _with_rings(
    forces: Forces,
    rest: Rest,
    rings: FloatArray,
    surface: Record,
    memory: SurfaceMemory,
    station: Record,
    r: int,
    kept: int,
) -> tuple[Forces, Rest]:
    """Return the sums with those of the block of rings that begins at row ``r``; keep what slides."""
    block, zero, one, at, bends = memory.block, zeros(), spread(1.0), BLOCK_GROUPS, does_bend(surface)
    normal, pushed, terms, highest, nearest = rest
    onset = spread((surface.onset - surface.h_first) * surface.inverse_step + 1.0)
    torque, spins = station.direction * surface.torque_radius * station.w[2], surface.along == 0.0
    elastic, hardness = surface.levels > 0.0, spread(surface.hardness)
    for k in range(rings_from(surface, r)):
        pressures, tractions, rigids, begin = no_pressure(), no_traction(), no_pressure(), at
        energy, touched, pulled, plastic, widening = zero, zero, zero, zero, zero
        spin = absolute(spread(station.w[2] * rings[RADIUS, r + k]))
        at += STRIDE * groups_of(block, k)[1]
        for group in range(begin, at, STRIDE):
            c, s, p = load(block, group + COSINE), load(block, group + SINE), load(block, group + PRESSURE)
            rigid, position = load(block, group + RIGID), load(block, group + POSITION)
            t, b = p * load(block, group + AROUND_UNIT), p * load(block, group + ALONG_UNIT)
            pressures = with_pressure(pressures, p, bends, c, s)
            tractions = with_traction(tractions, t, b, c, s)
            rigids = with_pressure(rigids, rigid, bends, c, s)
            energy = energy + load(block, group + ENERGY)
            touching = above(onset, position, one, zero)
            touched, pulled = touched + touching, pulled + above(p, zero, zero, touching)
            plastic = plastic + above(hardness, p, zero, one)
            if elastic:
                widening = widening + load(block, group + WIDENING)
            # What is not a number gets lost here; sums know of it.
            peak = load(block, group + PEAK) if elastic else p
            highest = above(peak, highest, peak, highest)
            nearest = above(nearest, position, position, nearest)
            store(memory.sliding, kept, p * (spin if spins else load(block, group + SPEED)))
            kept += WIDTH
        ring, phi, motion = one_ring(rings, r + k), memory.scratch.tilt.phi, motion_of(block, k)
        forces = with_ring(forces, ring, surface.lean, phi, pressures, tractions)
        normal = with_pressures_of(normal, ring, surface.lean, phi, rigids)
        area, power = ring.area, _power(motion.around, tractions[:3]) + _power(motion.along, tractions[3:])
        damped = _bent_power(motion.approach, pressures) - _bent_power(motion.approach, rigids)
        pushed = pushed + area * rigids[0]
        terms = (
            terms[0] + area * energy,
            terms[1] + area * damped,
            terms[2] + area * (spread(torque) * pressures[0] if surface.torque_radius > 0.0 else power),
            terms[3] + area * touched,
            terms[4] + area * pulled,
            terms[5] + area * plastic,
            terms[6] + area * (spread(block[CHANGE + k]) * widening if elastic else widening),
        )
    return forces, (normal, pushed, terms, highest, nearest)


@inlined
def _power(speed: Wave, sums: Any) -> Any:
    """Return the power per area of what has the sums of 1, c, s, at a speed."""
    return speed[0] * sums[0] + speed[1] * sums[1] + speed[2] * sums[2]


@inlined
def _bent_power(speed: BentWave, sums: Pressures) -> Any:
    """Return the same at a bent speed."""
    return _power(speed[:3], sums[:3]) + (speed[3] * sums[3] + speed[4] * sums[4])


@inlined
def _put_terms(surface: Record, sums: Terms, out: Record) -> None:
    """Fill the terms in the report."""
    out.energy_contact = surface.roughness * total(sums[0])
    out.damping_power = total(sums[1])
    out.friction_power = -surface.friction_coefficient * total(sums[2])
    out.contact_fraction, out.tensile_clip_share = total(sums[3]), total(sums[4])
    out.plastic_share, out.expansion_power = total(sums[5]), surface.roughness * total(sums[6])


@inlined
def first_kept(surface: Record) -> int:
    """Return the place of a surface's sliding loads: rows have room for a last group that repeats nodes."""
    return surface.first_node + (WIDTH - 1) * surface.first_row


@kernel
def slide(data: SurfaceData, surface: Record, memory: SurfaceMemory, h: float) -> None:
    """Let a surface slide for ``h`` [s] as it did at the last report: add to the sliding load."""
    kept, time, worn = first_kept(surface), spread(h), memory.sliding_load
    for r in range(surface.first_row, surface.last_row):
        first, number = memory.reached[r, 0], memory.reached[r, 1]
        for group in range(first, first + number):
            _, at = place_of(data.rows[r], group)
            store(worn, at, load(worn, at) + time * load(memory.sliding, kept))
            kept += WIDTH
