"""What the kernels of the journal read and change."""

from __future__ import annotations

from typing import NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.film.data import FilmData, FilmMemory


class JournalData(NamedTuple):
    """Constants of a journal under stated loads, SI units.

    Attributes
    ----------
    inertia
        Mass twice and transverse inertia twice: what each of (e_x, e_y, φ_x, φ_y) moves [kg, kg m²], shape
        (4,).
    spin_inertia
        Moment of inertia about the axis of the journal [kg m²].
    load
        W_x, W_y and the moments about X and Y (left-handed) [N, N m], shape (4,).
    speed
        Speed of rotation ω about Z [rad/s].
    sign
        s' of Eq. 45: minus the sign of ω, 0 at rest.
    deepest
        Smallest separation that the contact law reaches [m]; negative.
    joint
        The bushing.
    film
        The oil film; None without oil. Kernels are compiled for the one and the other: a dry journal does not
        wait for those of the film.
    """

    inertia: FloatArray
    spin_inertia: float
    load: FloatArray
    speed: float
    sign: float
    deepest: float
    joint: BushingData
    film: FilmData | None


class Scratch(NamedTuple):
    """Work arrays of one evaluation; they carry nothing from one evaluation to the next.

    Attributes
    ----------
    state
        The eight states of the joint, tilts included, shape (8,).
    total
        Generalised load on (e_x, e_y, φ_x, φ_y) [N, N m], shape (4,).
    wrench, wrench_jacobian, gradient
        Of the bushing kernels.
    film, film_jacobian
        Wrench of the film (5,), zero without oil, and its derivatives (5, 9).
    film_status
        Why the film last had no answer, 0 if it always had, shape (1,); for messages.
    report
        Of ``kernels/bushing/report.py``.
    rates
        Integrands of the ledger [W].
    rest
        A state at rest, shape (8,).
    """

    state: FloatArray
    total: FloatArray
    wrench: FloatArray
    wrench_jacobian: FloatArray
    gradient: FloatArray
    film: FloatArray
    film_jacobian: FloatArray
    film_status: FloatArray
    report: FloatArray
    rates: FloatArray
    rest: FloatArray


class JournalMemory(NamedTuple):
    """What accepted steps change.

    Attributes
    ----------
    entry_velocity
        δ̇₋ at the nodes [m/s], shape (n_z + 2, n_theta); 0 where there is no contact.
    last_time
        Time of the last mark [s], shape (1,).
    integrals
        Path integrals of the energy ledger [J], see ``kernels/journal/ledger.py``.
    rates
        Their integrands at the last mark [W].
    extremes
        Peaks and counts over all accepted steps, see ``kernels/journal/ledger.py``.
    beyond
        1 once an accepted step has left the range of the contact law, shape (1,). From then on no force is
        a number, which stops every integrator. Trial states may lie there: the law goes on linearly.
    film
        Cache of the film; None without oil.
    scratch
        Work arrays.
    """

    entry_velocity: FloatArray
    last_time: FloatArray
    integrals: FloatArray
    rates: FloatArray
    extremes: FloatArray
    beyond: FloatArray
    film: FilmMemory | None
    scratch: Scratch
