"""The first step: f at the start, and at a trial point if the step must be estimated."""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.control import norm, set_weights
from mebdf.kernels.jit import kernel
from mebdf.kernels.state import Numbers

#: Shortest first step relative to the time: 16 or more spacings between numbers.
SHORTEST: Final = 16.0 * float(np.finfo(np.float64).eps)


@kernel
def start(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> int:
    """Go through the phases before the first step; return what is needed, 0 when it can begin."""
    if state.phase == phases.BEGIN:
        set_weights(state, rows, mass, places)
        return _ask(state, rows, 0.0, phases.FIRST_F)
    if state.phase == phases.FIRST_F:
        if remember_not_finite(state, rows):
            state.reason = phases.NOT_FINITE
            return phases.FAILED
        first = at.F_2 if places.size > 0 else at.F_1
        for i in range(rows.shape[1]):
            rows[first, i] = rows[at.F, i]
        if state.h == 0.0:
            state.h = _trial_step(state, rows)
            return _ask(state, rows, state.direction * state.h, phases.SECOND_F)
    else:
        state.h = _first_step(state, rows, places)
    state.h = max(state.h, _least(state)) * state.direction
    for i in range(rows.shape[1]):
        rows[at.HISTORY + 1, i] = state.h * rows[at.F_1, i]
    state.phase = phases.STEP
    return 0


@kernel
def _ask(state: Numbers, rows: FloatArray, h: float, phase: int) -> int:
    """Ask for f a distance ``h`` along the first slope."""
    for i in range(rows.shape[1]):
        rows[at.Y, i] = rows[at.HISTORY, i]
        if h != 0.0:
            rows[at.Y, i] += h * rows[at.F_1, i]
    state.t_eval = state.t + h
    state.phase = phase
    state.n_f += 1
    return phases.NEED_F


@kernel
def remember_not_finite(state: Numbers, rows: FloatArray) -> bool:
    """Remember a place where f is not finite; tell whether there was one."""
    for i in range(rows.shape[1]):
        if not math.isfinite(rows[at.F, i]):
            state.bad = i
            state.t_bad = state.t_eval
            return True
    return False


@kernel
def _trial_step(state: Numbers, rows: FloatArray) -> float:
    """Return a step over which the solution changes by about a hundredth of itself."""
    value, slope = norm(rows, at.HISTORY, at.WEIGHT), norm(rows, at.F_1, at.WEIGHT)
    size = 1.0e-6 if value < 1.0e-5 or slope < 1.0e-5 else 0.01 * value / slope
    return max(min(size, state.h_max, abs(state.t_end - state.t)), _least(state))


@kernel
def _least(state: Numbers) -> float:
    """Return the shortest first step: the times of its stages must differ."""
    return min(SHORTEST * abs(state.t), state.h_max, abs(state.t_end - state.t))


@kernel
def _first_step(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> float:
    """Return the size of the first step from two slopes: Hairer, Nørsett and Wanner, II.4, for order one."""
    trial = state.h
    slope = norm(rows, at.F_1, at.WEIGHT)
    first, weight = (at.F_2, at.ROW_WEIGHT) if places.size > 0 else (at.F_1, at.WEIGHT)
    for i in range(rows.shape[1]):
        rows[at.DELTA, i] = (rows[at.F, i] - rows[first, i]) / trial
    largest = max(slope, norm(rows, at.DELTA, weight))
    if not math.isfinite(largest):
        return 1.0e-3 * trial
    size = max(1.0e-6, 1.0e-3 * trial) if largest <= 1.0e-15 else math.sqrt(0.01 / largest)
    return min(100.0 * trial, size, state.h_max, abs(state.t_end - state.t))
