"""A part of a list of nodes, of which sums over a surface are made."""

from __future__ import annotations

from typing import Final

from tribodyn.core.quantities import record_type

PART: Final = 256
"""Nodes in a part: its columns stay in the near caches, and few parts are begun."""
PITCH: Final = PART + 8
"""Distance between columns: columns a power of two apart would compete for the same places in the cache."""

INTERVAL: Final = 0 * PITCH
FRACTION: Final = 1 * PITCH
"""Interval of the contact table and place in it, see ``kernels/lookup.py``."""
APPROACH: Final = 2 * PITCH
"""δ̇ [m/s]."""
ENTRY: Final = 3 * PITCH
"""Remembered entry velocity [m/s]."""
AREA: Final = 4 * PITCH
POSITION: Final = 5 * PITCH
NORMAL: Final = 8 * PITCH
MOMENT: Final = 11 * PITCH
"""A, x, n, and after it x × n: the six columns from ``NORMAL`` on are (n, x × n)."""
SLIP: Final = 14 * PITCH
"""Six columns (ŝ, x × ŝ) with ŝ = s/√(s² + u_s²)."""
SLIDING: Final = 20 * PITCH
"""P_c |s| [W/m²]; left by the report."""
RIGID: Final = 21 * PITCH
DAMPING: Final = 22 * PITCH
RIGID_SLOPE: Final = 23 * PITCH
DAMPING_SLOPE: Final = 24 * PITCH
"""P_k and C from the contact table [Pa] and their slopes in its intervals, filled by ``look_up``."""
STIFFNESS: Final = RIGID_SLOPE
RESISTANCE: Final = DAMPING_SLOPE
TRACTION: Final = RIGID
"""A ∂P/∂h, A ∂P/∂δ̇ and A μ P/√(s² + u_s²), put in their places for the derivatives."""
N_WORK: Final = 25 * PITCH

Listed: Final = record_type(("work", "f8", (N_WORK,)), ("node", "i8", (PART,)), ("cursor", "i8", (2,)))
"""The list. Nothing is carried from one call of a kernel to the next.

work
    Its columns, which begin at the places above.
node
    Which nodes they are.
cursor
    How far all nodes have been listed: row, and nodes of that row.
"""
