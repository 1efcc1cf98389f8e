"""Entry velocities of a surface of revolution, changed at accepted steps only; and its pressure field."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import COS, GAP, SIN, SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import forget
from tribodyn.kernels.joints.surface.ring import (
    gap_and_approach,
    groups,
    law_of,
    motion_of,
    node_of,
    number_of_groups,
    place_of,
    reference_of,
)
from tribodyn.kernels.lanes import WIDTH, above, load, spread, store, zeros


@kernel
def update_entry_velocity(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, at_start: float
) -> None:
    """Let nodes enter and leave contact; arguments as for ``entry.update_entry_velocity``."""
    tilt, entry_velocity, limit = (
        memory.scratch.tilt,
        memory.entry_velocity,
        surface.onset * surface.roughness,
    )
    cos, sin, drawn = data.angles[COS], data.angles[SIN], data.nodes[GAP]
    onset, v_min = spread(limit), spread(surface.minimum_entry_velocity)
    heed = spread(0.0 if at_start > 0.0 else 1.0)
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        first, number = groups(row, surface, station, tilt, limit)
        if number == 0 and memory.remembering[r] == 0.0:
            continue
        motion = motion_of(data, surface, row, station, tilt)
        for group in range(first, first + number):
            angle, at = place_of(row, group)
            gap, approach = gap_and_approach(motion, load(drawn, at), load(cos, angle), load(sin, angle))
            known = reference_of(v_min, heed * approach, load(entry_velocity, at))
            store(entry_velocity, at, above(onset, gap, known, zeros()))
        again = max(first + number - number_of_groups(row), 0)
        forget(row.first + WIDTH * again, row.first + WIDTH * first, entry_velocity)
        until = min(WIDTH * (first + number), row.count)
        forget(row.first + until, row.first + row.count, entry_velocity)
        memory.remembering[r] = 1.0 if number > 0 else 0.0


@kernel
def pressure_field(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, pressure: FloatArray
) -> None:
    """Fill the nodes of a surface in ``pressure`` (n_nodes,) with the contact pressure P_c [Pa]."""
    cos, sin, drawn, law = data.angles[COS], data.angles[SIN], data.nodes[GAP], law_of(data, surface)
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        motion = motion_of(data, surface, row, station, memory.scratch.tilt)
        for group in range(number_of_groups(row)):
            angle, at = place_of(row, group)
            gap, approach = gap_and_approach(motion, load(drawn, at), load(cos, angle), load(sin, angle))
            store(pressure, at, node_of(law, gap, approach, load(memory.entry_velocity, at)).pressure)
