"""Wrench of a surface of revolution: sums over the nodes of a row, carried to the origin once a row."""

from __future__ import annotations

from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import COS, GAP, LIFT, SIN, SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    add_friction,
    add_pressures,
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
from tribodyn.kernels.lanes import load, square_root


@kernel
def wrench(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record) -> None:
    """Fill ``normal`` and ``friction`` of the scratch; arguments as for ``wrench.wrench``."""
    tilt, entry_velocity = memory.scratch.tilt, memory.entry_velocity
    normal, friction = memory.scratch.normal, memory.scratch.friction
    cos, sin, lift, drawn = data.angles[COS], data.angles[SIN], data.angles[LIFT], data.nodes[GAP]
    limit, law = surface.h_last * surface.roughness, law_of(data, surface)
    for k in range(6):
        normal[k] = friction[k] = 0.0
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        first, number = groups(row, surface, station, tilt, limit) if row.area > 0.0 else (0, 0)
        if number == 0:
            continue
        motion = motion_of(data, surface, row, station, tilt)
        pressures, tractions = no_pressure(), no_traction()
        for group in range(first, first + number):
            angle, at = place_of(row, group)
            c, s = load(cos, angle), load(sin, angle)
            gap, approach = gap_and_approach(motion, load(drawn, at) + load(lift, angle), c, s)
            node = node_of(law, gap, approach, load(entry_velocity, at))
            around, along, square = slip_of(motion, c, s)
            drag = node.pressure / square_root(square + law.square)
            pressures = with_pressure(pressures, node.pressure, c, s)
            tractions = with_traction(tractions, drag * around, drag * along, c, s)
        add_pressures(data, surface, row, tilt.phi, pressures, normal)
        add_friction(data, surface, row, station.direction, pressures, tractions, friction)
