"""The list of nodes of a surface."""

from typing import Final

from tribodyn.core.quantities import record_type
from tribodyn.kernels.joints.columns import OTHERS, PART, PITCH

POSITION: Final = OTHERS
NORMAL: Final = OTHERS + 3 * PITCH
MOMENT: Final = OTHERS + 6 * PITCH  #: x, n, and after it x × n.
SLIP: Final = OTHERS + 9 * PITCH  #: Six columns (ŝ, x × ŝ) with ŝ = s/q, q = √(s² + u_s²).
SLIP_SQUARE: Final = OTHERS + 15 * PITCH  #: |s|² [m²/s²].
FORCE: Final = OTHERS + 16 * PITCH  #: A P_c [N].
TRACTION: Final = OTHERS + 17 * PITCH  #: A μ P_c/q [N s/m].
PRODUCT: Final = OTHERS + 18 * PITCH  #: A weight times a column.
SLIDING: Final = TRACTION
HEAT: Final = OTHERS + 18 * PITCH
POWER: Final = OTHERS + 19 * PITCH
TOUCHING: Final = OTHERS + 20 * PITCH
CLIPPED: Final = OTHERS + 21 * PITCH
#: Of the report: P_c |s|, power of damping and of friction [W/m²]; 1 in contact, where it pulls, and at the
#: hardness.
PLASTIC: Final = OTHERS + 22 * PITCH
N_WORK: Final = OTHERS + 23 * PITCH

Listed: Final = record_type(("work", "f8", (N_WORK,)), ("node", "i8", (PART,)), ("cursor", "i8", (2,)))
"""The list. Nothing is carried from one call of a kernel to the next.

work
    Its columns, which begin at the places above.
node
    Which nodes they are.
cursor
    How far all nodes have been listed: row, and nodes of that row.
"""
