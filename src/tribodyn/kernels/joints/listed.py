"""A part of a list of nodes, of which sums over a joint are made."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import record_type

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
RIGID: Final = 9 * PITCH
DAMPING: Final = 10 * PITCH
"""P_k and C from the contact table [Pa], filled by ``look_up``."""
N_WORK: Final = 11 * PITCH

Listed: Final = record_type(
    ("work", "f8", (N_WORK,)), ("pieces", "i8", (PART + 1, 3)), ("cursor", "i8", (2,))
)
"""The list. Nothing is carried from one call of a kernel to the next.

work
    Its columns, which begin at the places above.
pieces
    Where the nodes come from: number of pieces in row 0, then (row of nodes, first node, count).
cursor
    How far all nodes have been listed: row of nodes, and nodes of that row.
"""
