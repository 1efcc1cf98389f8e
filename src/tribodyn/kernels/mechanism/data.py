"""Data and memory of the kernels of a mechanism: bodies and couplings, one record each.

A *coupling* is whatever acts between two bodies: a joint, a spring, a load (between the ground and a body),
a leg of an element. It has a socket on its first body and a shaft on its second, and up to six constraint
rows; the ground is the body after the last. The *nodes* of the linear systems are the bodies and the
couplings that have rows, six unknowns each.

The constraint equation of an *element*, such as a gear pair, is a sum over its legs. Each leg is a coupling
whose only row is one term of the sum. The first leg counts the equation, and all legs share its node. With a
*force law*, the equation says what its multiplier is and not that the sum vanishes: it counts no constraint.

One file because these records hold each other.
"""

from typing import Annotated, Final, NamedTuple

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix, IntArray, IntMatrix
from mebdf.compiled.layouts import STACKED
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.actions import Signals, Term
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.kernels.joints.film import Oil
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.tilt import Pose

N: Final = 6
#: Unknowns of a node of the linear systems, and the numbers that a column of them takes up.
COLUMN: Final = 8

#: Of a body: mass centre (3) [m], unit quaternion (4), velocity (3) [m/s], angular velocity (3) [rad/s].
N_STATES: Final = 13
ORIENTATION: Final = 3
VELOCITY: Final = 7
TURNING: Final = 10  #: First states of quaternion, velocity, and angular velocity in the axes of the body.

POINT: Final = 0
DIRECTION: Final = 1
ANGLE: Final = 2
POSITION: Final = 3
COORDINATE: Final = 4
DISTANCE: Final = 5
PATH: Final = 6  #: Kinds of constraint rows, see ``kernels/mechanism/constraints.py``.

NOTHING: Final = 0
SPRINGS: Final = 1
SPRING: Final = 2
LOAD_GROUND: Final = 3
LOAD_BODY: Final = 4
LOAD_MOTION: Final = 5
LOAD_LINE: Final = 6
CONTACT: Final = 7
BEAM: Final = 8  #: Kinds of forces, see ``kernels/mechanism/forces.py``.

TIME: Final = 0
FOLLOWED: Final = 1
#: Variables of a load's terms, in the order of ``kernels/actions.py``: time, coordinate and speed of a joint;
#: the latter is the speed that a load opposes where it follows no joint.
FOLLOWED_SPEED: Final = 2

NONE: Final = -1  #: Number of a signal, node, block or coupling that is not there.

INTACT: Final = 0
OPENED: Final = 1
OVERLAPPED: Final = 2
#: States of a joint: intact, an ideal one has come apart, mean planes overlap further than the contact law
#: reaches, the shaft has left its socket.
LEFT: Final = 3

PLAIN: Final = 0.0
SLOPES: Final = 1.0
REPORTS: Final = 2.0
"""Evaluation mode of forces: forces alone, with their derivatives, or with their report.

Not integers: numba compiles a kernel again for each one that stands in a call.
"""

WORK: Final = 0
DAMPING: Final = 1
FRICTION: Final = 2
FILM: Final = 3
EXPANSION: Final = 4
N_POWERS: Final = 5  #: Powers of a coupling, and their number.

#: Gravity [m/s²], size of the mechanism [m], number of all constraint rows and of those that are independent,
#: of nodes, of the blocks that hold the work space of solutions, of couplings whose forces follow reactions,
#: and of entries of the iteration matrix that solutions need.
Constants: Final = record_type(
    ("gravity", "f8", (3,)),
    ("extent", "f8"),
    *((name, "i8") for name in ("n_rows", "rank", "n_nodes", "n_work", "n_reactive", "n_entries")),
)

#: Mass [kg]; mass centre as drawn [m]; inertia about the mass centre in the axes of the body, which are those
#: of the drawing at first; its inverse; 1 where its block of the equations of motion is its inverse already
#: when they are factorised, because nothing is subtracted from it before.
Body: Final = record_type(
    ("mass", "f8"),
    ("inertia", "f8", (3, 3)),
    ("inverse", "f8", (3, 3)),
    ("centre", "f8", (3,)),
    ("inverted", "i8"),
)

N_PARAMETERS: Final = 16
#: Parameters of a force law, which reads them by the names of its own record.
Parameters: Final = record_type(("values", "f8", (N_PARAMETERS,)))

Law: Final = record_type(
    *((name, "f8") for name in ("position", "rate", "entry_rate", "held", "normal")),
    ("table", "f8", (2,)),
    ("table_slope", "f8"),
    *((name, "f8") for name in ("force", "in_position", "in_rate")),
    *((name, "f8") for name in ("stored", "damping", "friction", "supplied", "touching")),
    *((name, "f8") for name in ("anchor", "elastic", "stiffness", "next_elastic", "next_stiffness")),
    ("followed", "f8"),
)
"""A force law at one instant.

position, rate
    Coordinate of its element, zero as drawn (a distance: from its length), and rate of it: [m], or [rad].
entry_rate
    Rate with which contact began, kept while ``touching`` is not 0; 0 without contact.
held
    Output of a controller, constant from one sampling time to the next [N], or [N m].
normal
    Force across the axis of the joint whose reaction it follows [N]; 0 without one.
table, table_slope
    Value of its table at the position, or at the rate, and integral from zero; slope of the value.
force
    Force along the coordinate [N], or moment [N m]: positive where it makes the coordinate grow.
in_position, in_rate
    Derivatives of the force.
stored, damping, friction, supplied
    Stored energy [J]; powers that damping and friction turn into heat, and power of a drive [W].
touching
    1 where a contact of one side is closed.
anchor, elastic, stiffness, next_elastic, next_stiffness
    Of friction that holds at rest: position at the last accepted step, NaN before the first; elastic force
    [N] and stiffness [N/m] of what sticks, then and now.
followed
    Multiplier of the equation whose force the law follows, with its sign [N]; 0 without one.
"""

Coupling: Final = record_type(
    ("socket", "i8"),
    ("shaft", "i8"),
    ("socket_point", "f8", (3,)),
    ("shaft_point", "f8", (3,)),
    ("to_socket", "f8", (3, 3)),
    ("shaft_axes", "f8", (3, 3)),
    ("node", "i8"),
    ("n_rows", "i8"),
    ("n_terms", "i8"),
    ("first_leg", "i8"),
    ("next_leg", "i8"),
    ("along", "f8", (3,)),
    ("about", "f8"),
    ("law", "i8"),
    ("parameters", Parameters),
    ("table", "i8", (2,)),
    ("over_rate", "i8"),
    ("first_row", "i8"),
    ("row_kind", "i8", (6,)),
    ("row_axis", "i8", (6,)),
    ("row_other", "i8", (6,)),
    ("row_signal", "i8", (6,)),
    ("force", "i8"),
    ("stiffness", "f8", (6,)),
    ("damping", "f8", (6,)),
    ("length", "f8"),
    ("slip_velocity", "f8"),
    ("direction", "f8", (3,)),
    ("first_term", "i8"),
    ("last_term", "i8"),
    ("opposes", "i8"),
    ("own_speed", "i8"),
    ("follows", "i8"),
    ("follows_position", "i8"),
    ("follows_sign", "f8"),
    ("effort", "i8", (2,)),
    ("contact", "i8"),
    ("film", "i8"),
    ("opening", "i8", (2,)),
    ("load_of", "i8"),
    ("push", "f8", (3,)),
    ("first_entry", "i8"),
    ("rows_block", "i8", (2, 2)),
    ("bodies_block", "i8", (2,)),
)
"""Constants of a coupling.

socket, shaft
    Numbers of the two bodies.
socket_point, shaft_point
    Origins, from the mass centres in the axes of the bodies [m].
to_socket
    Turns axes of the socket's body into those of the socket.
shaft_axes
    Axes of the shaft as columns, in the axes of its body.
node, first_row
    Of its constraint rows, ``NONE`` without rows; number of the first among all.
n_rows, n_terms
    Constraint equations that are counted here, and those that its motion takes part in: the same but for the
    second and later legs of an element, which count none and take part in one.
first_leg, next_leg
    Of a leg of an element: the coupling that is its first leg, ``NONE`` for that one itself; the next leg.
along, about
    Of a leg: coefficients of the displacement [1] and of the angle [m/rad] in the equation of its element.
law, parameters, table, over_rate
    Of the legs of an element with a force law: its address (0 without one), its parameters, the signals
    of its table and of the integral of it, and 1 where the table is one over the rate of the coordinate.
row_kind, row_axis, row_other, row_signal
    Of each row: its kind, axis of the socket, axis of the shaft, number of the signal it follows.
force
    Kind of force.
stiffness, damping
    Along x, y, z of the socket and about x, y, z; of a spring the first; of a beam see ``beam.py``.
length, slip_velocity
    Of a spring or beam without force, or from which a distance counts [m]; of a load against the motion
    [m/s].
first_term, last_term
    Terms of a load: the first, and the one after the last.
direction, opposes, own_speed
    Of a load against the motion: its unit vector where it acts along a line; 0 for a force, 3 for a moment; 1
    where its terms follow the speed that it opposes.
follows, follows_position, follows_sign
    Coupling whose coordinate and speed the terms of a load follow, ``NONE`` for none; 1 for its position
    instead of its angle; sign of both.
effort
    Signals of torque about and force along the axis.
contact, film
    Number among the joints with clearance, and among those with an oil film.
opening
    Signals of the radial and of the axial opening of a clearance.
load_of
    Of the first leg of an element whose force law follows the reaction of a joint: that joint.
push
    Of a leg: force on its shaft in the axes of the socket, over the size of the multiplier that it follows.
first_entry
    Where its entries of the iteration matrix begin, see ``kernels/mechanism/newton.py``.
rows_block
    Blocks (rows, body) and (body, rows) for socket and shaft.
bodies_block
    Blocks (socket, shaft) and (shaft, socket) of the iteration matrix.
"""

#: Of a body at one instant: its states, its attitude (body to global), the force and, in its own axes, the
#: moment on it without constraints, and its acceleration with the angular one in its own axes; derivative of
#: ω × J ω in ω.
BodyNow: Final = record_type(
    ("r", "f8", (3,)),
    ("p", "f8", (4,)),
    ("v", "f8", (3,)),
    ("w", "f8", (3,)),
    ("A", "f8", (3, 3)),
    ("force", "f8", (6,)),
    ("acceleration", "f8", (6,)),
    ("gyroscopic", "f8", (3, 3)),
)

CouplingNow: Final = record_type(
    ("pose", Pose),
    ("RT", "f8", (3, 3)),
    ("B", "f8", (3, 3)),
    ("x", "f8", (3,)),
    ("u", "f8", (3,)),
    ("w_s", "f8", (3,)),
    ("twist", "f8", (6,)),
    ("bias", "f8", (6,)),
    ("H", "f8", (6, 12)),
    ("Vq", "f8", (6, 12)),
    ("Aq", "f8", (6, 12)),
    ("Av", "f8", (6, 12)),
    ("offset", "f8"),
    ("residual", "f8", (6,)),
    ("at_rest", "f8", (6,)),
    ("rate", "f8", (6,)),
    ("gamma", "f8", (6,)),
    ("N", "f8", (6, 6)),
    ("G", "f8", (6, 12)),
    ("prescribed", "f8", (6, 3)),
    ("compliance", "f8", (6,)),
    ("scale", "f8", (6,)),
    ("dependent", "f8", (6,)),
    ("multiplier", "f8", (6,)),
    *((name, "f8") for name in ("pushing", "missed")),
    ("wrench", "f8", (6,)),
    ("effort", "f8", (2,)),
    ("constraint", "f8", (6,)),
    ("slope", "f8", (6, 12)),
    ("Kq", "f8", (12, 12)),
    ("Kv", "f8", (12, 12)),
    ("Gq", "f8", (6, 12)),
    ("Gv", "f8", (6, 12)),
    ("work", "f8", (6, 12)),
    ("strip", "f8", (6, 12)),
    ("small", "f8", (3, 3)),
    ("turned", "f8", (3, 3)),
    ("angle_mark", "f8"),
    ("powers", "f8", (N_POWERS,)),
    ("stored", "f8"),
    ("law", Law),
)
"""Of a coupling at one instant; wrenches act on the shaft at its origin, in the axes of the socket.

RT, B
    From global axes, and from those of the shaft's body, to those of the socket.
x, u, w_s
    From the socket's mass centre to the shaft's origin, its velocity against that centre, and the angular
    velocity of the socket's body.
twist, bias
    Relative velocity and angular velocity; their rates while bodies do not accelerate.
H
    twist = H V, with V the velocities of socket and shaft, six each.
Vq, Aq, Av
    Derivatives of the twist in the position, and of its rate in position and velocity; positions are turned
    about the axes of the body.
residual, at_rest, rate, gamma
    Of each row: what is not closed; its rate where bodies are at rest; its rate; what acceleration keeps it
    closed.
offset
    Of the first leg of an element: constant of its equation [m].
N, G
    Rows over the twist and over V.
prescribed
    What each row follows, with two derivatives in time.
compliance, scale, dependent
    Of each row: see ``kernels/mechanism/solution.py``; inverse of the mass that it moves; 1 if it follows
    from others.
multiplier, pushing, missed
    Of each row; size of the reaction by which friction or a leg's ``push`` were taken, and what it missed.
wrench, constraint
    By forces and by constraints, those of drives included.
effort
    Part of ``wrench``: given torque [N m] and force [N] of drives along the axis.
slope
    Derivative of ``wrench`` in relative displacement, small rotation, velocity and angular velocity.
Kq, Kv, Gq, Gv
    Derivatives of the forces on both bodies, with sign, and of the rows' accelerations in position and
    velocity.
angle_mark
    Angle of the shaft about the axis from which its whole turns are counted.
powers, stored
    What drives and loads put in, what damping, friction and oil film turn into heat, and what temperatures do
    to the energy stored in contact [W]; stored energy [J].
law
    Of the first leg of an element with a force law.
"""

#: State of the segment [begin, until] whose pieces of tables hold; accepted steps until redundant rows are
#: chosen again; energies [J], momentum and external force with moments about the origin; what has become of a
#: joint, ``INTACT`` or another of the kinds above, and the number of the coupling that has ``OPENED`` or of
#: the surface. From then on no rate is a number, which stops every integrator. Trial states may lie beyond a
#: law: it goes on linearly.
Course: Final = record_type(
    ("begin", "f8"),
    ("until", "f8"),
    ("wait", "i8"),
    ("times", "f8", (3,)),
    ("kinetic", "f8"),
    ("potential", "f8"),
    ("momentum", "f8", (6,)),
    ("external", "f8", (6,)),
    ("broken", "i8"),
    ("broken_at", "i8"),
)


#: Integrands at three marks, and their integrals: powers of a coupling, external force, its moment.
Book: Final = record_type(("marks", "f8", (3, N_POWERS)), ("sums", "f8", (N_POWERS,)))


class Pattern(NamedTuple):
    """Operations on blocks that factorise and solve, see ``kernels/mechanism/blocks.py``."""

    #: Operation, up to three blocks, how many columns of the first are touched, and how many unknowns the
    #: node has that is eliminated, shape (n, 6).
    factor: IntMatrix
    #: Block, row, column, and how many unknowns the node of the column has, shape (n, 4).
    forward: IntMatrix
    backward: IntMatrix
    exchanges: IntArray  #: Work space, shape (6,).


class Parts(NamedTuple):
    """Parts of a mechanism, as records named above; most kernels need no more."""

    #: One record; one for each body; one for each coupling.
    constants: Annotated[Record, Constants]
    bodies: Annotated[Record, Body, 1]
    couplings: Annotated[Record, Coupling, 1]


class Now(NamedTuple):
    """Places of the parts at one instant, and work space."""

    #: Records named above; of ``bodies`` the last is the ground.
    course: Annotated[Record, Course]
    bodies: Annotated[Record, BodyNow, 1]
    couplings: Annotated[Record, CouplingNow, 1]
    #: Unknowns and right-hand sides of the nodes, and what a solution leaves of them, shape (n_nodes, 8).
    x: FloatMatrix
    rest: FloatMatrix
    left: FloatMatrix


class MechanismData(NamedTuple):
    """Constant data of the kernels."""

    parts: Parts  #: See :class:`Parts`.
    #: What drives and loads follow; terms of all loads, see ``kernels/actions.py``.
    signals: Signals
    terms: Annotated[Record, Term, 1]
    #: Patterns of the equations of motion and of the iteration matrix of implicit methods.
    mass: Pattern
    newton: Pattern
    contact: SurfaceData  #: All joints with clearance.
    #: The oil films of all joints that have one, see ``kernels/film/data.py``.
    films: Annotated[FilmData, STACKED]


class MechanismMemory(NamedTuple):
    """History variables, changed at accepted steps, and work arrays."""

    now: Now  #: See :class:`Now`.
    blocks: FloatCube  #: Matrix by blocks, each column by column, shape (n_blocks, 6, 8).
    #: Products of all rows, shape (n_rows, n_rows); of no size without redundant rows.
    independence: FloatMatrix
    settled: FloatArray  #: State on the constraints that ``advance`` or ``enter`` has left, shape (n,).
    books: Annotated[Record, Book, 1]  #: Powers and works, see ``kernels/mechanism/ledger.py``.
    contact: SurfaceMemory  #: What the joints with clearance remember.
    films: Annotated[FilmMemory, STACKED]  #: Caches of the films.
    #: What each film does to its joint, see ``kernels/joints/film.py``, shape (n_films,).
    oil: Annotated[Record, Oil, 1]
