"""Static equilibrium of the journal: from load and speed to attitude, and who carries the load.

The axis of the journal is at rest, so the film has its wedge and no squeeze, the contact no damping, and
friction slides at ω r_j.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels import dense
from tribodyn.kernels.journal.data import JournalData, JournalMemory
from tribodyn.kernels.journal.equations import least_gap
from tribodyn.kernels.journal.functions import static_residual
from tribodyn.mechanisms.balance import damped_newton
from tribodyn.mechanisms.journal.parameters import Journal
from tribodyn.mechanisms.journal.problem import journal_data, journal_memory

_START_DEPTHS: Final = (2.0, 1.0, 3.0, 0.0)
"""Separations over σ tried for the first guess."""


@dataclass(frozen=True)
class Equilibrium:
    """A journal at rest in its bushing, but for its rotation.

    Attributes
    ----------
    journal
        The journal, with its speed.
    attitude
        (e_x, e_y, φ_x, φ_y) [m, rad], shape (4,).
    contact
        Wrench of contact pressure and friction on the journal (F_x, F_y, M_x, M_y, M_z) [N, N m], shape (5,).
    film
        The same of the film.
    """

    journal: Journal
    attitude: FloatArray
    contact: FloatArray
    film: FloatArray

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

    Parameters
    ----------
    journal
        The journal and its loads.
    speed
        Speed of rotation [rad/s]; the journal's own by default.
    guess
        Attitude to try first [m, rad], shape (2,) or (4,). By default, and where it leads nowhere, the
        journal is laid against the bushing in the direction of the load.

    Raises
    ------
    InputError
        If no equilibrium is found: the load is more than contact and film can carry.
    """
    turning = journal if speed is None else replace(journal, speed=speed)
    data = journal_data(turning)
    memory = journal_memory(turning, data)
    static_residual(np.zeros(journal.freedoms), data, memory, *_room(journal.freedoms))
    load = memory.scratch.load[:2].copy()
    starts = _starts(turning, load)
    if guess is not None:
        starts.insert(0, np.asarray(guess, dtype=np.float64))
    half = data.joint.z[-1]
    scale = np.array([1.0, 1.0, 1.0 / half, 1.0 / half])[: journal.freedoms]
    for start in starts:
        q = damped_newton(
            partial(_residual, data, memory), start[: journal.freedoms], scale, 0.5 * journal.joint.roughness
        )
        if q is not None and _in_range(data, memory):
            return _described(turning, data, memory, q)
    raise InputError(
        f"no equilibrium was found: {portable.hypot(*load):.4g} N may be more than this bearing can carry",
        key="loads.force_x",
    )


def _room(n: int) -> tuple[FloatArray, FloatArray]:
    return np.empty(n), np.empty((n, n))


def _residual(data: JournalData, memory: JournalMemory, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    residual, jacobian = _room(q.size)
    static_residual(q, data, memory, residual, jacobian)
    return residual, jacobian


def _in_range(data: JournalData, memory: JournalMemory) -> bool:
    """Tell whether the contact law reaches the attitude last looked at; Newton may end where it does not."""
    return bool(least_gap(data.joint, memory.scratch.state) >= data.constants.deepest)


def _starts(journal: Journal, load: FloatArray) -> list[FloatArray]:
    """Lay the journal against the bushing in the direction of the load [N], shape (2,)."""
    size = float(portable.hypot(*load))
    direction = load / size if size > 0.0 else np.array([1.0, 0.0])
    clearance, roughness = journal.joint.geometry.clearance, journal.joint.roughness
    depths = [max(clearance - depth * roughness, 0.1 * clearance) for depth in _START_DEPTHS]
    return [np.append(e * direction, [0.0, 0.0]) for e in depths]


def _described(journal: Journal, data: JournalData, memory: JournalMemory, q: FloatArray) -> Equilibrium:
    """Return the equilibrium at ``q`` with the wrenches on the journal there."""
    _residual(data, memory, q)
    attitude = np.zeros(4)
    attitude[: q.size] = q
    return Equilibrium(journal, attitude, memory.scratch.wrench.copy(), memory.scratch.film.copy())
