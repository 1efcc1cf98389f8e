"""What the kernels of surfaces read; it never changes."""

from __future__ import annotations

from typing import Final, NamedTuple

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.core.tables import ContactTable
from tribodyn.kernels.jit import inlined

POSITION: Final = 0
NORMAL: Final = 3
AREA: Final = 6
GAP: Final = 7
N_NODE: Final = 8
"""Rows of the array of nodes: x_k [m], n_k, A_k [m²], and h0_k with wear [m]."""

N_POINTS: Final = 2
"""Most points of a point contact."""

Surface: Final = record_type(
    *((name, "i8") for name in ("first_row", "last_row", "first_node", "last_node")),
    *((name, "i8") for name in ("first_interval", "last_interval")),
    *((name, "f8") for name in ("h_first", "h_last", "inverse_step")),
    *((name, "f8") for name in ("roughness", "friction_coefficient", "slip_velocity")),
    *((name, "f8") for name in ("onset", "minimum_entry_velocity", "tensile_clip")),
    *((name, "f8") for name in ("tilt", "slides", "lean", "area")),
    *((name, "f8") for name in ("points", "radius", "clearance")),
    ("heights", "f8", (N_POINTS,)),
    ("reach", "f8", (2,)),
)
"""One surface.

first_row, last_row, first_node, last_node
    Its rows and nodes; the last ones belong to what follows.
first_interval, last_interval, h_first, h_last, inverse_step
    Its contact table: the first of its intervals among those of all tables and the one after its last, and
    the rest as in ``ContactTable``.
roughness
    σ [m].
friction_coefficient, slip_velocity
    μ [1] and u_s [m/s].
onset, minimum_entry_velocity, tensile_clip
    As in ``BushingData``.
tilt
    What turning does to its gaps, see ``tilt``.
slides
    1 if nodes stay where they are on the socket while the shaft slides along its axis, see ``station``.
lean
    Radius ρ of the second-order term of the tilt in the gap of a cylinder [m], see ``tilt``: the radius of
    the pin, positive where the nodes belong to the bore, negative where they belong to the pin; 0 otherwise.
area
    Of all nodes [m²].
points, radius, clearance, heights
    Of a contact at points: their number, 0 for contact over the surface; radius of the shaft and radial
    clearance [m]; heights of their centres along the axis [m]. The table then holds the force of a point [N].
reach
    How far the shaft may be displaced across and along the axis [m]; beyond, it has left its socket.
"""

Row: Final = record_type(
    *((name, "i8") for name in ("first", "count")),
    *((name, "f8") for name in ("whole", "least", "area", "arm")),
    ("normal", "f8", (3,)),
    ("moment", "f8", (3,)),
    ("spread", "f8", (2,)),
)
"""A row of nodes.

first, count
    Its nodes.
whole
    0 for a ring, whose nodes lie at equal angles from angle zero on, 1 for a patch, looked at as a whole.
least
    Least gap as drawn [m].
area
    Of all its nodes [m²]; 0 for rows on an edge, which only pressure and wear are asked of.
normal, arm
    Of a ring: n = (n_0 cos θ, n_0 sin θ, n_2), x × n = arm (−sin θ, cos θ, 0) [m].
normal, moment, spread
    Of a patch: means of n and x × n, and how far those of a node are from them, [1] and [m].
"""


class SurfaceData(NamedTuple):
    """All clearance joints of a mechanism.

    Attributes
    ----------
    joints
        Surfaces of joint j are those from ``joints[j]`` up to, not including, ``joints[j + 1]``, shape
        (n_joints + 1,).
    surfaces
        Records :data:`Surface`, shape (n_surfaces,).
    rows
        Records :data:`Row`, shape (n_rows,).
    nodes
        Shape (``N_NODE``, n_nodes).
    table_nodes, energy, cubics
        The arrays of all contact tables, one after the other.
    """

    joints: IntArray
    surfaces: Record
    rows: Record
    nodes: FloatArray
    table_nodes: FloatArray
    energy: FloatArray
    cubics: FloatArray


@inlined
def table_of(data: SurfaceData, surface: Record) -> ContactTable:
    """Return the contact table of a surface; a table has two intervals and a node more than lie inside it."""
    first, last = surface.first_interval, surface.last_interval
    return ContactTable(
        surface.h_first,
        surface.h_last,
        surface.inverse_step,
        data.table_nodes[first : last - 1],
        data.energy[first : last - 1],
        data.cubics[8 * first : 8 * last],
    )
