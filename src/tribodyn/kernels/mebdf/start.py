"""The first step: f at the start, and at a trial point if the step must be estimated."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mebdf.control import norm, set_weights
from tribodyn.kernels.mebdf.phases import BEGIN, FAILED, FIRST_F, NEED_F, NOT_FINITE, SECOND_F, STEP
from tribodyn.kernels.mebdf.state import (
    BAD,
    DELTA,
    DIRECTION,
    F_1,
    F_2,
    H_MAX,
    HISTORY,
    N_F,
    PHASE,
    REASON,
    ROW_WEIGHT,
    T_BAD,
    T_END,
    T_EVAL,
    WEIGHT,
    F,
    H,
    T,
    Y,
)

SHORTEST: Final = 16.0 * float(np.finfo(np.float64).eps)
"""Shortest first step relative to the time: 16 or more spacings between numbers."""


@kernel
def start(
    real: FloatArray,
    count: NDArray[np.int64],
    rows: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Go through the phases before the first step; return what is needed, 0 when it can begin."""
    if count[PHASE] == BEGIN:
        set_weights(real, rows, mass, places)
        return _ask(real, count, rows, 0.0, FIRST_F)
    if count[PHASE] == FIRST_F:
        if remember_not_finite(real, count, rows):
            count[REASON] = NOT_FINITE
            return FAILED
        first = F_2 if places.size > 0 else F_1
        for i in range(rows.shape[1]):
            rows[first, i] = rows[F, i]
        if real[H] == 0.0:
            real[H] = _trial_step(real, rows)
            return _ask(real, count, rows, real[DIRECTION] * real[H], SECOND_F)
    else:
        real[H] = _first_step(real, rows, places)
    real[H] = max(real[H], _least(real)) * real[DIRECTION]
    for i in range(rows.shape[1]):
        rows[HISTORY + 1, i] = real[H] * rows[F_1, i]
    count[PHASE] = STEP
    return 0


@kernel
def _ask(real: FloatArray, count: NDArray[np.int64], rows: FloatArray, h: float, phase: int) -> int:
    """Ask for f a distance ``h`` along the first slope."""
    for i in range(rows.shape[1]):
        rows[Y, i] = rows[HISTORY, i]
        if h != 0.0:
            rows[Y, i] += h * rows[F_1, i]
    real[T_EVAL] = real[T] + h
    count[PHASE] = phase
    count[N_F] += 1
    return NEED_F


@kernel
def remember_not_finite(real: FloatArray, count: NDArray[np.int64], rows: FloatArray) -> bool:
    """Remember where f is not finite; tell whether there was such a place."""
    for i in range(rows.shape[1]):
        if not math.isfinite(rows[F, i]):
            count[BAD] = i
            real[T_BAD] = real[T_EVAL]
            return True
    return False


@kernel
def _trial_step(real: FloatArray, rows: FloatArray) -> float:
    """Return a step over which the solution changes by about a hundredth of itself."""
    value, slope = norm(rows, HISTORY, WEIGHT), norm(rows, F_1, WEIGHT)
    size = 1.0e-6 if value < 1.0e-5 or slope < 1.0e-5 else 0.01 * value / slope
    return max(min(size, real[H_MAX], abs(real[T_END] - real[T])), _least(real))


@kernel
def _least(real: FloatArray) -> float:
    """Return the shortest first step: the times of its stages must differ."""
    return min(SHORTEST * abs(real[T]), real[H_MAX], abs(real[T_END] - real[T]))


@kernel
def _first_step(real: FloatArray, rows: FloatArray, places: NDArray[np.int64]) -> float:
    """Return the size of the first step from two slopes: Hairer, Nørsett and Wanner, II.4, for order one."""
    trial = real[H]
    slope = norm(rows, F_1, WEIGHT)
    first, weight = (F_2, ROW_WEIGHT) if places.size > 0 else (F_1, WEIGHT)
    for i in range(rows.shape[1]):
        rows[DELTA, i] = (rows[F, i] - rows[first, i]) / trial
    largest = max(slope, norm(rows, DELTA, weight))
    if not math.isfinite(largest):
        return 1.0e-3 * trial
    size = max(1.0e-6, 1.0e-3 * trial) if largest <= 1.0e-15 else math.sqrt(0.01 / largest)
    return min(100.0 * trial, size, real[H_MAX], abs(real[T_END] - real[T]))
