"""Report of a surface of revolution at one instant, and how it slides."""

from __future__ import annotations

import math
from typing import Any

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels import extremes
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.data import AREA, COS, GAP, LIFT, POSITION, SIN, SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    Law,
    Node,
    add_friction,
    add_pressures,
    energy_of,
    gap_and_approach,
    groups,
    law_of,
    motion_of,
    no_pressure,
    no_traction,
    node_of,
    place_of,
    slip_of,
    with_pressure,
    with_traction,
)
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
"""Sums of energy over σ, power of damping and of friction over −μ, nodes in contact, and where these pull."""


@inlined
def _with_terms(
    sums: Terms, law: Law, energy: FloatArray, onset: Any, node: Node, approach: Any, friction: Any
) -> Terms:
    """Return the sums with those of four more nodes."""
    zero = zeros()
    touching = above(onset, node.position, spread(1.0), zero)
    return (
        sums[0] + energy_of(law, energy, node),
        sums[1] + (node.pressure - node.rigid) * approach,
        sums[2] + friction,
        sums[3] + touching,
        sums[4] + above(node.pressure, zero, zero, touching),
    )


@inlined
def _add_terms(surface: Record, area: float, sums: Terms, out: Record) -> None:
    """Add the sums of a row whose nodes have an area [m²] to the report."""
    out.energy_contact += area * surface.roughness * total(sums[0])
    out.damping_power += area * total(sums[1])
    out.friction_power -= area * surface.friction_coefficient * total(sums[2])
    out.contact_fraction += area * total(sums[3])
    out.tensile_clip_share += area * total(sums[4])


@kernel
def add_rows(data: SurfaceData, s: int, memory: SurfaceMemory, station: Record) -> float:
    """Add the sums over the nodes of rings to the report; return the nearest place in the table."""
    surface, out, scratch, tilt = data.surfaces[s], memory.reports[s], memory.scratch, memory.scratch.tilt
    cos, sin, lift, drawn = data.angles[COS], data.angles[SIN], data.angles[LIFT], data.nodes[GAP]
    limit, law, kept = surface.h_last * surface.roughness, law_of(data, surface), first_kept(surface)
    energy = data.energy[surface.first_interval : surface.last_interval]
    onset = spread((surface.onset - surface.h_first) * surface.inverse_step + 1.0)
    torque = spread(station.direction * surface.torque_radius * station.w[2])
    highest, nearest = zeros(), spread(math.inf)
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        first, number = groups(row, surface, station, tilt, limit)
        memory.reached[r, 0], memory.reached[r, 1] = first, number
        if number == 0:
            continue
        motion = motion_of(data, surface, row, station, tilt)
        pressures, rigids, tractions = no_pressure(), no_pressure(), no_traction()
        spin = absolute(spread(station.w[2] * data.nodes[POSITION, row.first]))
        terms = zeros(), zeros(), zeros(), zeros(), zeros()
        for group in range(first, first + number):
            angle, at = place_of(row, group)
            c, s = load(cos, angle), load(sin, angle)
            gap, approach = gap_and_approach(motion, load(drawn, at) + load(lift, angle), c, s)
            node = node_of(law, gap, approach, load(memory.entry_velocity, at))
            around, along, square = slip_of(motion, c, s)
            drag = node.pressure / square_root(square + law.square)
            pressures = with_pressure(pressures, node.pressure, c, s)
            rigids = with_pressure(rigids, node.rigid, c, s)
            tractions = with_traction(tractions, drag * around, drag * along, c, s)
            friction = node.pressure * torque if surface.torque_radius > 0.0 else drag * square
            terms = _with_terms(terms, law, energy, onset, node, approach, friction)
            highest, nearest = larger(highest, node.pressure), smaller(nearest, node.position)
            speed = square_root(square) if surface.along > 0.0 else spin
            store(memory.sliding, kept, node.pressure * speed)
            kept += WIDTH
        add_pressures(data, surface, row, tilt.phi, pressures, scratch.normal)
        add_pressures(data, surface, row, tilt.phi, rigids, scratch.rigid)
        add_friction(data, surface, row, station.direction, pressures, tractions, scratch.friction)
        scratch.rigid_load += data.nodes[AREA, row.first] * total(rigids[0])
        _add_terms(surface, data.nodes[AREA, row.first], terms, out)
    a, b, c, d = parts(highest)
    out.p_max = extremes.larger(extremes.larger(a, b), extremes.larger(c, d))
    a, b, c, d = parts(nearest)
    return extremes.smaller(extremes.smaller(a, b), extremes.smaller(c, d))


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
