"""Static equilibrium of a shaft in its bore, and its friction over speed: the Stribeck curve.

The axis of the shaft is at rest, so the film has its wedge and no squeeze, the contact no damping, and
friction slides at ω r_j.

At low speed asperities carry the load and friction is theirs; at high speed the film does and friction grows
with speed as its shear does. In between, in mixed lubrication, friction is least.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, cast

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import Case
from tribodyn.cases.units import from_si, to_si
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given
from tribodyn.joints import BushingJoint, EntryMemory, Friction, Grid
from tribodyn.joints.bushing import new_memory
from tribodyn.joints.shapes import Cylinder
from tribodyn.kernels import dense
from tribodyn.kernels.film.wrench import film_wrench_and_jacobian
from tribodyn.kernels.joints.bushing import report, wrench_and_jacobian
from tribodyn.kernels.joints.pose import fill_pose, from_jacobian, from_wrench
from tribodyn.lubrication.oil_film import Film
from tribodyn.mechanism.assembly.clearance_surfaces import axes_of, clearances_of
from tribodyn.mechanism.frames import GROUND, frame
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanisms.balance import damped_newton

_START_DEPTHS: Final = (2.0, 1.0, 3.0, 0.0)  #: Separations over σ tried for the first guess.


@dataclass(frozen=True)
class Journal:
    """A shaft in a bore under a constant load, in axes of which Z is that of the bore."""

    joint: BushingJoint  #: The bore.
    load: tuple[float, float]  #: Force along X and Y [N]; the shaft stays parallel to the bore.
    film: Film | None = None  #: The oil film; none by default.

    @property
    def force(self) -> float:
        """Size of the force [N]."""
        return float(portable.hypot(*self.load))

    @property
    def direction(self) -> FloatArray:
        """Unit vector along the force, shape (2,); along X where there is none."""
        return np.array(self.load) / self.force if self.force else np.array([1.0, 0.0])


def journal_of(case: Case, joint: str = "", load: float | str | None = None) -> Journal:
    """Return the shaft of a joint of a mechanism in its bore, at the temperatures of the run.

    ``joint``: the joint; by default the one with an oil film, or the only one that is a shaft in a bore; its
    end faces are left out. ``load``: across its axis, along X [N], or a text with its unit; by default the
    constant forces of a case with one body. Raises InputError if there is no such joint, or no such load.
    """
    real = clearances_of(case) if isinstance(case, MechanismCase) else {}
    bores = {name: one for name, one in real.items() if isinstance(one.shape, Cylinder)}
    oiled = [name for name, one in bores.items() if one.film is not None]
    name = joint or next(iter(oiled if len(oiled) == 1 else bores), "")
    if name not in bores or not (joint or len(oiled) == 1 or len(bores) == 1):
        words = f"given {as_given(joint)}; shafts in bores: {', '.join(bores) or 'none'}"
        raise InputError(words, key="joint")
    found, shape = bores[name], bores[name].shape
    assert isinstance(case, MechanismCase)
    assert isinstance(shape, Cylinder)
    bushing = BushingJoint(
        geometry=shape,
        friction=Friction(found.friction_coefficient, "traction", found.slip_velocity),
        entry=EntryMemory(found.onset, found.minimum_velocity, found.tensile_clip),
        grid=Grid(*found.grid),
        roughness=found.roughness,
        table=found.table,
        contact=found.contact,
        liner=found.liner,
        form=shape.form,
        bulk=found.bulk,
        hardness=found.hardness,
    )
    given = load if load is None or isinstance(load, float | int) else to_si(load, "N")
    return Journal(bushing, _constant(case, name) if given is None else (given, 0.0), found.film)


def _constant(case: MechanismCase, name: str) -> tuple[float, float]:
    """Return the constant force on the only body of a case, across the axis of its joint [N]."""
    joint, total = case.joints[name], np.zeros(3)
    socket = joint.clearance.socket if joint.clearance is not None else None
    sizes = [(load, key, signal) for load in case.loads.values() for key, signal in load.given.items()]
    alone = len(case.bodies) == 1 and (socket or joint.between[0]) == GROUND and not any(case.gravity)
    steady = all(
        load.frame == "ground" and not one.axes and one.signal().kind == "constant" for load, _, one in sizes
    )
    if not (sizes and alone and steady and not case.springs):
        raise InputError('its load does not follow from the case: give one, such as "200 N"', key="load")
    for load, key, signal in sizes:
        total += (signal.value or 0.0) * np.array(load.shares(key)[:3])
    x, y, _ = dense.product(total, frame(*axes_of(case, joint))).tolist()
    return x, y


@dataclass(frozen=True)
class Equilibrium:
    """A shaft at rest in its bore, but for its rotation."""

    journal: Journal  #: The shaft.
    centre: FloatArray  #: (e_x, e_y) from the axis of the bore [m], shape (2,).
    #: Wrench of contact pressure and friction on the shaft (F_x, F_y, M_x, M_y, M_z) [N, N m], shape (5,).
    contact: FloatArray
    film: FloatArray  #: The same of the film.

    @property
    def eccentricity(self) -> float:
        """Distance of the centre from the axis of the bore [m]."""
        return float(portable.hypot(*self.centre))

    @property
    def friction_coefficient(self) -> float:
        """Moment that resists the rotation over r_j and load [1]."""
        moment = abs(float(self.contact[4] + self.film[4]))
        return moment / (self.journal.joint.geometry.radius * self.journal.force)

    @property
    def contact_share(self) -> float:
        """Share of the load that contact, with its friction, carries [1]."""
        return self._share(self.contact)

    @property
    def film_share(self) -> float:
        """Share of the load that the film carries [1]."""
        return self._share(self.film)

    def _share(self, wrench: FloatArray) -> float:
        return -float(dense.product(wrench[:2], self.journal.direction)) / self.journal.force


def equilibrium(journal: Journal, *, speed: float = 0.0, guess: FloatArray | None = None) -> Equilibrium:
    """Return the static equilibrium of a shaft under its load.

    ``journal``: the shaft and its load; ``speed``: speed of rotation ω about Z, right-handed [rad/s];
    ``guess``: centre to try first [m], shape (2,). By default, and where it leads nowhere, the shaft is laid
    against the bore in the direction of the load. Raises InputError if no equilibrium is found: the load is
    more than contact and film can carry.
    """
    statics = _Statics(journal, speed)
    starts = _starts(journal)
    if guess is not None:
        starts.insert(0, np.asarray(guess, dtype=np.float64))
    for start in starts:
        centre = damped_newton(statics, start, np.ones(2), 0.5 * journal.joint.roughness)
        if centre is not None and statics.in_range:
            statics(centre)
            return Equilibrium(journal, centre, statics.contact, statics.oil)
    words = f"no equilibrium was found: {journal.force:.4g} N may be more than this bearing can carry"
    raise InputError(words, key="load")


class _Statics:
    """The forces on a shaft whose axis is at rest, over its centre."""

    def __init__(self, journal: Journal, speed: float) -> None:
        self.journal, self.speed, self.joint = journal, speed, journal.joint.data()
        self.film = None if journal.film is None else (journal.film.data(), journal.film.memory())
        self.memory, self.state = new_memory(self.joint), np.zeros(8)
        self.contact, self.oil = np.zeros(5), np.zeros(5)

    def __call__(self, centre: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces at a centre, shape (2,), and their derivative, shape (2, 2)."""
        scratch = self.memory.scratch
        self.state[:2] = centre
        fill_pose(self.state, self.speed, 0.0, scratch.pose)
        wrench_and_jacobian(self.joint, self.memory, scratch.pose, scratch.wrench, scratch.jacobian)
        jacobian, of_film = np.zeros((5, 9)), np.zeros((5, 9))
        from_wrench(scratch.wrench, self.contact)
        from_jacobian(scratch.jacobian, jacobian)
        if self.film is not None:
            film_wrench_and_jacobian(*self.film, self.state, self.speed, self.oil, of_film)
        forces = np.array(self.journal.load) + (self.contact + self.oil)[:2]
        return forces, (jacobian + of_film)[:2, :2]

    @property
    def in_range(self) -> bool:
        """Whether the contact law reaches the attitude last looked at; Newton may end where it does not."""
        report(self.joint, self.memory, self.memory.scratch.pose)
        deepest = self.journal.joint.table.h_first * self.journal.joint.roughness
        return bool(self.memory.scratch.report.separation_min >= deepest)


def _starts(journal: Journal) -> list[FloatArray]:
    """Lay the shaft against the bore in the direction of the load."""
    clearance, roughness = journal.joint.geometry.clearance, journal.joint.roughness
    depths = [max(clearance - depth * roughness, 0.1 * clearance) for depth in _START_DEPTHS]
    return [e * journal.direction for e in depths]


_SPEEDS: Final = np.geomspace(1.0, 1000.0, 31)
_COLUMNS: Final = {
    "friction_coefficient": ("1", "friction moment over radius and load"),
    "film_share": ("1", "share of the load that the film carries"),
    "contact_share": ("1", "share of the load that asperities carry"),
    "eccentricity": ("m", "distance of the centre from the axis of the bore"),
}


def equilibria(journal: Journal, speeds: Iterable[float]) -> list[Equilibrium]:
    """Return the static equilibria of a shaft over its speed; each starts from the one before.

    ``journal``: the shaft, its load and its film; ``speeds``: speeds of rotation [rad/s], in an order in
    which neighbours are near. Raises InputError if there is no load, or no equilibrium at one of the speeds.
    """
    if journal.force == 0.0:
        raise InputError("a Stribeck curve needs a load", key="load")
    points: list[Equilibrium] = []
    for speed in speeds:
        guess = points[-1].centre if points else None
        points.append(equilibrium(journal, speed=float(speed), guess=guess))
    return points


def stribeck(
    case: Case,
    speeds: Iterable[float] | None = None,
    *,
    viscosity: Sequence[object] = (),
    joint: str = "",
    load: float | str | None = None,
) -> xr.Dataset:
    """Return the friction of a loaded shaft in oil over its speed, and who carries the load.

    Parameters
    ----------
    case
        A mechanism with an oil film in a joint that has friction, such as ``journal-oil`` with
        ``joints.bearing.clearance.friction_coefficient = 0.1``.
    speeds
        Speeds of rotation [rad/s], neighbours near each other; by default 31 from 1 to 1000.
    viscosity
        Viscosities to draw a curve for, as a case file has them; by default that of the case.
    joint
        Of several with an oil film, the joint.
    load
        Across the axis of the joint [N], or a text with its unit; by default the constant forces of a case
        with one body.

    Returns
    -------
    xarray.Dataset
        Friction coefficient, shares of film and asperities and eccentricity over ``viscosity`` [Pa s] and
        ``speed`` [rad/s].

    Raises
    ------
    InputError
        The case has no film, no friction or no load, or there is no equilibrium at one of the speeds.
    """
    oiled = case.oiled if isinstance(case, MechanismCase) else []
    if not oiled:
        raise InputError(
            "a Stribeck curve needs a shaft in oil: journal-oil, or a joint with a film", key="case"
        )
    if joint not in oiled and (joint or len(oiled) > 1):
        raise InputError(f"given {as_given(joint)}; joints with a film: {', '.join(oiled)}", key="joint")
    name = joint or oiled[0]
    film, friction = f"joints.{name}.film", f"joints.{name}.clearance.friction_coefficient"
    if case.at(friction) == 0.0:
        words = "without friction of the asperities there is no Stribeck curve: give one, such as 0.1"
        raise InputError(words, key=friction)
    places: FloatArray = _SPEEDS if speeds is None else np.array(list(speeds), dtype=np.float64)
    cases = [case.replace({f"{film}.viscosity": value}) for value in viscosity] or [case]
    curves = [equilibria(journal_of(one, name, load), places) for one in cases]
    columns = {
        name: (
            ("viscosity", "speed"),
            np.array([[getattr(point, name) for point in points] for points in curves]),
            {"units": unit, "long_name": words},
        )
        for name, (unit, words) in _COLUMNS.items()
    }
    viscosities = [float(cast(float, one.at(f"{film}.viscosity"))) for one in cases]
    coordinates = {
        "speed": ("speed", places, {"units": "rad/s", "long_name": "speed of rotation"}),
        "viscosity": ("viscosity", viscosities, {"units": "Pa s", "long_name": "viscosity"}),
    }
    names = [from_si(value, "mPa s") for value in viscosities]
    return xr.Dataset(columns, coordinates, {"title": f"{case.title}: Stribeck curve", "viscosity": names})
