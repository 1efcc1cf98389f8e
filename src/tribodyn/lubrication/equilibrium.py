"""Equilibrium of a shaft that a film carries alone: from load and speed to its place, without contact."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels import dense
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.lubrication.oil_film import Film
from tribodyn.lubrication.state import FilmState, film_state

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
