"""A film at one state, evaluated from Python, and why a film has no answer."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
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
