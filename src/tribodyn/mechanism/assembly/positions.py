"""Rows of a mechanism at states that are not integrated: known by geometry, or in equilibrium.

The functions of its problem are called as after accepted steps, so that rows hold the same quantities:
forces, reactions, works, sliding loads. Drives may turn back at some time: from then on their motion is
repeated backward, by the same mechanism with the time reversed.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure, Stopped
from tribodyn.core.problem import Problem, Solution, Statistics
from tribodyn.integrate import INTERRUPTED
from tribodyn.integrate.driver import Kept
from tribodyn.kernels.actions import TIME
from tribodyn.kernels.mechanism.data import INTACT, NONE, MechanismData
from tribodyn.mechanisms.signal_pieces import backward, constant

BROKEN: Final = "a joint has come apart"
_SAME: Final = 1.0e-12  #: Difference of times over the later one that is rounding.


@dataclass(frozen=True)
class DrivePath:
    """Times of positions, and where the drives are then."""

    times: FloatArray  #: Rising, from 0 [s], shape (n_t,).
    turn: float = math.inf  #: When the drives turn back [s]; infinite where they do not.

    @property
    def forward(self) -> FloatArray:
        """Direction of the motion at each time: 1, or −1 after the drives have turned back, shape (n_t,)."""
        return np.where(self.times > self.turn * (1.0 + _SAME), -1.0, 1.0)

    @property
    def of_drives(self) -> FloatArray:
        """Time of the drives at each of these [s], shape (n_t,)."""
        if math.isinf(self.turn):
            return self.times
        return np.asarray(self.turn - np.abs(self.times - self.turn))


class States(Protocol):
    """Finds the states of a mechanism."""

    def __call__(self, number: int) -> FloatArray:
        """Return the state at the time with a number, which rises by one, shape (13 n,).

        Raises ``IntegrationFailure`` where there is none.
        """
        ...


def walked(
    problem: Problem,
    path: DrivePath,
    states: States,
    picture_times: FloatArray,
    progress: Callable[[float], None] | None,
) -> Solution:
    """Return the rows of a problem, whose memory is changed, at given states along a path.

    Each of the pictures [s] is taken at the nearest row; ``progress`` is called with each time reached.
    """
    begin, walk = time.perf_counter(), _Walk(problem, path, picture_times.size)
    nearest = np.abs(path.times[:, None] - picture_times).argmin(axis=0) if path.times.size else []
    shown, failure, reached = np.unique(nearest).astype(int), None, 0
    field = np.zeros((1, *problem.field_shape))
    y = problem.y0.copy()
    try:
        for k in range(path.times.size):
            y = walk.put(k, states(k))
            if k in shown:
                walk.picture(k, y, field[0])
                walk.kept.add_pictures(field)
            reached = k + 1
            if progress is not None:
                progress(float(path.times[k]))
    except IntegrationFailure as error:
        failure = str(error)
    except Stopped:
        failure = INTERRUPTED
    taken = shown[shown < reached]
    return Solution(
        t=path.times[:reached],
        rows=walk.kept.rows[:reached],
        picture_times=path.times[taken],
        pictures=walk.kept.pictures[: taken.size],
        t_end=float(path.times[reached - 1]) if reached else 0.0,
        y_end=y,
        statistics=Statistics(steps=reached, wall_time=time.perf_counter() - begin),
        failure=failure,
    )


class _Walk:
    """Calls the functions of a problem at one state after the other."""

    def __init__(self, problem: Problem, path: DrivePath, n_pictures: int) -> None:
        self.problem, self.path, self.memory = problem, path, problem.memory
        self.functions = problem.functions
        self.data: MechanismData = problem.data
        self.clock, self.last = path.of_drives * path.forward, 0.0
        self.kept = Kept(problem, path.times.size, n_pictures)
        self.row = np.empty((1, problem.n_observed))

    def put(self, k: int, state: FloatArray) -> FloatArray:
        """Put the mechanism into a state and fill its row; return the state on the constraints."""
        t, y, memory = float(self.clock[k]), state.copy(), self.memory
        if k > 0 and self.path.forward[k] < self.path.forward[k - 1]:
            self._turn_back()
        kinks = self.data.signals.kinks
        if k == 0 or np.any((kinks > self.last) & (kinks <= t)):
            self.functions.enter(t, y, self.data, memory)
        else:
            self.functions.advance(self.last, t, y, self.data, memory)
        self.functions.observe(t, y, self.data, memory, self.row[0])
        self.kept.add_rows(self.row)
        self.functions.accept(t, y, self.data, memory)
        if memory.now.course.broken != INTACT:
            raise IntegrationFailure(float(self.path.times[k]), BROKEN)
        self.last = t
        return y

    def picture(self, k: int, y: FloatArray, fields: FloatArray) -> None:
        """Fill the fields at the state that was put last."""
        self.functions.picture(float(self.clock[k]), y, self.data, self.memory, fields)

    def _turn_back(self) -> None:
        """Go on with the time reversed, from where the drives turn."""
        self.data = in_reverse(self.data)
        self.last = -self.path.turn
        self.functions.enter(self.last, self.memory.settled.copy(), self.data, self.memory)


def in_reverse(data: MechanismData) -> MechanismData:
    """Return a mechanism whose drives and loads run backward: what was at time t is at −t."""
    return data._replace(signals=backward(data.signals, _of_time(data)))


def held(data: MechanismData, times: FloatArray) -> MechanismData:
    """Return a mechanism whose drives and loads are held: at each of some times as they are then [s]."""
    return data._replace(signals=constant(data.signals, _of_time(data), times))


def _of_time(data: MechanismData) -> list[int]:
    """Return the numbers of the signals that follow time."""
    couplings, terms = data.parts.couplings, data.terms
    of_time = [couplings.row_signal.ravel(), couplings.effort.ravel(), terms.signals[terms.over == TIME]]
    numbers = np.unique(np.concatenate(of_time))
    found: list[int] = numbers[numbers != NONE].tolist()
    return found
