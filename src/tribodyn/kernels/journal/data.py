"""What the kernels of the journal read and change."""

from __future__ import annotations

from typing import Final, NamedTuple

from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.actions import N_OVER, Actions
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.kernels.joints.bushing import BushingData
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.peaks import Peaks

N_COORDINATES: Final = 5
"""Of the ledger: e_x, e_y, φ_x, φ_y and the angle of rotation."""

Constants: Final = record_type(
    ("inertia", "f8", (4,)),
    ("spin_inertia", "f8"),
    ("load", "f8", (4,)),
    ("slip_velocity", "f8"),
    ("deepest", "f8"),
)
"""Constants of a journal under stated loads, SI units.

inertia
    Mass twice and transverse inertia twice: what each of (e_x, e_y, φ_x, φ_y) moves [kg, kg m²].
spin_inertia
    Moment of inertia about the axis of the journal [kg m²].
load
    W_x, W_y and the moments about X and Y (left-handed), what of them is constant [N, N m].
slip_velocity
    Speed of the centre below which a load against its velocity fades [m/s].
deepest
    Smallest separation that the contact law reaches [m]; negative.
"""


ROTATION: Final = 0
SPEED: Final = 1
"""Numbers of the signals that are angle [rad] and speed ω [rad/s] of the rotation about Z over time."""
TIME: Final = 0
TURNED: Final = 1
TURNING: Final = 2
SLIDING: Final = 3
"""What loads may follow, in the order of ``kernels/actions.py``: time, angle and speed of the rotation, and
the speed of the centre."""
OPPOSED: Final = 4
N_LOADS: Final = 5
"""Loads: W_x, W_y, the moments about X and Y (left-handed), and the size of a force against the velocity of
the centre, which W_x and W_y contain afterwards."""


class JournalData(NamedTuple):
    """What the kernels of a journal read.

    Attributes
    ----------
    constants
        See :data:`Constants`.
    joint
        The bushing.
    film
        The oil film; None without oil. Kernels are compiled for the one and the other: a dry journal does not
        wait for those of the film.
    actions
        Rotation, loads from tables, and the segments of the run.
    """

    constants: Record
    joint: BushingData
    film: FilmData | None
    actions: Actions


Course: Final = record_type(("touching", "f8"), ("beyond", "f8"))
"""What the motion has come to.

touching
    1 while any point is in contact.
beyond
    1 once an accepted step has left the range of the contact law. From then on no force is a number, which
    stops every integrator. Trial states may lie there: the law goes on linearly.
"""

Scratch: Final = record_type(
    ("state", "f8", (8,)),
    ("places", "f8", (N_OVER, 2)),
    ("load", "f8", (N_LOADS,)),
    ("following", "f8", (2, N_LOADS)),
    ("resistance", "f8", (2, 2)),
    ("turned", "f8"),
    ("speed", "f8"),
    ("total", "f8", (4,)),
    ("wrench", "f8", (5,)),
    ("wrench_jacobian", "f8", (5, 9)),
    ("film", "f8", (5,)),
    ("film_jacobian", "f8", (5, 9)),
    ("film_status", "f8"),
    ("rest", "f8", (8,)),
)
"""Work of one evaluation; nothing is carried from one evaluation to the next.

state
    The eight states of the joint, tilts included.
places
    Quantities that tables follow, see ``kernels/actions.py``.
load
    See ``N_LOADS`` [N, N m].
following, resistance
    Loads that follow the speed of the centre, with their derivatives; derivative of a load against the
    velocity of the centre in that velocity.
turned, speed
    Angle and speed of rotation [rad, rad/s].
total
    Generalised load on (e_x, e_y, φ_x, φ_y) [N, N m].
wrench, wrench_jacobian
    Of the bushing, in the signs of the paper.
film, film_jacobian
    Wrench of the film, zero without oil, and its derivatives.
film_status
    Why the film last had no answer, 0 if it always had; for messages.
rest
    A state at rest.
"""


class JournalMemory(NamedTuple):
    """What accepted steps change.

    Attributes
    ----------
    joint
        What the bushing remembers.
    books
        What the energy ledger has added up, see ``kernels/ledger.py``.
    peaks
        Of ``WATCHED`` in ``kernels/journal/quantities.py``.
    counts
        See ``COUNTS`` there.
    course
        See :data:`Course`.
    segment
        What holds until the next kink, see ``kernels/actions.py``.
    film
        Cache of the film; None without oil.
    scratch
        See :data:`Scratch`.
    """

    joint: JointMemory
    books: Record
    peaks: Peaks
    counts: Record
    course: Record
    segment: Record
    film: FilmMemory | None
    scratch: Record
