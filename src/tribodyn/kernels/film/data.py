"""Data and memory of the kernels of the film, of one and of several."""

from typing import Annotated, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix, IntMatrix
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import inlined

IntArray = NDArray[np.int64]
FlagArray = NDArray[np.int8]

CONVERGED: Final = 0
NO_CONVERGENCE: Final = 1  #: The set of cavitated nodes did not settle.
OUT_OF_RANGE: Final = 2  #: Somewhere h < −4σ (or h ≤ 0 without roughness), or the state is not a number.
NOT_STEADY: Final = 3  #: ``jfo`` was asked for a moving shaft centre, or for one that does not turn.
NO_MEAN_GAP: Final = 4  #: ``jfo`` needs a positive mean gap everywhere.

REYNOLDS: Final = 0
HALF_SOMMERFELD: Final = 1
NO_CAVITATION: Final = 2
JFO: Final = 3


SIDES: Final = 5  #: Right-hand sides solved at once: as many as the wrench has members.


class FlowTable(NamedTuple):
    """Flow, shear and contact factors of a pair of rough surfaces, as piecewise cubics.

    A cubic of one interval is c_0 + c_1 x + c_2 x² + c_3 x³ with x from 0 to 1 across it.
    """

    inverse_step: float  #: Intervals per unit of 1/H, H = h/σ, of the factors.
    factors: FloatCube  #: φ_θ, φ_z, φ_s, φ_f, φ_fp over 1/H from 0 to 2, shape (intervals, 5, 4).
    gap_step: float  #: Interval of h/σ of ``mean_gap``, which begins at 0.
    #: Mean gap h_T/σ, whose slope is the contact factor φ_c, shape (intervals, 4); equal to h/σ above.
    mean_gap: FloatMatrix


Constants: Final = record_type(
    *((name, "f8") for name in ("viscosity", "clearance", "radius", "length", "roughness")),
    *((name, "i8") for name in ("cavitation", "groove", "uniform", "mirror")),
)
"""Constants of a film, SI units.

viscosity
    η [Pa s].
clearance, radius, length
    c, r_j, l_z [m].
roughness
    Combined rms roughness σ [m]; 0 for smooth surfaces, which have no factors.
cavitation
    ``REYNOLDS``, ``HALF_SOMMERFELD``, ``NO_CAVITATION`` or ``JFO``.
groove
    1 for p = 0 on the line of maximum gap, to which the grid then turns; 0 for a periodic film.
uniform
    1 if the wear does not depend on z.
mirror
    1 if the wear is the same at z and −z.
"""

Column: Final = record_type(
    *((name, "f8") for name in ("cos_node", "sin_node", "cos_face", "sin_face")),
    *((name, "f8") for name in ("arm_node", "arm_face", "arm_rate")),
)
"""Cosine and sine of θ at the nodes of a column and on the faces behind them, and lever arms by the tilt.

arm_node, arm_face
    r s at nodes and faces [m], see ``kernels.film.attitude``.
arm_rate
    Its rate at nodes [m/s].
"""


class FilmData(NamedTuple):
    """Data of the kernels of a film.

    Nodes are uniform in θ and z; those at both ends (z = ∓length/2) carry p = 0. ``theta`` fields live on
    faces half a step after a node in θ, ``z`` fields half a step after it in z.
    """

    constants: Annotated[Record, Constants]  #: See :data:`Constants`.
    columns: Annotated[Record, Column, 1]  #: Of the grid, see :data:`Column`, shape (n_theta,).
    #: Axial positions [m], shapes (n_z + 1,) and (n_z,).
    z_node: FloatArray
    z_face: FloatArray
    #: Wear depth at nodes and faces [m], shapes (n_theta, n_z + 1) twice and (n_theta, n_z).
    wear_node: FloatMatrix
    wear_theta: FloatMatrix
    wear_z: FloatMatrix
    table: FlowTable  #: Factors of the rough surfaces.


Row: Final = record_type(*((name, "f8") for name in ("a", "b", "v_a", "v_b", "weight", "face_a", "face_b")))
"""The shaft axis at a row: offset [m] and velocity [m/s], and its offset at the z face below the row [m].

The weight is 1, ½ for the row in the middle of a symmetric film.
"""

Cell: Final = record_type(
    *((name, "f8") for name in ("k_theta", "dk_theta", "wedge", "d_wedge", "drag", "d_drag")),
    *((name, "f8") for name in ("contact", "d_contact", "source")),
)
"""A node and the θ face behind it; each name with d is the derivative by h of the one before.

k_theta
    Conductance of the face [1].
wedge
    (h_T + σ φ_s)/c on the face times the row weight [1].
drag
    h φ_fp on the face times the row weight [m].
contact
    φ_c times the row weight at the node [1].
source
    Right-hand side of the equation for the pressure [1/s].
"""

#: A z face: its conductance and c φ_f/h [1], each with its derivative by h.
ZFace: Final = record_type(*((name, "f8") for name in ("k_z", "dk_z", "couette", "d_couette")))


class FilmFields(NamedTuple):
    """The film at one state: conductances, sources and their derivatives by the gap.

    Shapes: n = n_theta columns, m = n_z − 1 rows. Without tilt only the rows up to the middle are filled.
    """

    #: Of the grid, turned to the groove if there is one, see :data:`Column`, shape (n,).
    columns: Annotated[Record, Column, 1]
    rows: Annotated[Record, Row, 1]  #: See :data:`Row`, shape (m + 1,): the last holds a face alone.
    cells: Annotated[Record, Cell, 2]  #: See :data:`Cell`, shape (n, m).
    z_faces: Annotated[Record, ZFace, 2]  #: See :data:`ZFace`, shape (n, m + 1).


class BandSystem(NamedTuple):
    """A symmetric system over some of the nodes, column after column, with the last column as a border."""

    number: IntMatrix  #: Unknown at a node or −1, shape (n, m).
    reach: IntArray  #: Last unknown that the elimination of each one touches, shape (n m,).
    band: FloatMatrix  #: Pivot and the entries below it, shape (n m, m + 2); the last column stays zero.
    border: FloatMatrix  #: Rows of the border, transposed, shape (n m, m).
    corner: FloatMatrix  #: Border against itself, shape (m, m).
    right: FloatMatrix  #: Right-hand sides, one row an unknown, shape (n m, SIDES).
    single: FloatArray  #: One more, for the pressure, shape (n m,).
    #: Unknowns of the band, of the border, and the column where the numbering starts, shape (3,).
    size: IntArray


Work: Final = record_type(
    ("state", "f8", (8,)),
    ("chart", "f8", (5, 9)),
    ("lean", "f8", (4,)),
    ("least", "f8"),
    ("effort", "i8", (2,)),
)
"""Of the last evaluation.

state
    The state in the linear coordinates of ``kernels.film.attitude``.
chart
    Derivatives of the wrench in these and ω.
lean
    Second-order terms of one row of the chart, in t and w.
least
    Smallest gap [m].
effort
    Factorisations, and the number of rows used.
"""


class FilmMemory(NamedTuple):
    """Cavitation of the last evaluation, as a first guess, and scratch.

    Fields have one row a column of nodes (fixed θ) and leave the ends out: shape (n_theta, n_z − 1).
    """

    active: Annotated[FlagArray, 2]  #: 1 where the film is full, 0 where it cavitates.
    #: p/(6 η r²/c²) [1/s]; with ``half-sommerfeld`` before negative values are left out.
    pressure: FloatMatrix
    fill: FloatMatrix  #: Fraction of the gap that holds oil; 1 but with ``jfo``.
    adjoint: FloatCube  #: Derivatives of the wrench by the source, shape (5, n_theta, n_z − 1).
    gradient: FloatCube  #: Sums over rows of nodes (4) and of faces (2), shape (5, 6, n_z).
    #: The film at one state, and the linear system for its pressure.
    fields: FilmFields
    system: BandSystem
    #: Matrix and unknowns (π or f) of ``jfo``, behind the groove, shapes (N, 2 n_z − 1) and (N,), N =
    #: (n_theta − 1)(n_z − 1); empty for the other models.
    transport: FloatMatrix
    amount: FloatArray
    work: Annotated[Record, Work]  #: See :data:`Work`.


@inlined
def film_at(films: FilmData, k: int) -> FilmData:
    """Return the data of film ``k``."""
    table: Any = films.table
    return FilmData(
        films.constants[k],
        films.columns[k],
        films.z_node[k],
        films.z_face[k],
        films.wear_node[k],
        films.wear_theta[k],
        films.wear_z[k],
        FlowTable(table.inverse_step[k], table.factors[k], table.gap_step[k], table.mean_gap[k]),
    )


@inlined
def memory_at(memory: FilmMemory, k: int) -> FilmMemory:
    """Return the memory of film ``k``."""
    fields, system = memory.fields, memory.system
    return FilmMemory(
        memory.active[k],
        memory.pressure[k],
        memory.fill[k],
        memory.adjoint[k],
        memory.gradient[k],
        FilmFields(fields.columns[k], fields.rows[k], fields.cells[k], fields.z_faces[k]),
        BandSystem(
            system.number[k],
            system.reach[k],
            system.band[k],
            system.border[k],
            system.corner[k],
            system.right[k],
            system.single[k],
            system.size[k],
        ),
        memory.transport[k],
        memory.amount[k],
        memory.work[k],
    )
