"""Nodes within reach of contact, gathered from all patches of a surface into one list.

Sums over nodes are loops over this list, filled and summed a part at a time: long enough for the processor to
take four nodes at once, however few are in reach in a row.
"""

import math

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.columns import APPROACH, AREA, ENTRY, FRACTION, INTERVAL, PART, PITCH, end_list
from tribodyn.kernels.joints.surface.data import AREA as NODE_AREA
from tribodyn.kernels.joints.surface.data import GAP, SurfaceData
from tribodyn.kernels.joints.surface.data import NORMAL as NODE_NORMAL
from tribodyn.kernels.joints.surface.data import POSITION as NODE_POSITION
from tribodyn.kernels.joints.surface.listed import MOMENT, NORMAL, POSITION
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.lookup import interval


@kernel
def is_near(row: Record, station: Record, phi: FloatArray, limit: float) -> bool:
    """Return whether gaps of a patch can be below ``limit`` [m]; it is looked at as a whole."""
    d = station.d
    near = row.normal[0] * d[0] + row.normal[1] * d[1] + row.normal[2] * d[2]
    near += row.moment[0] * phi[0] + row.moment[1] * phi[1] + row.moment[2] * phi[2]
    near += row.spread[0] * math.sqrt(d[0] ** 2 + d[1] ** 2 + d[2] ** 2)
    near += row.spread[1] * math.sqrt(phi[0] ** 2 + phi[1] ** 2 + phi[2] ** 2)
    return not row.least - near >= limit  # this way round for NaN


@inlined
def node_gap(nodes: FloatArray, i: int, d: FloatArray, phi: FloatArray) -> float:
    """Return the gap at node ``i`` of a patch [m]."""
    x, y, z = nodes[NODE_POSITION, i], nodes[NODE_POSITION + 1, i], nodes[NODE_POSITION + 2, i]
    along_x = d[0] + phi[1] * z - phi[2] * y
    along_y = d[1] + phi[2] * x - phi[0] * z
    along_z = d[2] + phi[0] * y - phi[1] * x
    near = nodes[NODE_NORMAL, i] * along_x + nodes[NODE_NORMAL + 1, i] * along_y
    return nodes[GAP, i] - (near + nodes[NODE_NORMAL + 2, i] * along_z)


@inlined
def _load(
    nodes: FloatArray,
    entry_velocity: FloatArray,
    scratch: Record,
    scale: float,
    shift: float,
    last: float,
    station: Record,
    first: int,
    size: int,
    at: int,
) -> None:
    """Write ``size`` nodes from ``first`` on into the list, from place ``at`` on."""
    work, node = scratch.listed.work, scratch.listed.node
    phi, rate = scratch.tilt.phi, scratch.tilt.rate
    d_x, d_y, d_z = station.d[0], station.d[1], station.d[2]
    v_x, v_y, v_z, v_opening = station.v[0], station.v[1], station.v[2], station.v_opening
    phi_x, phi_y, phi_z = phi[0], phi[1], phi[2]
    rate_x, rate_y, rate_z = rate[0], rate[1], rate[2]
    source = np.uint64(first)  # unsigned, so that no index is taken from the end
    at = min(max(at, 0), PART)
    for k in range(min(size, PART - at)):
        i, n = source + np.uint64(k), at + k
        x, y, z = nodes[NODE_POSITION, i], nodes[NODE_POSITION + 1, i], nodes[NODE_POSITION + 2, i]
        n_x, n_y, n_z = nodes[NODE_NORMAL, i], nodes[NODE_NORMAL + 1, i], nodes[NODE_NORMAL + 2, i]
        m_x, m_y, m_z = y * n_z - z * n_y, z * n_x - x * n_z, x * n_y - y * n_x
        near = n_x * d_x + n_y * d_y + n_z * d_z + m_x * phi_x + m_y * phi_y + m_z * phi_z
        number, place = interval(shift + scale * (nodes[GAP, i] - near), last)
        work[INTERVAL + n] = number
        work[FRACTION + n] = place
        nearing = n_x * v_x + n_y * v_y + n_z * v_z + m_x * rate_x + m_y * rate_y + m_z * rate_z
        work[APPROACH + n] = nearing - v_opening
        work[ENTRY + n] = entry_velocity[i]
        work[AREA + n] = nodes[NODE_AREA, i]
        work[POSITION + n] = x
        work[POSITION + PITCH + n] = y
        work[POSITION + 2 * PITCH + n] = z
        work[NORMAL + n] = n_x
        work[NORMAL + PITCH + n] = n_y
        work[NORMAL + 2 * PITCH + n] = n_z
        work[MOMENT + n] = m_x
        work[MOMENT + PITCH + n] = m_y
        work[MOMENT + 2 * PITCH + n] = m_z
        node[n] = i


@kernel
def forget(first: int, until: int, entry_velocity: FloatArray) -> None:
    """Clear the entry velocities of nodes ``first`` to ``until``."""
    for i in range(np.uint64(first), np.uint64(until)):
        entry_velocity[i] = 0.0


@kernel
def rewind(surface: Record, memory: SurfaceMemory) -> None:
    """Begin the list anew."""
    cursor = memory.scratch.listed.cursor
    cursor[0], cursor[1] = surface.first_row, 0


@kernel
def gather(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record) -> int:
    """Fill the next part of the list and return the number of its nodes, 0 after the last one."""
    nodes, entry_velocity, scratch = data.nodes, memory.entry_velocity, memory.scratch
    cursor, phi = scratch.listed.cursor, scratch.tilt.phi
    limit = surface.h_last * surface.roughness
    last = float(surface.last_interval - surface.first_interval - 1)
    scale = surface.inverse_step / surface.roughness
    shift = 1.0 - surface.h_first * surface.inverse_step + scale * station.opening
    r, taken, n = cursor[0], cursor[1], 0
    while r < surface.last_row and n < PART:
        row, left = data.rows[r], 0
        if is_near(row, station, phi, limit - station.opening):
            size = min(row.count - taken, PART - n)
            _load(nodes, entry_velocity, scratch, scale, shift, last, station, row.first + taken, size, n)
            n, taken = n + size, taken + size
            left = row.count - taken
        if left == 0:
            r, taken = r + 1, 0
    cursor[0], cursor[1] = r, taken
    end_list(scratch.listed.work, n)
    return n
