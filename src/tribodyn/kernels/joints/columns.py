"""Columns that the lists of nodes of all joints have."""

from typing import Final

from mebdf.arrays import FloatArray
from tribodyn.kernels.jit import inlined, kernel

PART: Final = 256  #: Nodes in a part: its columns stay in the near caches, and few parts are begun.
STRIDE: Final = 8  #: Nodes that the widest registers hold; a whole number of lanes.
#: Distance between columns: columns a power of two apart would compete for the same places in the cache.
PITCH: Final = PART + 8

INTERVAL: Final = 0 * PITCH
FRACTION: Final = 1 * PITCH  #: Interval of the contact table and place in it, see ``kernels/lookup.py``.
APPROACH: Final = 2 * PITCH
ENTRY: Final = 3 * PITCH  #: Approach speed δ̇ and remembered entry velocity [m/s].
AREA: Final = 4 * PITCH  #: Area that the node stands for [m²].
RIGID: Final = 5 * PITCH
DAMPING: Final = 6 * PITCH
PRESSURE: Final = 7 * PITCH  #: P_k, C and P_c [Pa].
STIFFNESS: Final = 8 * PITCH
RESISTANCE: Final = 9 * PITCH  #: ∂P_c/∂h [Pa/m] and ∂P_c/∂δ̇ [Pa s/m].
OTHERS: Final = 10 * PITCH  #: Begins of the columns of a kind of joint.


@inlined
def whole(n: int) -> int:
    """Return ``n``, at most ``PART``, rounded up to a number of nodes that every processor takes at once."""
    return min((n + STRIDE - 1) // STRIDE * STRIDE, PART)


@kernel
def end_list(work: FloatArray, n: int) -> None:
    """Fill the columns with zeros from the ``n`` nodes in the list to the whole number.

    These places are nodes without area, so that loops over the list need no end of their own.
    """
    for column in range(0, work.size, PITCH):
        for k in range(n, whole(n)):
            work[column + k] = 0.0
