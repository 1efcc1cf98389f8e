"""Nodes within reach of contact, gathered from all rows into one list.

Sums over nodes are loops over this list: long enough for the processor to take four nodes at once, whatever
the width of the window in a row. The list is filled and summed a part at a time, so that it stays in the
nearest cache. It is held by ``BushingData.listed``, see :data:`LISTED`.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.window import contact_window
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.lookup import cubic, interval, last_interval, offset

PART: Final = 512
"""Nodes in a part of the list."""
PITCH: Final = PART + 8
"""Distance between columns: columns 4096 bytes apart would compete for the same places in the cache."""

INTERVAL: Final = 0 * PITCH
FRACTION: Final = 1 * PITCH
"""Interval of the contact table and place in it, see ``kernels/lookup.py``."""
COS: Final = 2 * PITCH
SIN: Final = 3 * PITCH
APPROACH: Final = 4 * PITCH
SLIP: Final = 5 * PITCH
"""Approach speed δ̇ and slip u [m/s]."""
ENTRY: Final = 6 * PITCH
"""Remembered entry velocity [m/s]."""
AREA: Final = 7 * PITCH
MOMENT: Final = 8 * PITCH
"""Area that the node stands for [m²], and that times its axial position [m³]."""
PRESSURE: Final = 9 * PITCH
"""P_c [Pa]; left by the report."""
RIGID: Final = 10 * PITCH
DAMPING: Final = 11 * PITCH
"""P_k and C from the contact table [Pa], filled by :func:`look_up`."""
N_WORK: Final = 12 * PITCH

LISTED: Final = np.dtype(
    [("work", "f8", (N_WORK,)), ("pieces", "i8", (PART + 1, 3)), ("cursor", "i8", (2,))], align=True
)
"""The list. Nothing is carried from one call of a kernel to the next.

work
    Its columns, which begin at the places above.
pieces
    Where the nodes come from: number of pieces in row 0, then (row of nodes, first node, count).
cursor
    How far all nodes have been listed: row of nodes, and nodes of that row.
"""


@inlined
def row_motion(y: FloatArray, tan_x: float, tan_y: float, z: float) -> tuple[float, float, float, float]:
    """Return offset (a, b) [m] and velocity (v_a, v_b) [m/s] of the trunnion axis at height ``z`` [m].

    ``tan_x`` and ``tan_y`` are the tangents of the tilts, the same for every row.
    """
    a = y[0] - z * tan_y
    b = y[1] - z * tan_x
    v_a = y[4] - z * y[7] * (1.0 + tan_y * tan_y)
    v_b = y[5] - z * y[6] * (1.0 + tan_x * tan_x)
    return a, b, v_a, v_b


@inlined
def _load(
    joint: BushingData,
    entry_velocity: FloatArray,
    row: int,
    first: int,
    size: int,
    at: int,
    a: float,
    b: float,
    v_a: float,
    v_b: float,
    slip: float,
) -> None:
    """Write ``size`` nodes of a row with given offset and velocity into the list, from place ``at`` on."""
    work, cos, sin, wear = joint.listed.work, joint.cos_theta, joint.sin_theta, joint.wear
    area = joint.area[row]
    moment = area * joint.z[row]
    last = last_interval(joint.table)
    scale = joint.table.inverse_step / joint.roughness
    shift = 1.0 - joint.table.h_first * joint.table.inverse_step + joint.clearance * scale
    # Unsigned, so that no index is taken from the end.
    source, j = np.uint64(first), np.uint64(row)
    at = min(max(at, 0), PART)
    for k in range(min(size, PART - at)):
        i, n = source + np.uint64(k), at + k
        c, s = cos[i], sin[i]
        number, x = interval(shift + scale * (a * c + b * s + wear[j, i]), last)
        work[INTERVAL + n] = number
        work[FRACTION + n] = x
        work[COS + n] = c
        work[SIN + n] = s
        work[APPROACH + n] = -(v_a * c + v_b * s)
        work[SLIP + n] = slip + v_a * s - v_b * c
        work[ENTRY + n] = entry_velocity[j, i]
        work[AREA + n] = area
        work[MOMENT + n] = moment


@kernel
def rewind(joint: BushingData) -> None:
    """Begin the list anew."""
    cursor = joint.listed.cursor
    cursor[0] = cursor[1] = 0


@kernel
def gather(
    joint: BushingData, entry_velocity: FloatArray, y: FloatArray, omega: float, with_edges: float
) -> int:
    """Fill the next part of the list and return the number of its nodes, 0 after the last one.

    Parameters
    ----------
    joint, entry_velocity, y, omega
        As for ``wrench``.
    with_edges
        1 if the rows on the edges, which stand for no area, are wanted too, 0 otherwise.
    """
    cursor, pieces, n_theta = joint.listed.cursor, joint.listed.pieces, joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    row, taken, n, n_pieces = cursor[0], cursor[1], 0, 0
    slip = omega * joint.journal_radius
    while row < joint.z.size and n < PART:
        left = 0
        if with_edges > 0.0 or joint.area[row] > 0.0:
            a, b, v_a, v_b = row_motion(y, tan_x, tan_y, joint.z[row])
            first, count = contact_window(joint.clearance, a, b, limit, n_theta)
            left = count - taken
            while left > 0 and n < PART:
                start = first + taken if first + taken < n_theta else first + taken - n_theta
                size = min(left, n_theta - start, PART - n)
                _load(joint, entry_velocity, row, start, size, n, a, b, v_a, v_b, slip)
                n_pieces += 1
                pieces[n_pieces, 0], pieces[n_pieces, 1], pieces[n_pieces, 2] = row, start, size
                n, left, taken = n + size, left - size, taken + size
        if left == 0:
            row, taken = row + 1, 0
    cursor[0], cursor[1], pieces[0, 0] = row, taken, n_pieces
    return n


@kernel
def look_up(joint: BushingData, n: int) -> None:
    """Fill in the pressures of the contact table, for loops that write as well as read.

    Such a loop could not take four nodes at once if it read the table, whose places it cannot foresee.
    """
    work, cubics = joint.listed.work, joint.table.cubics
    for k in range(min(n, PART)):
        first, x = offset(work[INTERVAL + k]), work[FRACTION + k]
        work[RIGID + k] = cubic(cubics, first, x)
        work[DAMPING + k] = cubic(cubics, first + np.uint64(4), x)
