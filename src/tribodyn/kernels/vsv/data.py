"""Data and memory of the kernels of the variable stator vane mechanism, and rows of its motion table.

Each row is a coordinate of a body or of a point. Its columns hold the partial derivatives with
respect to the crank angle and the four clearance coordinates, the velocity, the acceleration that
remains when the clearance accelerations vanish, and the value. With a mass and a force for each
row, the equations of motion are sums over rows.
"""

from typing import Annotated, Final, NamedTuple

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Quantity, Record, names, record_type
from tribodyn.kernels.actions import N_OVER, Actions, Segment
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.bushing import BushingData, Collar
from tribodyn.kernels.joints.bushing import Extremes as CollarExtremes
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.ledger import books_type
from tribodyn.kernels.peaks import Peaks
from tribodyn.kernels.vsv.quantities import FORCES, POWERS

THETA_A: Final = 0
THETA_B: Final = 1
THETA_V: Final = 2
O1_X: Final = 3
O1_Z: Final = 4
O2_X: Final = 5
O2_Y: Final = 6
O2_Z: Final = 7
N_X: Final = 8
N_Y: Final = 9
N_Z: Final = 10
O3_X: Final = 11
O3_Y: Final = 12
O3_Z: Final = 13
OV_X: Final = 14
OV_Y: Final = 15
E_X: Final = 16
E_Y: Final = 17
PHI_X: Final = 18
PHI_Y: Final = 19
S1_X: Final = 20
S1_Z: Final = 21
S2_X: Final = 22
S2_Y: Final = 23
S2_Z: Final = 24
S3_X: Final = 25
S3_Y: Final = 26
S3_Z: Final = 27
N_ROWS: Final = 28
N_BODY: Final = 20  #: Rows of bodies, with an inertia or a force; the others are points that connect them.

D_CRANK: Final = 0  #: Column of ∂/∂θ_a; columns 1 to 4 are ∂/∂(e_x, e_y, φ_x, φ_y).
VELOCITY: Final = 5
BIAS: Final = 6
VALUE: Final = 7
N_COLUMNS: Final = 8

N_IDEAL: Final = 512  #: Intervals of the table of the ideal mechanism.

N_COORDINATES: Final = 4  #: Clearance coordinates e_x, e_y, φ_x, φ_y.


#: Constants of the mechanism, symbols of the paper.
CONSTANTS: Final = tuple(
    Quantity(name, unit, meaning, ())
    for name, unit, meaning in (
        ("exact", "1", "1 for the formulation `exact`, 0 for `paper`, -1 for `printed`"),
        ("l_1", "m", "crank"),
        ("l_2", "m", "drag link"),
        ("l_3", "m", "ring radius"),
        ("l_4", "m", "lever arm"),
        ("pivot_x", "m", "x of the crank pivot A, l_m cos γ"),
        ("pivot_z", "m", "z of the crank pivot A, l_m sin γ; its y is l_4"),
        ("ring_sin", "1", "sine of the angle φ between the two arms of the ring"),
        ("ring_cos", "1", "its cosine"),
        ("half_length", "m", "l_z/2, height of the lever plane above the trunnion centre O_j"),
        ("vane_arm", "m", "from O_j down to the vane centre: (l_v − l_z)/2, or l_v/2 in `paper`"),
        ("m_1", "kg", "mass of the crank"),
        ("m_2", "kg", "mass of the drag link"),
        ("m_3", "kg", "mass of the ring"),
        ("m_v", "kg", "mass of the vane"),
        ("vane_weight", "N", "G_v = m_v g"),
        ("crank_inertia", "kg m2", "of the crank about its mass centre"),
        ("link_inertia", "kg m2", "of the drag link about its mass centre"),
        ("ring_inertia", "kg m2", "of the ring about its mass centre"),
        ("start_angle", "rad", "drive: ω_a = Ω sin ν t from this crank angle"),
        ("speed_amplitude", "rad s-1", "Ω"),
        ("angular_frequency", "rad s-1", "ν"),
        ("tabulated", "1", "1 where the crank follows the signal :data:`CRANK` instead"),
        ("opening", "1", "number of the signal that the clearance follows, -1 for none"),
        ("air_force_x", "N", "size of F_airx, Table 3"),
        ("air_force_y", "N", "F_airy"),
        ("air_moment", "N m", "size of M_air"),
        ("switch_angle", "rad", "vane angle where F_airx changes sign"),
        ("switch_width", "rad", "width of the change"),
        ("ideal_first", "rad", "first crank angle of the table of the ideal mechanism"),
        ("ideal_inverse_step", "rad-1", "its nodes per radian"),
    )
)

#: These, and mass or moment of inertia [kg, kg m²] and gravity load [N] of each row of the motion table, and
#: (θ_v, step dθ_v/dθ_a) of the ideal mechanism [rad].
Mechanism: Final = record_type(
    *((name, "f8") for name in names(CONSTANTS)),
    ("inertia", "f8", (N_ROWS,)),
    ("weight", "f8", (N_ROWS,)),
    ("ideal", "f8", (N_IDEAL + 1, 2)),
)


def new_mechanism(**constants: float | FloatArray) -> Record:
    """Return the constants as kernels read them, every one of :data:`Mechanism` by its name."""
    mechanism = new_record(Mechanism)
    assert constants.keys() == set(Mechanism.names or ())
    for name, value in constants.items():
        mechanism[name] = value
    return mechanism


CRANK: Final = 0  #: Number of the signal that is the crank angle over time, where there is one.
TIME: Final = 0
VANE: Final = 1
CRANK_ANGLE: Final = 2
VANE_SPEED: Final = 3
#: Variables of loads, in the order of ``kernels/actions.py``: time, θ_v and θ_a, and their rates.
CRANK_SPEED: Final = 4

AIR_X: Final = 0
AIR_Y: Final = 1
AIR_Z: Final = 2
BEND_X: Final = 3
BEND_Y: Final = 4
AIR_M: Final = 5
#: Loads on the vane: forces through its centre O_v [N], what their line of action adds about X and Y (the
#: latter left-handed), and the moment about Z [N m].
N_AIR: Final = 6


class VsvData(NamedTuple):
    """Constant data of the kernels of the mechanism."""

    mechanism: Annotated[Record, Mechanism]  #: Its constants.
    joint: BushingData  #: The bushing.
    collar: Annotated[Record, Collar]  #: The thrust collar, see ``kernels/joints/bushing.py``.
    actions: Actions  #: The drive, where it is no sinusoid, loads from tables, and the segments of the run.


Scratch: Final = record_type(
    ("motion", "f8", (N_ROWS, N_COLUMNS)),
    ("secants", "f8", (2,)),
    ("test", "f8", (N_BODY, 5)),
    ("force", "f8", (N_BODY,)),
    ("collar", "f8", (N_BODY,)),
    ("mass", "f8", (5, 4)),
    ("load", "f8", (5,)),
    ("solved", "f8", (4, 9)),
    ("acceleration", "f8", (4,)),
    ("wrench", "f8", (5,)),
    ("wrench_jacobian", "f8", (5, 9)),
    ("small", "f8", (4, 4)),
    ("closed", "f8", (N_ROWS, N_COLUMNS)),
    ("angles", "f8", (2, 3)),
    ("places", "f8", (N_OVER, 2)),
    ("air", "f8", (N_AIR,)),
    ("air_over_time", "f8", (2, N_AIR)),
    ("f_cz", "f8"),
    ("marked", "f8"),
)
"""Work of one evaluation; nothing is carried from one evaluation to the next.

``secants`` are sec² φ_x and sec² φ_y; ``closed`` is the motion table of ``paper`` with the offsets
alone; ``angles`` are θ_sz and θ_sx with two derivatives, in ``printed``.
``marked`` is 1 while the others hold what the ledger evaluated at its mark.
"""

#: Books of energy, see ``kernels/ledger.py``.
Books: Final = books_type(len(POWERS), len(FORCES), N_COORDINATES)


class VsvMemory(NamedTuple):
    """History variables, changed at accepted steps."""

    joint: JointMemory  #: What the bushing remembers.
    collar: Annotated[Record, CollarExtremes]  #: Extremes of the thrust collar.
    segment: Annotated[Record, Segment]  #: What holds until the next kink, see ``kernels/actions.py``.
    #: Direction of the ideal vane motion, ±1; the vane speed that traction is told instead of the actual one
    #: (0: none); and 1 once an accepted step has left the range of the contact law, shape (3,).
    regime: FloatArray
    peaks: Peaks  #: Of ``WATCHED`` in ``kernels/vsv/quantities.py``.
    books: Annotated[Record, Books]  #: What the energy ledgers have added up, see ``kernels/ledger.py``.
    scratch: Annotated[Record, Scratch]  #: See :data:`Scratch`.
