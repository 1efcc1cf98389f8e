"""Report of a surface of revolution at one instant, and how it slides."""

from __future__ import annotations

import math
from typing import Any

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels import extremes
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_motion, fill_windows, groups_of, rings_from
from tribodyn.kernels.joints.surface.data import RADIUS, SurfaceData
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    APPROACH,
    COSINE,
    DRAG_SPEED,
    ENERGY,
    POSITION,
    PRESSURE,
    REPORT,
    RIGID,
    SINE,
    SQUARE,
    STRIDE,
    fill_groups,
    fill_pressures,
    place_of,
)
from tribodyn.kernels.joints.surface.ring_sums import (
    Pressures,
    no_pressure,
    one_ring,
    put_pressures,
    with_pressure,
    with_pressures_of,
)
from tribodyn.kernels.joints.surface.ring_wrench import no_forces, put_forces, with_forces_of
from tribodyn.kernels.lanes import (
    WIDTH,
    above,
    absolute,
    larger,
    load,
    parts,
    smaller,
    spread,
    square_root,
    store,
    total,
    zeros,
)

Terms = tuple[Any, Any, Any, Any, Any]
"""Energy over σ, power of damping and of friction over −μ, area in contact, and area where it pulls."""
Rest = tuple[Pressures, Any, Terms, Any, Any]
"""Sums of rigid pressures, ∫P_k dA, the terms, highest pressure and nearest place in the table."""


@kernel
def add_rows(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> float:
    """Fill the sums over the nodes of rings in the report; return the nearest place in the table."""
    surface, out, scratch = data.surfaces[s], memory.reports[s], memory.scratch
    limit, kept = surface.h_last * surface.roughness, first_kept(surface)
    forces, terms = no_forces(), (zeros(), zeros(), zeros(), zeros(), zeros())
    rest = no_pressure(), zeros(), terms, zeros(), spread(math.inf)
    for r in range(surface.first_row, surface.last_row, WIDTH):
        found = fill_windows(data, surface, memory, station, r, limit, 1.0)
        for k in range(rings_from(surface, r)):
            memory.reached[r + k, 0], memory.reached[r + k, 1] = groups_of(memory.block, k)
        if found > 0:
            fill_motion(data, surface, memory, station, r)
            end = fill_groups(data, surface, memory, r, REPORT)
            fill_pressures(data, surface, memory, end, REPORT)
            forces = with_forces_of(forces, data.rings, surface, memory, r)
            rest = _with_rest_of(rest, data.rings, surface, memory, station, r, kept)
            kept += WIDTH * found
    put_forces(surface, station, forces, scratch)
    put_pressures(rest[0], scratch.rigid)
    scratch.rigid_load = total(rest[1])
    _put_terms(surface, rest[2], out)
    a, b, c, d = parts(rest[3])
    out.p_max = extremes.larger(extremes.larger(a, b), extremes.larger(c, d))
    a, b, c, d = parts(rest[4])
    return extremes.smaller(extremes.smaller(a, b), extremes.smaller(c, d))


@inlined
def _with_rest_of(
    rest: Rest,
    rings: FloatArray,
    surface: Record,
    memory: SurfaceMemory,
    station: Record,
    r: int,
    kept: int,
) -> Rest:
    """Return the sums with those of the block of rings that begins at row ``r``; keep what slides."""
    block, zero, one, at = memory.block, zeros(), spread(1.0), BLOCK_GROUPS
    normal, pushed, terms, highest, nearest = rest
    onset = spread((surface.onset - surface.h_first) * surface.inverse_step + 1.0)
    torque = spread(station.direction * surface.torque_radius * station.w[2])
    for k in range(rings_from(surface, r)):
        sums, energy, heat, friction, touched, pulled, begin = no_pressure(), zero, zero, zero, zero, zero, at
        spin = absolute(spread(station.w[2] * rings[RADIUS, r + k]))
        at += STRIDE * groups_of(block, k)[1]
        for group in range(begin, at, STRIDE):
            rigid, p, position = (
                load(block, group + RIGID),
                load(block, group + PRESSURE),
                load(block, group + POSITION),
            )
            sums = with_pressure(sums, rigid, load(block, group + COSINE), load(block, group + SINE))
            energy = energy + load(block, group + ENERGY)
            heat = heat + (p - rigid) * load(block, group + APPROACH)
            friction = friction + p * (
                torque if surface.torque_radius > 0.0 else load(block, group + DRAG_SPEED)
            )
            touching = above(onset, position, one, zero)
            touched, pulled = touched + touching, pulled + above(p, zero, zero, touching)
            highest, nearest = larger(highest, p), smaller(nearest, position)
            speed = square_root(load(block, group + SQUARE)) if surface.along > 0.0 else spin
            store(memory.sliding, kept, p * speed)
            kept += WIDTH
        ring = one_ring(rings, r + k)
        area = ring.area
        normal = with_pressures_of(normal, ring, surface.lean, memory.scratch.tilt.phi, sums)
        pushed = pushed + area * sums[0]
        terms = (
            terms[0] + area * energy,
            terms[1] + area * heat,
            terms[2] + area * friction,
            terms[3] + area * touched,
            terms[4] + area * pulled,
        )
    return normal, pushed, terms, highest, nearest


@inlined
def _put_terms(surface: Record, sums: Terms, out: Record) -> None:
    """Fill the terms in the report."""
    out.energy_contact = surface.roughness * total(sums[0])
    out.damping_power = total(sums[1])
    out.friction_power = -surface.friction_coefficient * total(sums[2])
    out.contact_fraction, out.tensile_clip_share = total(sums[3]), total(sums[4])


@inlined
def first_kept(surface: Record) -> int:
    """Return where a surface keeps what slides: each row has room for a last group that repeats nodes."""
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
