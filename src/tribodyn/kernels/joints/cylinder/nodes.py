"""Nodes within reach of contact, gathered from all rows into one list.

Sums over nodes are loops over this list: long enough for the processor to take four nodes at once, whatever
the width of the window in a row. The list is filled and summed a part at a time, so that it stays in the
nearest cache. It is held by the scratch of the joint's memory.
"""

from __future__ import annotations

import math

import numpy as np

from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.window import contact_window
from tribodyn.kernels.joints.listed import (
    APPROACH,
    AREA,
    COS,
    DAMPING,
    ENTRY,
    FRACTION,
    INTERVAL,
    MOMENT,
    PART,
    RIGID,
    SIN,
    SLIP,
)
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.lookup import cubic, interval, last_interval, offset


@inlined
def row_motion(pose: Record, tan_x: float, tan_y: float, z: float) -> tuple[float, float, float, float]:
    """Return offset (a, b) [m] and velocity (v_a, v_b) [m/s] of the trunnion axis at height ``z`` [m].

    ``tan_x`` and ``tan_y`` are the tangents of the tilts, the same for every row.
    """
    a = pose.d_x + z * tan_y
    b = pose.d_y - z * tan_x
    v_a = pose.v_x + z * pose.w_y * (1.0 + tan_y * tan_y)
    v_b = pose.v_y - z * pose.w_x * (1.0 + tan_x * tan_x)
    return a, b, v_a, v_b


@inlined
def lean(pose: Record) -> tuple[float, float, float, float]:
    """Return the slope l of the axis along X and Y [1], and its rates [1/s].

    The cross-section of a tilted trunnion is an ellipse: gaps are smaller by ½ r_j w², w = l·(cos θ, sin θ).
    """
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    return tan_y, -tan_x, pose.w_y * (1.0 + tan_y * tan_y), -pose.w_x * (1.0 + tan_x * tan_x)


@inlined
def least_clearance(joint: BushingData, pose: Record) -> float:
    """Return a lower bound of the clearance less ½ r_j w² [m], for windows of contact."""
    l_a, l_b, _, _ = lean(pose)
    return joint.clearance + pose.opening - 0.5 * joint.journal_radius * (l_a * l_a + l_b * l_b)


@inlined
def _load(
    joint: BushingData,
    memory: JointMemory,
    row: int,
    first: int,
    size: int,
    at: int,
    a: float,
    b: float,
    v_a: float,
    v_b: float,
    leaning: tuple[float, float, float, float],
    slip: float,
    clearance: float,
    v_opening: float,
) -> None:
    """Write ``size`` nodes of a row with given offset and velocity into the list, from place ``at`` on."""
    work, cos, sin, wear = memory.scratch.listed.work, joint.cos_theta, joint.sin_theta, joint.wear
    entry_velocity = memory.entry_velocity
    l_a, l_b, v_la, v_lb = leaning
    radius = joint.journal_radius
    area = joint.area[row]
    moment = area * joint.z[row]
    last = last_interval(joint.table)
    scale = joint.table.inverse_step / joint.roughness
    shift = 1.0 - joint.table.h_first * joint.table.inverse_step + clearance * scale
    # Unsigned, so that no index is taken from the end.
    source, j = np.uint64(first), np.uint64(row)
    at = min(max(at, 0), PART)
    for k in range(min(size, PART - at)):
        i, n = source + np.uint64(k), at + k
        c, s = cos[i], sin[i]
        w = l_a * c + l_b * s
        taken = radius * w
        number, x = interval(shift + scale * (a * c + b * s - 0.5 * taken * w + wear[j, i]), last)
        work[INTERVAL + n] = number
        work[FRACTION + n] = x
        work[COS + n] = c
        work[SIN + n] = s
        work[APPROACH + n] = taken * (v_la * c + v_lb * s) - (v_a * c + v_b * s + v_opening)
        work[SLIP + n] = slip + v_a * s - v_b * c
        work[ENTRY + n] = entry_velocity[j, i]
        work[AREA + n] = area
        work[MOMENT + n] = moment


@kernel
def rewind(memory: JointMemory) -> None:
    """Begin the list anew."""
    cursor = memory.scratch.listed.cursor
    cursor[0] = cursor[1] = 0


@kernel
def gather(joint: BushingData, memory: JointMemory, pose: Record, with_edges: float) -> int:
    """Fill the next part of the list and return the number of its nodes, 0 after the last one.

    Parameters
    ----------
    joint, memory, pose
        As for ``wrench``.
    with_edges
        1 if the rows on the edges, which stand for no area, are wanted too, 0 otherwise.
    """
    listed, n_theta = memory.scratch.listed, joint.cos_theta.size
    cursor, pieces = listed.cursor, listed.pieces
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    row, taken, n, n_pieces = cursor[0], cursor[1], 0, 0
    slip = pose.w_z * joint.journal_radius
    clearance, v_opening = joint.clearance + pose.opening, pose.v_opening
    leaning, least = lean(pose), least_clearance(joint, pose)
    while row < joint.z.size and n < PART:
        left = 0
        if with_edges > 0.0 or joint.area[row] > 0.0:
            a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, joint.z[row])
            first, count = contact_window(least, a, b, limit, n_theta)
            left = count - taken
            while left > 0 and n < PART:
                start = first + taken if first + taken < n_theta else first + taken - n_theta
                size = min(left, n_theta - start, PART - n)
                _load(
                    joint,
                    memory,
                    row,
                    start,
                    size,
                    n,
                    a,
                    b,
                    v_a,
                    v_b,
                    leaning,
                    slip,
                    clearance,
                    v_opening,
                )
                n_pieces += 1
                pieces[n_pieces, 0], pieces[n_pieces, 1], pieces[n_pieces, 2] = row, start, size
                n, left, taken = n + size, left - size, taken + size
        if left == 0:
            row, taken = row + 1, 0
    cursor[0], cursor[1], pieces[0, 0] = row, taken, n_pieces
    return n


@kernel
def look_up(joint: BushingData, memory: JointMemory, n: int) -> None:
    """Fill in the pressures of the contact table, for loops that write as well as read.

    Such a loop could not take four nodes at once if it read the table, whose places it cannot foresee.
    """
    work, cubics = memory.scratch.listed.work, joint.table.cubics
    for k in range(min(n, PART)):
        first, x = offset(work[INTERVAL + k]), work[FRACTION + k]
        work[RIGID + k] = cubic(cubics, first, x)
        work[DAMPING + k] = cubic(cubics, first + np.uint64(4), x)
