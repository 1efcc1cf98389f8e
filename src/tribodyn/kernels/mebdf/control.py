"""Which order and which step next: error tests, growth, and the way back from failures."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.mebdf.coefficients import SCALARS
from tribodyn.kernels.mebdf.history import rescale
from tribodyn.kernels.mebdf.mass import weigh
from tribodyn.kernels.mebdf.phases import ERROR_TEST, NEWTON, STEP
from tribodyn.kernels.mebdf.state import (
    AHEAD,
    ATOL,
    CARRIED,
    CAUSE,
    DELTA,
    EARLY,
    EQUAL_STEPS,
    ERROR,
    ERROR_WEIGHT,
    FACTORED,
    FAILURES,
    FIXED,
    FRESH,
    H_MAX,
    HISTORY,
    INSIDE,
    JACOBIAN_AGE,
    LARGEST_GROWTH,
    LARGEST_K,
    LAST,
    LEAST_GROWTH,
    N_DIFFERENCES,
    OLD_JACOBIAN,
    PHASE,
    REJECTED,
    RTOL,
    SAFETY,
    SAFETY_HIGHER,
    SAFETY_LOWER,
    T_END,
    TIGHT,
    VAIN,
    WAIT,
    WARY,
    WEIGHT,
    WORST,
    H,
    K,
    T,
)

SMALLEST_SCALE = 1.0e-300
"""What stands for a tolerance of zero where the solution is zero too."""
CAUTION = 1
"""Steps that must prove their stages after Newton's iteration has failed."""
MOST_CAUTION = 7
"""Most of them when it fails again meanwhile."""
FAILED_NEWTON = 0.25
"""What the step is multiplied by when Newton's iteration fails although the Jacobian is new."""


@inlined
def norm(rows: FloatArray, row: int, weight: int) -> float:
    """Return the root mean square of a row, weighted by another one."""
    total = 0.0
    for i in range(rows.shape[1]):
        total += (rows[row, i] * rows[weight, i]) ** 2
    return math.sqrt(total / rows.shape[1])


@inlined
def error_weight(places: NDArray[np.int64]) -> int:
    """Return the row that weighs errors."""
    return ERROR_WEIGHT if places.size > 0 else WEIGHT


@inlined
def set_weights(real: FloatArray, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> None:
    """Make the weights those of the newest value."""
    for i in range(rows.shape[1]):
        scale = real[TIGHT] * (rows[ATOL, i] + rows[RTOL, i] * abs(rows[HISTORY, i]))
        rows[WEIGHT, i] = 1.0 / max(scale, SMALLEST_SCALE)
    if places.size > 0:
        weigh(mass, places, rows, real[H])


@kernel
def change_step(real: FloatArray, count: NDArray[np.int64], rows: FloatArray, factor: float) -> None:
    """Multiply the step by ``factor`` and make the history fit it."""
    rescale(rows, count[K], factor, 0.0)
    real[H] *= factor
    count[EQUAL_STEPS] = 0
    count[CARRIED] = 0


@inlined
def limit_step(real: FloatArray, count: NDArray[np.int64], rows: FloatArray) -> None:
    """Keep the step below its maximum; where nothing may be evaluated beyond the end, end there."""
    left = abs(real[T_END] - real[T])
    h, largest = abs(real[H]), real[H_MAX]
    count[LAST] = 0
    if count[INSIDE] == 1:
        largest = min(largest, left)
        if h < left * (1.0 - 1.0e-9) and 2.0 * h > left:
            # Two equal last steps rather than a long one and a sliver.
            largest = min(largest, 0.5 * left)
    if h > largest:
        change_step(real, count, rows, largest / h)
    if count[INSIDE] == 1 and 2.0 * abs(real[H]) > left * (1.0 + 1.0e-9):
        count[LAST] = 1


@kernel
def blame(count: NDArray[np.int64], rows: FloatArray, row: int, weight: int) -> None:
    """Remember the component that contributes most to the norm of a row."""
    count[CAUSE] = NEWTON if row == DELTA else ERROR_TEST
    worst = -1.0
    for i in range(rows.shape[1]):
        size = abs(rows[row, i] * rows[weight, i])
        if size > worst:
            worst = size
            count[WORST] = i


@kernel
def reject(
    real: FloatArray, count: NDArray[np.int64], rows: FloatArray, factor: float, row: int, weight: int
) -> None:
    """Go back to the start of the step and try a smaller one; the largest entry of ``row`` is to blame."""
    blame(count, rows, row, weight)
    count[REJECTED] += 1
    count[FAILURES] += 1
    if count[FAILURES] >= 3 and count[K] > 1:
        # The history is of no use: begin again at the lowest order from the last slope.
        count[K] = 1
        for m in range(2, N_DIFFERENCES):
            for i in range(rows.shape[1]):
                rows[HISTORY + m, i] = 0.0
    change_step(real, count, rows, factor)
    count[PHASE] = STEP


@kernel
def newton_failed(real: FloatArray, count: NDArray[np.int64], rows: FloatArray, massive: bool) -> None:
    """Try again with a new Jacobian, or with a shorter step where it was new already.

    However short the step, the values of algebraic equations may lie behind a kink. So with a mass matrix the
    Jacobian is by turns that of the newest value and that of the predicted one.
    """
    if count[FRESH] == 0:
        real[FACTORED] = 0.0
        count[CARRIED] = 0
        count[PHASE] = STEP
    else:
        count[WARY] = min(2 * count[WARY] + CAUTION, MOST_CAUTION)
        count[VAIN] += 1
        reject(real, count, rows, FAILED_NEWTON, DELTA, WEIGHT)
        if not massive:
            return
        count[AHEAD] = 1 - count[AHEAD]
        count[FRESH] = 0
    count[JACOBIAN_AGE] = int(real[OLD_JACOBIAN]) + 1


@kernel
def growth(rows: FloatArray, weight: int, k: int, safety: float) -> float:
    """Return by how much the step could grow with ``k`` back values."""
    error = SCALARS[k, 3] * norm(rows, HISTORY + k + 1, weight)
    return 1.0 / (safety * error ** (1.0 / (k + 1)) + 1.0e-6)


@kernel
def choose(
    real: FloatArray,
    count: NDArray[np.int64],
    rows: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
) -> None:
    """Choose order and step for the next step, once enough equal steps have been taken."""
    k = count[K]
    settled = count[EQUAL_STEPS] >= k + real[WAIT]
    if count[FIXED] == 1 or not (settled or real[ERROR] > real[EARLY]):
        return
    set_weights(real, rows, mass, places)
    weight = error_weight(places)
    best, factor = k, growth(rows, weight, k, real[SAFETY])
    if k > 1:
        lower = growth(rows, weight, k - 1, real[SAFETY_LOWER])
        if lower > factor:
            best, factor = k - 1, lower
    if settled and k < count[LARGEST_K]:
        higher = growth(rows, weight, k + 1, real[SAFETY_HIGHER])
        if higher > factor:
            best, factor = k + 1, higher
    if settled and factor < real[LEAST_GROWTH]:
        # Not worth a new matrix; look again after as many steps.
        count[EQUAL_STEPS] = 1
        return
    if not settled and factor >= 1.0:
        return
    count[K] = best
    largest = real[LARGEST_GROWTH]
    if k == 1:
        # Nothing higher than ∇² is rescaled: it is magnified less than ∇⁴ by the usual limit.
        largest *= largest
    change_step(real, count, rows, min(factor, largest))
