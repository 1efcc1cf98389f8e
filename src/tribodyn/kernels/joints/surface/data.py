"""Constant data of the kernels of surfaces, the list of nodes, and the quantities of an instant.

On the shaft, in the socket's frame, moments about the shaft's origin.
"""

from typing import Annotated, Final, NamedTuple

from mebdf.arrays import FloatArray, FloatMatrix, IntArray
from tribodyn.core.quantities import Quantity, Record, by_axes, of_table, record_type
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.jit import inlined

POSITION: Final = 0
NORMAL: Final = 3
AREA: Final = 6
GAP: Final = 7
N_NODE: Final = 8  #: Rows of the array of nodes: x_k [m], n_k, A_k [m²], and h0_k with wear [m].

COS: Final = 0
SIN: Final = 1
LIFT: Final = 2
#: Rows of the table of angles of rings: cos θ, sin θ, and what ``ring`` adds to the gap [m].
N_ANGLE: Final = 3

N_RADIAL, N_AXIAL, ARM, RADIUS, HEIGHT, LEAST, NODE_AREA, COUNT = range(8)
#: Rows of the array of rings: n_r, n_z, arm, radius, height and least gap [m], area of a node [m²], and
#: number of nodes; what stands there for a patch means nothing.
N_RING: Final = 8

N_POINTS: Final = 2  #: Most points of a point contact.

Surface: Final = record_type(
    *((name, "i8") for name in ("first_row", "last_row", "first_node", "last_node")),
    *((name, "i8") for name in ("first_interval", "last_interval")),
    *((name, "f8") for name in ("h_first", "h_last", "inverse_step")),
    *((name, "f8") for name in ("roughness", "friction_coefficient", "slip_velocity")),
    *((name, "f8") for name in ("onset", "minimum_entry_velocity", "tensile_clip")),
    *((name, "f8") for name in ("tilt", "slides", "lean", "along", "torque_radius", "area")),
    *((name, "f8") for name in ("points", "radius", "clearance")),
    *((name, "f8") for name in ("hardness", "deepest", "levels", "softness", "growth", "extent", "bore")),
    ("pitch", "i8"),
    ("heights", "f8", (N_POINTS,)),
    ("reach", "f8", (2,)),
    ("opens", "f8", (2,)),
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
    Separation in units of σ below which a node is in contact [1], least entry velocity v_min [m/s], and 1 if
    the total pressure must not be tensile.
tilt
    What turning does to its gaps, see ``tilt``.
slides
    1 if nodes stay where they are on the socket while the shaft slides along its axis, see ``station``.
lean
    Radius ρ of the second-order term of the tilt in the gap of a cylinder [m], see ``tilt``: the radius of
    the pin, positive where the nodes belong to the bore, negative where they belong to the pin; 0 otherwise.
along
    1 if friction opposes all slip, 0 if only that around the axis of a cylinder.
torque_radius
    Above zero if friction is a torque alone, of this arm, against ``direction`` of the station [m].
area
    Of all nodes [m²].
points, radius, clearance, heights
    Of a contact at points: their number, 0 for contact over the surface; radius of the shaft and radial
    clearance [m]; heights of their centres along the axis [m]. The table then holds the force of a point [N].
hardness, deepest
    Largest pressure [Pa], and least gap [m] at which the law holds.
levels, pitch, softness, growth, extent, bore
    Of elastic bodies under the asperities, see ``bulk``: N, 0 where they are rigid or a liner; intervals of
    one level's table; q M^¼ [1]; dC/dq over q σ [1/Pa]; how C follows the contact; radius of the bore [m].
reach
    How far the shaft may be displaced across and along the axis [m]; beyond, it has left its socket.
opens
    How much of the radial and of the axial opening of its joint its gaps gain [1].
"""

Row: Final = record_type(
    *((name, "i8") for name in ("first", "count", "angle")),
    *((name, "f8") for name in ("whole", "least", "area", "arm")),
    ("normal", "f8", (3,)),
    ("moment", "f8", (3,)),
    ("spread", "f8", (2,)),
)
"""A row of nodes.

first, count
    Its nodes; a ring has four at least.
angle
    First place of a ring in the table of angles.
whole
    0 for a ring, 1 for a patch, looked at as a whole. Nodes of a ring lie at equal angles around the axis
    from angle zero on, and share radius, height, area, and the components of their normals.
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
    """All clearance joints of a mechanism."""

    #: Surfaces of joint j are those from ``joints[j]`` up to, not including, ``joints[j + 1]``, shape
    #: (n_joints + 1,).
    joints: IntArray
    surfaces: Annotated[Record, Surface, 1]  #: Records :data:`Surface`, shape (n_surfaces,).
    rows: Annotated[Record, Row, 1]  #: Records :data:`Row`, shape (n_rows,).
    nodes: FloatMatrix  #: Shape (``N_NODE``, n_nodes).
    #: Cosines, sines and ``LIFT`` of the angles of rings, see ``ring``, shape (``N_ANGLE``, n_angles).
    angles: FloatMatrix
    #: What the nodes of a row share, and empty rows behind, shape (``N_RING``, n_rows + 3).
    rings: FloatMatrix
    #: The arrays of all contact tables, one after the other.
    table_nodes: FloatMatrix
    energy: FloatArray
    cubics: FloatArray


@inlined
def is_ring(data: SurfaceData, surface: Record) -> bool:
    """Return whether the rows of a surface are rings; those of a mesh are patches, and points have none."""
    return surface.points == 0.0 and data.rows[surface.first_row].whole == 0.0


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


def _wrench(force: str, moment: str, meaning: str) -> tuple[Quantity, ...]:
    """Return a force and a moment by components."""
    along, about = f"{meaning} along", f"moment of the {meaning} about"
    return *by_axes(force, "N", along), *by_axes(moment, "N m", about)


#: The report of an instant.
REPORTED: Final = (
    *_wrench("F_c", "M_c", "normal contact force"),
    *_wrench("F_k", "M_k", "rigid (asperity stiffness) part of the contact force"),
    *_wrench("F_f", "M_f", "friction force"),
    Quantity("damping_power", "W", "power of the damping pressure, turned into heat"),
    Quantity("friction_power", "W", "power of friction, negative: turned into heat"),
    Quantity("energy_contact", "J", "energy stored in the contact"),
    Quantity("expansion_power", "W", "power of an opening clearance on what the contact stores"),
    Quantity("p_max", "Pa", "peak contact pressure, edges included"),
    Quantity("separation_min", "m", "smallest gap, negative where mean surfaces overlap"),
    Quantity("tensile_clip_share", "1", "share of the contact area where the clip of tensile pressure acts"),
    Quantity("contact_fraction", "1", "share of the surface in contact"),
)

#: At an instant, and the largest of a run.
PLASTIC: Final = Quantity("plastic_share", "1", "share of the contact area that carries the hardness", ())

#: Over all accepted steps; output times would miss them.
PEAKS: Final = (
    Quantity("contact_force_peak", "N", "largest contact force at any accepted step", ()),
    Quantity("contact_force_peak_time", "s", "when the contact force was largest", ()),
    Quantity("pressure_peak", "Pa", "largest contact pressure at any accepted step", ()),
    Quantity("pressure_peak_time", "s", "when the contact pressure was largest", ()),
    Quantity("separation_least", "m", "smallest gap at any accepted step", ()),
    Quantity("tensile_clip_time", "s", "time integral of the share of the contact where the clip acts", ()),
)

Report = of_table((*REPORTED, PLASTIC))
Peaks = of_table((*PEAKS, PLASTIC))
