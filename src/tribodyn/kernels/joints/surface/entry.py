"""Entry velocities of patches, changed at accepted steps only; and their pressure field."""

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity
from tribodyn.kernels.joints.surface.data import NORMAL, POSITION, SurfaceData, table_of
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import forget, is_near, node_gap


@inlined
def node_approach(nodes: FloatArray, i: int, v: FloatArray, rate: FloatArray) -> float:
    """Return the approach speed δ̇ at node ``i`` [m/s]."""
    x, y, z = nodes[POSITION, i], nodes[POSITION + 1, i], nodes[POSITION + 2, i]
    along_x = v[0] + rate[1] * z - rate[2] * y
    along_y = v[1] + rate[2] * x - rate[0] * z
    along_z = v[2] + rate[0] * y - rate[1] * x
    return nodes[NORMAL, i] * along_x + nodes[NORMAL + 1, i] * along_y + nodes[NORMAL + 2, i] * along_z


@kernel
def update_entry_velocity(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, at_start: float
) -> None:
    """Let nodes enter and leave contact at the end of an accepted step.

    A node below the onset separation without a memory takes max(|δ̇|, v_min); one above the onset forgets.
    Points already in contact at the start of a run, where ``at_start`` is 1, take v_min.
    """
    tilt, entry_velocity = memory.scratch.tilt, memory.entry_velocity
    onset, heed = surface.onset * surface.roughness, 0.0 if at_start > 0.0 else 1.0
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        near = is_near(row, station, tilt.phi, onset - station.opening)
        if near:
            for i in range(np.uint64(row.first), np.uint64(row.first + row.count)):
                speed = node_approach(data.nodes, i, station.v, tilt.rate) - station.v_opening
                known = reference_velocity(entry_velocity[i], heed * speed, surface.minimum_entry_velocity)
                gap = node_gap(data.nodes, i, station.d, tilt.phi) + station.opening
                entry_velocity[i] = known if gap < onset else 0.0
        elif memory.remembering[r] > 0.0:
            forget(row.first, row.first + row.count, entry_velocity)
        memory.remembering[r] = 1.0 if near else 0.0


@kernel
def pressure_field(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, pressure: FloatArray
) -> None:
    """Fill the nodes of a surface in ``pressure`` (n_nodes,) with the contact pressure P_c [Pa]."""
    tilt, table = memory.scratch.tilt, table_of(data, surface)
    limit = surface.h_last * surface.roughness
    for i in range(surface.first_node, surface.last_node):
        gap = node_gap(data.nodes, i, station.d, tilt.phi) + station.opening
        pressure[i] = 0.0
        if gap < limit:
            _, found, _, _ = node_pressure(
                table,
                surface.roughness,
                surface.minimum_entry_velocity,
                surface.tensile_clip,
                gap,
                node_approach(data.nodes, i, station.v, tilt.rate) - station.v_opening,
                memory.entry_velocity[i],
            )
            pressure[i] = min(found, surface.hardness)
