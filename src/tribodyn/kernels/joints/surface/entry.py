"""Entry velocities of a surface, changed at accepted steps only; and its pressure field."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity
from tribodyn.kernels.joints.surface.data import NORMAL, POSITION, SurfaceData, table_of
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.nodes import node_gap, window


@inlined
def node_approach(nodes: FloatArray, i: int, lean: float, v: FloatArray, tilt: Record) -> float:
    """Return the approach speed δ̇ at node ``i`` [m/s]."""
    phi, rate = tilt.phi, tilt.rate
    x, y = nodes[POSITION, i], nodes[POSITION + 1, i]
    z = nodes[POSITION + 2, i] + lean * (nodes[NORMAL, i] * phi[1] - nodes[NORMAL + 1, i] * phi[0])
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
    Points already in contact at the start of a run take v_min.

    Parameters
    ----------
    data, surface, memory, station
        As for ``wrench``; the entry velocities are changed in place.
    at_start
        1 at the start of a run, 0 otherwise.
    """
    tilt, entry_velocity = memory.scratch.tilt, memory.entry_velocity
    onset, heed = surface.onset * surface.roughness, 0.0 if at_start > 0.0 else 1.0
    law = (onset, surface.minimum_entry_velocity, heed, surface.lean)
    for r in range(surface.first_row, surface.last_row):
        row = data.rows[r]
        first, count = window(row, surface.lean, station.d, tilt.phi, onset)
        if count == 0 and memory.remembering[r] == 0.0:
            continue
        until = min(first + count, row.count)
        again = first + count - until
        _update(data.nodes, row.first + first, row.first + until, station, tilt, law, entry_velocity)
        _update(data.nodes, row.first, row.first + again, station, tilt, law, entry_velocity)
        _forget(row.first + again, row.first + first, entry_velocity)
        _forget(row.first + until, row.first + row.count, entry_velocity)
        memory.remembering[r] = 1.0 if count > 0 else 0.0


@kernel
def _update(
    nodes: FloatArray,
    first: int,
    until: int,
    station: Record,
    tilt: Record,
    law: tuple[float, float, float, float],
    entry_velocity: FloatArray,
) -> None:
    """Update nodes ``first`` to ``until`` by onset [m], v_min, whether to heed the approach, and ``lean``."""
    onset, v_min, heed, lean = law
    for i in range(np.uint64(first), np.uint64(until)):
        known = reference_velocity(
            entry_velocity[i], heed * node_approach(nodes, i, lean, station.v, tilt), v_min
        )
        entry_velocity[i] = known if node_gap(nodes, i, lean, station.d, tilt.phi) < onset else 0.0


@kernel
def _forget(first: int, until: int, entry_velocity: FloatArray) -> None:
    """Clear nodes ``first`` to ``until``."""
    for i in range(np.uint64(first), np.uint64(until)):
        entry_velocity[i] = 0.0


@kernel
def pressure_field(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, pressure: FloatArray
) -> None:
    """Fill the nodes of a surface in ``pressure`` (n_nodes,) with the contact pressure P_c [Pa]."""
    tilt, table = memory.scratch.tilt, table_of(data, surface)
    limit = surface.h_last * surface.roughness
    for i in range(surface.first_node, surface.last_node):
        gap = node_gap(data.nodes, i, surface.lean, station.d, tilt.phi)
        pressure[i] = 0.0
        if gap < limit:
            _, pressure[i], _, _ = node_pressure(
                table,
                surface.roughness,
                surface.minimum_entry_velocity,
                surface.tensile_clip,
                gap,
                node_approach(data.nodes, i, surface.lean, station.v, tilt),
                memory.entry_velocity[i],
            )
