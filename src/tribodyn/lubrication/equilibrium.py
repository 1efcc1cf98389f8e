"""A film at one state, why it has no answer, and the equilibrium of a shaft that a film carries alone."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.kernels import dense
from tribodyn.kernels.film.data import (
    CONVERGED,
    NO_CONVERGENCE,
    NO_MEAN_GAP,
    NOT_STEADY,
    OUT_OF_RANGE,
    FilmData,
    FilmMemory,
)
from tribodyn.kernels.film.report import film_leakage, film_pressure
from tribodyn.kernels.film.wrench import film_wrench_and_jacobian
from tribodyn.lubrication.oil_film import Film

_REASONS: Final = {
    CONVERGED: "converged",
    NO_CONVERGENCE: "the cavitated part of the film did not settle",
    OUT_OF_RANGE: (
        "the gap closed: somewhere h < −4σ (with smooth surfaces h ≤ 0); the shaft is outside "
        "the bushing, or the load is too high for film and asperities"
    ),
    NOT_STEADY: "jfo is for steady films: the shaft must turn and its centre rest",
    NO_MEAN_GAP: "jfo needs a positive mean gap everywhere; the surfaces are pressed too far into each other",
}


def explain(status: int) -> str:
    """Return the meaning of a status of ``kernels.film``."""
    return _REASONS[status]


@dataclass(frozen=True)
class FilmState:
    """Forces and losses of a film at one state."""

    force: tuple[float, float]  #: (F_x, F_y) on the shaft [N].
    moment: tuple[float, float]  #: (M_x, M_y) on the shaft [N m], right- and left-handed.
    torque: float  #: Fluid friction on the shaft about its axis [N m].
    leakage: float  #: Volume that leaves both ends [m³/s].
    #: From the load that the film carries to the line of centres, in the direction of θ [rad].
    attitude_angle: float
    pressure: FloatArray  #: At the nodes [Pa], shape (n_z + 1, n_theta).
    jacobian: FloatArray  #: Derivatives of force, moment and torque in the eight states and ω, shape (5, 9).


def film_state(
    film: Film | FilmData, y: FloatArray, *, omega: float = 0.0, memory: FilmMemory | None = None
) -> FilmState:
    """Evaluate a film.

    Parameters
    ----------
    film
        The film, or its data with a wear field; data need a ``memory``.
    y
        Attitude and rates (e_x, e_y, φ_x, φ_y, ė_x, ė_y, φ̇_x, φ̇_y), shape (8,), SI units.
    omega
        Speed of the shaft [rad/s].
    memory
        From ``Film.memory``, to be reused; a new one by default.

    Raises
    ------
    InputError
        If there is no film at this state.
    """
    data = film.data() if isinstance(film, Film) else film
    cache = film.memory() if memory is None and isinstance(film, Film) else memory
    if cache is None:
        raise InputError("film data need the memory of their film")
    out, jacobian, pressure = np.empty(5), np.empty((5, 9)), np.empty(data.wear_node.T.shape)
    state = np.array(y, dtype=np.float64)
    status = film_wrench_and_jacobian(data, cache, state, float(omega), out, jacobian)
    if status != CONVERGED:
        raise InputError(explain(status), key="film")
    film_pressure(data, cache, pressure)
    return FilmState(
        force=(float(out[0]), float(out[1])),
        moment=(float(out[2]), float(out[3])),
        torque=float(out[4]),
        leakage=float(film_leakage(data, cache)),
        attitude_angle=_attitude_angle(out, state),
        pressure=pressure,
        jacobian=jacobian,
    )


def _attitude_angle(out: FloatArray, y: FloatArray) -> float:
    along = -(out[0] * y[0] + out[1] * y[1])
    across = -(out[0] * y[1] - out[1] * y[0])
    return float(portable.atan2(across, along))


_DEEPEST: Final = 4.0  #: Overlap of the mean planes over σ down to which a rough film has an answer.
#: Distances that the search keeps from its start and from the ends of its range, over the clearance.
_MARGIN: Final = 1.0e-6
#: Cells that the film must have on either side of its thinnest place, up to twice its least thickness.
_THIN_CELLS: Final = 2.0
_SETTLED: Final = 1.0e-10  #: Length of a step of Newton's that changes nothing any more, over the clearance.


@dataclass(frozen=True)
class FilmEquilibrium:
    """A shaft that turns in its film about a resting axis, parallel to the bushing."""

    film: Film  #: The film.
    load: tuple[float, float]  #: (W_x, W_y) on the shaft [N].
    omega: float  #: Speed of the shaft [rad/s].
    position: FloatArray  #: (e_x, e_y), the centre of the shaft from the axis of the bushing [m], shape (2,).
    #: What the film does there: ``leakage``, ``pressure``, stiffness and damping in ``jacobian``, ....
    state: FilmState

    @property
    def eccentricity(self) -> float:
        """Distance of the centre from the axis of the bushing [m]."""
        return float(portable.hypot(*self.position))

    @property
    def eccentricity_ratio(self) -> float:
        """ε, eccentricity over radial clearance [1]; above 1 where mean planes of rough surfaces overlap."""
        return self.eccentricity / self.film.clearance

    @property
    def least_film(self) -> float:
        """Smallest gap between the mean planes, c − e [m]."""
        return self.film.clearance - self.eccentricity

    @property
    def attitude_angle(self) -> float:
        """From the load to the line of centres, in the direction of θ [rad]."""
        return self.state.attitude_angle

    @property
    def sommerfeld_number(self) -> float:
        """So = W ψ²/(L D η ω) with ψ = c/r [1], as in DIN 31652; that of Raimondi and Boyd is 1/(2π So)."""
        film = self.film
        area = 2.0 * film.radius * film.length
        slender = film.clearance / film.radius
        return math.hypot(*self.load) * slender**2 / (area * film.viscosity * abs(self.omega))

    @property
    def friction_coefficient(self) -> float:
        """Friction torque over shaft radius and load [1]."""
        return abs(self.state.torque) / (self.film.radius * math.hypot(*self.load))


def film_equilibrium(film: Film, load: tuple[float, float], *, omega: float) -> FilmEquilibrium:
    """Return the place of a shaft that a film carries without any help from contact.

    Shaft and bushing are round: how far the centre lies from the axis follows from the size of the load,
    and in which direction by turning. Newton's method then removes what the grid knows of directions.

    A grid shows a film as thin as leaves it two cells to either side before it is twice as thick; there the
    least film is off by some per cent.

    Parameters
    ----------
    film
        The film, unworn.
    load
        (W_x, W_y) on the shaft [N].
    omega
        Speed of the shaft [rad/s], right-handed.

    Raises
    ------
    InputError
        If there is no load or no rotation, if the load is more than rough surfaces let the film carry at any
        place, or if the grid is too coarse for a film as thin as the load leaves.
    """
    size = math.hypot(*load)
    if not 0.0 < size < math.inf:
        raise InputError(f"given a load of {size:g} N; an equilibrium needs a finite one above 0", key="load")
    if not 0.0 < abs(omega) < math.inf:
        raise InputError(f"given {omega:g} rad/s; a film carries by rotation only", key="omega")
    at = _Evaluations(film.data(), film.memory(), float(omega))
    distance = _distance(film, at, size)
    turned = portable.atan2(load[1], load[0]) + at(np.array([distance, 0.0])).attitude_angle
    position = _balanced(film, at, load, distance * np.array([portable.cos(turned), portable.sin(turned)]))
    return FilmEquilibrium(film, load, omega, position, at(position))


@dataclass(frozen=True)
class _Evaluations:
    """A film at one speed, evaluated where the centre of the shaft is (e_x, e_y) [m]."""

    data: FilmData
    memory: FilmMemory
    omega: float

    def __call__(self, position: FloatArray) -> FilmState:
        return film_state(self.data, np.append(position, np.zeros(6)), omega=self.omega, memory=self.memory)


def _distance(film: Film, at: _Evaluations, size: float) -> float:
    """Return the eccentricity [m] at which the film pushes with ``size`` [N]."""
    from scipy.optimize import brentq

    def excess(eccentricity: float) -> float:
        """Return force less load over their sum: finite from the centre on, and of order one everywhere."""
        force = math.hypot(*at(np.array([eccentricity, 0.0])).force)
        return (force - size) / (force + size)

    trial, shown = _farthest(film)
    near, far = 0.0, trial
    while far - near > _MARGIN * film.clearance:
        try:
            enough = excess(trial) >= 0.0
        except InputError:
            far = trial  # touching surfaces: not every cavitation model has an answer as far as this
        else:
            if enough:
                return float(brentq(excess, near, trial, xtol=1.0e-12 * film.clearance, rtol=1.0e-12))
            near = trial
        trial = 0.5 * (near + far)
    raise _too_much(at, size) if shown else _too_coarse(film, size)


def _balanced(film: Film, at: _Evaluations, load: tuple[float, float], guess: FloatArray) -> FloatArray:
    """Return the position at which force and load cancel [m], shape (2,), from one near by."""
    from scipy.optimize import root

    size, clearance = math.hypot(*load), film.clearance

    def residual(share: FloatArray) -> tuple[FloatArray, FloatArray]:
        state = at(clearance * share)
        return (np.array(state.force) + load) / size, state.jacobian[:2, :2] * (clearance / size)

    try:
        found = np.asarray(root(residual, guess / clearance, jac=True, options={"xtol": 1.0e-13}).x)
        missed, stiffness = residual(found)
    except InputError:
        raise _too_coarse(film, size) from None
    if not dense.norm(dense.solve(stiffness, missed)) < _SETTLED:
        raise _too_coarse(film, size)
    return clearance * found


def _farthest(film: Film) -> tuple[float, bool]:
    """Return the largest eccentricity looked at [m], and whether the film ends there and not the grid.

    From the thinnest place, h, the gap has grown to 2 h at the angle √(2h/e). Roughness keeps h for the
    flow above σ/2.
    """
    roughness, angle = film.roughness.combined, _THIN_CELLS * 2.0 * math.pi / film.grid.theta
    end = (1.0 - _MARGIN) * film.clearance + _DEEPEST * roughness
    if roughness >= end * angle * angle:
        return end, True
    return film.clearance / (1.0 + 0.5 * angle * angle), False


def _too_much(at: _Evaluations, size: float) -> InputError:
    return InputError(
        f"given {size:.4g} N; at {abs(at.omega):.4g} rad/s that is more than this film carries alone",
        key="load",
    )


def _too_coarse(film: Film, size: float) -> InputError:
    return InputError(
        f"given {film.grid.theta} x {film.grid.z} cells; a load of {size:.4g} N leaves a thinner film than "
        "they can show: give more",
        key="film.grid",
    )
