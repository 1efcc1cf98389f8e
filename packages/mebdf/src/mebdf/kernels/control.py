"""Choice of the first step, and of order and step: error tests, growth, and the way back from failures."""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.coefficients import SCALARS
from mebdf.kernels.elementary import power
from mebdf.kernels.history import rescale
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.matrix import weigh
from mebdf.kernels.state import Numbers

SMALLEST_SCALE = 1.0e-300  #: Least scale, for a tolerance of zero where the solution is zero too.
CAUTION = 1  #: Steps that must prove their stages after Newton's iteration has failed.
MOST_CAUTION = 7  #: Most of them when it fails again meanwhile.
LEAST_STEP = 10.0 * float(np.finfo(np.float64).eps)  #: Smallest step relative to the time.
#: Relative change of a step by the rounding of the time above which the step itself is rounded.
ROUNDED = 1.0e-8
VAIN = 4  #: Trouble by a failure of Newton's iteration with a new Jacobian; a step takes one away.
#: Trouble in which a stage looks between two values. More there is only after a stage has ended there.
TROUBLE = 3 * VAIN


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
    return at.ERROR_WEIGHT if places.size > 0 else at.WEIGHT


@inlined
def error_of(state: Numbers, rows: FloatArray, row: int, weight: int) -> float:
    """Return the distance of a row from the extrapolation as an error in units of the tolerance."""
    total = 0.0
    for i in range(rows.shape[1]):
        total += ((rows[row, i] - rows[at.PREDICTED, i]) * rows[weight, i]) ** 2
    return SCALARS[state.k, 3] * math.sqrt(total / rows.shape[1])


@inlined
def largest_error(state: Numbers) -> float:
    """Return the largest distance with which the present stage 1 or 2 leads to the next one."""
    return (
        1.0 if state.stage == 1 else state.settings.larger_change * max(state.error, state.settings.no_change)
    )


@inlined
def set_weights(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> None:
    """Make the weights those of the newest value."""
    for i in range(rows.shape[1]):
        scale = state.settings.tight * (rows[at.ATOL, i] + rows[at.RTOL, i] * abs(rows[at.HISTORY, i]))
        rows[at.WEIGHT, i] = 1.0 / max(scale, SMALLEST_SCALE)
    if places.size > 0:
        weigh(mass, places, rows, state.h)


@kernel
def change_step(state: Numbers, rows: FloatArray, factor: float) -> None:
    """Multiply the step by ``factor`` and make the history fit it."""
    rescale(rows, state.k, factor, 0.0)
    state.h *= factor
    state.equal_steps = 0
    state.carried = 0


@inlined
def _not_too_short(state: Numbers, factor: float) -> float:
    """Return a factor for the step that leads to the shortest one before it leads below it."""
    least = 1.1 * LEAST_STEP * abs(state.t)  # rounding may take a twentieth of it
    return max(factor, min(least / abs(state.h), 1.0))


@inlined
def limit_step(state: Numbers, rows: FloatArray) -> None:
    """Keep the step below its maximum; where nothing may be evaluated beyond the end, end there.

    Late in time the step is a multiple of the spacing of times. Otherwise equal steps, rounded equally, would
    add up to another time than the solution has reached.
    """
    rounded = (state.t + state.h) - state.t
    if rounded != 0.0 and abs(rounded / state.h - 1.0) > ROUNDED:
        change_step(state, rows, rounded / state.h)
    left = abs(state.t_end - state.t)
    h, largest = abs(state.h), state.h_max
    state.last = 0
    if state.inside == 1:
        largest = min(largest, left)
        if h < left * (1.0 - 1.0e-9) and 2.0 * h > left:
            # Two equal last steps rather than a long one and a sliver.
            largest = min(largest, 0.5 * left)
    if h > largest:
        change_step(state, rows, largest / h)
    if state.inside == 1 and 2.0 * abs(state.h) > left * (1.0 + 1.0e-9):
        state.last = 1


@kernel
def blame(state: Numbers, rows: FloatArray, row: int, weight: int) -> None:
    """Remember the component that contributes most to the norm of a row."""
    state.cause = phases.NEWTON if row == at.DELTA else phases.ERROR_TEST
    worst = -1.0
    for i in range(rows.shape[1]):
        size = abs(rows[row, i] * rows[weight, i])
        if size > worst:
            worst = size
            state.worst = i


@kernel
def reject(state: Numbers, rows: FloatArray, factor: float, row: int, weight: int) -> None:
    """Go back to the start of the step and try a smaller one; the largest entry of ``row`` is to blame."""
    blame(state, rows, row, weight)
    state.rejected += 1
    state.failures += 1
    if state.failures >= 3 and state.k > 1:
        # The history is of no use: begin again at the lowest order from the last slope.
        state.k = 1
        for m in range(2, at.N_DIFFERENCES):
            for i in range(rows.shape[1]):
                rows[at.HISTORY + m, i] = 0.0
    if abs(state.h) > 1.5 * LEAST_STEP * abs(state.t):
        factor = _not_too_short(state, factor)
    change_step(state, rows, factor)
    state.phase = phases.STEP


@kernel
def newton_failed(state: Numbers, rows: FloatArray, massive: bool) -> None:
    """Try again with a new Jacobian, or with a shorter step where it was new already.

    However short the step, the values of algebraic equations may lie behind a kink. So with a mass matrix the
    Jacobian is by turns that of the newest value and that of the predicted one.
    """
    if state.fresh == 0:
        state.factored = 0.0
        state.carried = 0
        state.phase = phases.STEP
    else:
        state.wary = min(2 * state.wary + CAUTION, MOST_CAUTION)
        state.vain += 1
        state.trouble = max(state.trouble, min(state.trouble + VAIN, TROUBLE))
        reject(state, rows, state.settings.failed_newton, at.DELTA, at.WEIGHT)
        if not massive:
            return
        state.ahead = 1 - state.ahead
        state.fresh = 0
    state.jacobian_age = int(state.settings.old_jacobian) + 1


@kernel
def growth(rows: FloatArray, weight: int, k: int, safety: float) -> float:
    """Return by how much the step could grow with ``k`` back values."""
    error = SCALARS[k, 3] * norm(rows, at.HISTORY + k + 1, weight)
    return 1.0 / (safety * power(error, 1.0 / (k + 1)) + 1.0e-6)


@kernel
def choose(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> None:
    """Choose order and step for the next step, once enough equal steps have been taken."""
    k = state.k
    settled = state.equal_steps >= k + state.settings.wait
    if state.fixed == 1 or not (settled or state.error > state.settings.early):
        return
    set_weights(state, rows, mass, places)
    weight = error_weight(places)
    best, factor = k, growth(rows, weight, k, state.settings.safety)
    if k > 1:
        lower = growth(rows, weight, k - 1, state.settings.safety_lower)
        if lower > factor:
            best, factor = k - 1, lower
    if settled and k < state.largest_k:
        higher = growth(rows, weight, k + 1, state.settings.safety_higher)
        if higher > factor:
            best, factor = k + 1, higher
    if settled and factor < state.settings.least_growth:
        # Not worth a new matrix; look again after as many steps.
        state.equal_steps = 1
        return
    if not settled and factor >= 1.0:
        return
    state.k = best
    largest = state.settings.largest_growth
    if k == 1 and state.trouble <= TROUBLE:
        # Nothing higher than ∇² is rescaled: it is magnified less than ∇⁴ by the usual limit. What rests on a
        # jump shows no error: a long step would not see that it leaves it.
        largest *= largest
    change_step(state, rows, _not_too_short(state, min(factor, largest)))


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
