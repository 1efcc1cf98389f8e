"""Entry velocities of a surface of revolution, changed at accepted steps only; and its pressure field."""

import math

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.block import fill_motion, fill_windows, groups_of, rings_from
from tribodyn.kernels.joints.surface.bulk import fill_block
from tribodyn.kernels.joints.surface.data import COS, GAP, SIN, SurfaceData
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import forget
from tribodyn.kernels.joints.surface.ring import (
    PRESSURE,
    STRIDE,
    WRENCH,
    does_bend,
    motion_of,
    number_of_groups,
    place_of,
    reference_of,
    wave,
)
from tribodyn.kernels.lanes import WIDTH, above, load, spread, store, zeros


@kernel
def update_entry_velocity(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, at_start: float
) -> None:
    """Let nodes enter and leave contact."""
    limit, heed = surface.onset * surface.roughness, 0.0 if at_start > 0.0 else 1.0
    for r in range(surface.first_row, surface.last_row, WIDTH):
        if fill_windows(data, surface, memory, station, r, limit, 1.0) > 0:
            fill_motion(data, surface, memory, station, r)
        for k in range(rings_from(surface, r)):
            first, number = groups_of(memory.block, k)
            if number > 0:
                _remember(data, surface, memory, r, k, heed)
            if number > 0 or memory.remembering[r + k] > 0.0:
                _forget(data.rows[r + k], first, number, memory.entry_velocity)
            memory.remembering[r + k] = 1.0 if number > 0 else 0.0


@kernel
def _remember(data: SurfaceData, surface: Record, memory: SurfaceMemory, r: int, k: int, heed: float) -> None:
    """Fill the entry velocities of ring ``k`` of the block that begins at row ``r``, within its window."""
    cos, sin, drawn, known = data.angles[COS], data.angles[SIN], data.nodes[GAP], memory.entry_velocity
    onset, v_min = spread(surface.onset * surface.roughness), spread(surface.minimum_entry_velocity)
    motion, heeded, bends = motion_of(memory.block, k), spread(heed), does_bend(surface)
    first, number = groups_of(memory.block, k)
    for group in range(first, first + number):
        angle, at = place_of(data.rows[r + k], group)
        c, s = load(cos, angle), load(sin, angle)
        gap = load(drawn, at) + wave(motion.gap, bends, c, s)
        entry = reference_of(v_min, heeded * wave(motion.approach, bends, c, s), load(known, at))
        store(known, at, above(onset, gap, entry, zeros()))


@kernel
def _forget(row: Record, first: int, number: int, entry_velocity: FloatArray) -> None:
    """Clear the entry velocities of a ring outside of its window."""
    again = max(first + number - number_of_groups(row), 0)
    forget(row.first + WIDTH * again, row.first + WIDTH * first, entry_velocity)
    until = min(WIDTH * (first + number), row.count)
    forget(row.first + until, row.first + row.count, entry_velocity)


@kernel
def pressure_field(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, pressure: FloatArray
) -> None:
    """Fill the nodes of a surface in ``pressure`` (n_nodes,) with the contact pressure P_c [Pa]."""
    block = memory.block
    for r in range(surface.first_row, surface.last_row, WIDTH):
        fill_windows(data, surface, memory, station, r, math.inf, 1.0)
        fill_block(data, surface, memory, station, r, WRENCH)
        at = BLOCK_GROUPS
        for k in range(rings_from(surface, r)):
            number = number_of_groups(data.rows[r + k])
            for group in range(number - 1, -1, -1):  # the last one has no pressure where it repeats nodes
                _, node = place_of(data.rows[r + k], group)
                store(pressure, node, load(block, at + STRIDE * group + PRESSURE))
            at += STRIDE * number
