"""Static equilibrium of the journal: from load and speed to attitude, and who carries the load.

The axis of the journal is at rest, so the film has its wedge and no squeeze, the contact no damping, and
friction slides at ω r_j.
"""

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint, EntryMemory, Friction, Grid
from tribodyn.joints.bushing import new_memory
from tribodyn.joints.clearances import Clearance
from tribodyn.joints.shapes import Cylinder
from tribodyn.kernels import dense
from tribodyn.kernels.film.wrench import film_wrench_and_jacobian
from tribodyn.kernels.joints.bushing import report, wrench_and_jacobian
from tribodyn.kernels.joints.paper import fill_pose, from_jacobian, from_wrench
from tribodyn.lubrication.oil_film import Film
from tribodyn.mechanisms.balance import damped_newton

_START_DEPTHS: Final = (2.0, 1.0, 3.0, 0.0)  #: Separations over σ tried for the first guess.


@dataclass(frozen=True)
class Loads:
    """Loads on the centre of the journal."""

    #: W_x and W_y [N].
    force_x: float
    force_y: float
    #: About X (right-handed) and Y (left-handed, as φ_y) [N m]; they matter with tilt only.
    moment_x: float = 0.0
    moment_y: float = 0.0

    @property
    def force(self) -> float:
        """Size of the force [N]."""
        return math.hypot(self.force_x, self.force_y)

    @property
    def direction(self) -> FloatArray:
        """Unit vector along the force, shape (2,); along X where there is none."""
        if self.force == 0.0:
            return np.array([1.0, 0.0])
        return np.array([self.force_x, self.force_y]) / self.force


@dataclass(frozen=True)
class Journal:
    """A journal in a bushing under stated loads, for its static equilibrium.

    Raises InputError if bushing and film are not of one size.
    """

    tilts: bool  #: Whether the journal can tilt; otherwise it stays parallel to the bushing.
    speed: float  #: Speed of rotation ω about Z, right-handed, kept by a drive [rad/s].
    loads: Loads  #: Loads at the start.
    joint: BushingJoint  #: The bushing.
    film: Film | None = None  #: The oil film; none by default.
    changes: bool = False  #: Whether load or speed follow a table.

    def __post_init__(self) -> None:
        """Refuse a film of another size than the bushing."""
        size, film = self.joint.geometry, self.film
        if film is None:
            return
        given = (film.clearance, film.radius, film.length)
        if not np.allclose(given, (size.clearance, size.radius, size.length), rtol=1e-9, atol=0.0):
            raise InputError("the film has another clearance, radius or length than the joint", key="film")

    @property
    def freedoms(self) -> int:
        """Number of degrees of freedom: 2, with tilt 4."""
        return 4 if self.tilts else 2


def journal_in(
    real: Clearance, *, loads: Loads, speed: float = 0.0, tilts: bool = False, changes: bool = False
) -> Journal:
    """Return the journal in a bore of any mechanism, at the temperatures of its run.

    ``real``: its clearance, of a shaft in a bore; end faces are left out; ``loads``, ``speed``, ``tilts``,
    ``changes``: as those of :class:`Journal`.
    """
    shape = real.shape
    assert isinstance(shape, Cylinder)
    joint = BushingJoint(
        geometry=shape,
        friction=Friction(real.friction_coefficient, "traction", real.slip_velocity),
        entry=EntryMemory(real.onset, real.minimum_velocity, real.tensile_clip),
        grid=Grid(*real.grid),
        roughness=real.roughness,
        table=real.table,
        contact=real.contact,
        liner=real.liner,
        form=shape.form,
        bulk=real.bulk,
        hardness=real.hardness,
    )
    return Journal(tilts, speed, loads, joint, real.film, changes)


@dataclass(frozen=True)
class Equilibrium:
    """A journal at rest in its bushing, but for its rotation."""

    journal: Journal  #: The journal, with its speed.
    attitude: FloatArray  #: (e_x, e_y, φ_x, φ_y) [m, rad], shape (4,).
    #: Wrench of contact pressure and friction on the journal (F_x, F_y, M_x, M_y, M_z) [N, N m], shape (5,).
    contact: FloatArray
    film: FloatArray  #: The same of the film.

    @property
    def eccentricity(self) -> float:
        """Distance of the centre from the axis of the bushing [m]."""
        return float(portable.hypot(self.attitude[0], self.attitude[1]))

    @property
    def friction_coefficient(self) -> float:
        """Moment that resists the rotation over r_j and load [1]."""
        moment = abs(float(self.contact[4] + self.film[4]))
        return moment / (self.journal.joint.geometry.radius * self.journal.loads.force)

    @property
    def contact_share(self) -> float:
        """Share of the load that contact, with its friction, carries [1]."""
        return self._share(self.contact)

    @property
    def film_share(self) -> float:
        """Share of the load that the film carries [1]."""
        return self._share(self.film)

    def _share(self, wrench: FloatArray) -> float:
        return -float(dense.product(wrench[:2], self.journal.loads.direction)) / self.journal.loads.force


def equilibrium(
    journal: Journal, *, speed: float | None = None, guess: FloatArray | None = None
) -> Equilibrium:
    """Return the static equilibrium of a journal under its loads at t = 0.

    ``journal``: the journal and its loads. ``speed``: speed of rotation [rad/s]; the journal's own by
    default. ``guess``: attitude to try first [m, rad], shape (2,) or (4,). By default, and where it leads
    nowhere, the journal is laid against the bushing in the direction of the load. Raises InputError if no
    equilibrium is found: the load is more than contact and film can carry.
    """
    turning = journal if speed is None else replace(journal, speed=speed)
    statics = _Statics(turning)
    starts = _starts(turning)
    if guess is not None:
        starts.insert(0, np.asarray(guess, dtype=np.float64))
    half = statics.joint.z[-1]
    scale = np.array([1.0, 1.0, 1.0 / half, 1.0 / half])[: journal.freedoms]
    for start in starts:
        q = damped_newton(statics, start[: journal.freedoms], scale, 0.5 * journal.joint.roughness)
        if q is not None and statics.in_range:
            statics(q)
            return Equilibrium(turning, statics.state[:4].copy(), statics.contact, statics.oil)
    raise InputError(
        f"no equilibrium was found: {journal.loads.force:.4g} N may be more than this bearing can carry",
        key="loads.force_x",
    )


class _Statics:
    """The loads on a journal whose axis is at rest, over its attitude."""

    def __init__(self, journal: Journal) -> None:
        self.journal, self.joint = journal, journal.joint.data()
        self.film = None if journal.film is None else (journal.film.data(), journal.film.memory())
        self.memory, self.state = new_memory(self.joint), np.zeros(8)
        self.contact, self.oil = np.zeros(5), np.zeros(5)
        loads = journal.loads
        self.load = np.array([loads.force_x, loads.force_y, loads.moment_x, loads.moment_y])

    def __call__(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the generalised loads at an attitude (n,), and their derivative (n, n).

        The moments of the joint act on the tilts as M sec²φ, because a point of the axis at height z moves
        by −z sec²φ dφ.
        """
        n, speed, scratch = q.size, self.journal.speed, self.memory.scratch
        self.state[:n] = q
        fill_pose(self.state, speed, 0.0, scratch.pose)
        wrench_and_jacobian(self.joint, self.memory, scratch.pose, scratch.wrench, scratch.jacobian)
        jacobian, of_film = np.zeros((5, 9)), np.zeros((5, 9))
        from_wrench(scratch.wrench, self.contact)
        from_jacobian(scratch.jacobian, jacobian)
        if self.film is not None:
            film_wrench_and_jacobian(*self.film, self.state, speed, self.oil, of_film)
        tangent = np.append([0.0, 0.0], portable.tan(self.state[2:4]))
        sec2, wrench = 1.0 + tangent**2, (self.contact + self.oil)[:4]
        gradient = sec2[:, None] * (jacobian + of_film)[:4, :4] + np.diag(2.0 * sec2 * tangent * wrench)
        return (self.load + sec2 * wrench)[:n], gradient[:n, :n]

    @property
    def in_range(self) -> bool:
        """Whether the contact law reaches the attitude last looked at; Newton may end where it does not."""
        report(self.joint, self.memory, self.memory.scratch.pose)
        deepest = self.journal.joint.table.h_first * self.journal.joint.roughness
        return bool(self.memory.scratch.report.separation_min >= deepest)


def _starts(journal: Journal) -> list[FloatArray]:
    """Lay the journal against the bushing in the direction of the load."""
    clearance, roughness = journal.joint.geometry.clearance, journal.joint.roughness
    depths = [max(clearance - depth * roughness, 0.1 * clearance) for depth in _START_DEPTHS]
    return [np.append(e * journal.loads.direction, [0.0, 0.0]) for e in depths]
