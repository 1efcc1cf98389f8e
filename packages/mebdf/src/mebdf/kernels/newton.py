"""Newton's iteration of the three stages, all on one iteration matrix.

One file because the phases of one iteration read and leave the same state, in the order in which they stand.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.acceptance import (
    FALSE,
    IN_DOUBT,
    MIXED,
    OPEN,
    PROVED,
    SOLVED,
    TOO_FAR,
    WATCHED,
    begin_near,
    judge,
    judge_beside_rounding,
    judge_mixture,
    keep_residual,
    look_back,
)
from mebdf.kernels.coefficients import BDF_HISTORY, EXTENDED_HISTORY, SCALARS
from mebdf.kernels.control import (
    CAUTION,
    TROUBLE,
    error_of,
    error_weight,
    largest_error,
    newton_failed,
    norm,
    reject,
    remember_not_finite,
)
from mebdf.kernels.elementary import power
from mebdf.kernels.history import push
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.matrix import is_algebraic, magnify, multiply, product, solve
from mebdf.kernels.state import Numbers

MAX_ITERATIONS: Final = np.array([0, 4, 4, 5])
DIVERGING: Final = 2.0
DIVERGED: Final = -2  #: A verdict on a stage beside those of :mod:`.acceptance`.
#: Failures in a row after which an error may be that of the algebraic values which the step starts from.
LATE: Final = 5
FORGIVEN: Final = 10.0  #: Most that such values may be wrong, in units of the tolerance.


@inlined
def start_stage(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> int:
    """Fill the known part of the stage, predict, and ask for f where it is not known."""
    stage, h = state.stage, state.h
    _set_constant(state, rows)
    state.iteration = state.evaluated = state.between = state.halvings = 0
    state.overshot = 0.0
    state.phase = phases.ITERATE
    state.t_eval = state.t + (2.0 * h if stage == 2 else h)
    massive = places.size > 0
    # The slope of a stage that lies on a jump is no rate of either side.
    known = state.trouble < WATCHED - 1
    if stage == 3:
        _copy(rows, at.Y_1, at.Y, at.F_1, at.F)
        if massive and state.higher == 0:
            multiply(mass, places, rows, at.F_1, at.F)
        if state.higher == 0 and known:
            return 0
    elif stage == 1 and state.carried == 1:
        _copy(rows, at.Y_2, at.Y, at.F_2, at.F)
        if not massive and known:
            return 0
    else:
        _copy(rows, at.PREDICTED, at.Y, at.F, at.F)
    return _ask(state)


@inlined
def _ask(state: Numbers) -> int:
    """Ask for f at Y."""
    state.n_f += 1
    state.evaluated += 1
    return phases.NEED_F


@inlined
def _copy(rows: FloatArray, y: int, to_y: int, f: int, to_f: int) -> None:
    for i in range(rows.shape[1]):
        rows[to_y, i] = rows[y, i]
        rows[to_f, i] = rows[f, i]


@inlined
def _set_constant(state: Numbers, rows: FloatArray) -> None:
    """Fill the part of the formula of a stage that does not depend on its value, and its extrapolation.

    What stage 3 takes from the history is gathered with stage 1, in one pass.
    """
    k, stage, h = state.k, state.stage, state.h
    if stage == 3:
        slope_1 = h * (SCALARS[k, 1] - SCALARS[k, 0])
        slope_2 = h * SCALARS[k, 2]
        for i in range(rows.shape[1]):
            slopes = slope_1 * rows[at.F_1, i] + slope_2 * rows[at.F_2, i]
            rows[at.CONSTANT, i] = rows[at.CONSTANT_3, i] + slopes
        return
    first = at.STAGE_HISTORY if stage == 2 else at.HISTORY
    of_stage_3 = at.CONSTANT_3 if stage == 1 else at.SCRATCH
    for i in range(rows.shape[1]):
        rows[at.CONSTANT, i] = rows[of_stage_3, i] = rows[at.PREDICTED, i] = rows[first, i]
    # Difference by difference: the compiler then takes several entries at once.
    for m in range(1, k):
        share, share_3 = BDF_HISTORY[k, m], EXTENDED_HISTORY[k, m]
        for i in range(rows.shape[1]):
            difference = rows[first + m, i]
            rows[at.CONSTANT, i] += share * difference
            rows[of_stage_3, i] += share_3 * difference
            rows[at.PREDICTED, i] += difference
    for i in range(rows.shape[1]):
        rows[at.PREDICTED, i] += rows[first + k, i]


@inlined
def iterate(
    state: Numbers,
    rows: FloatArray,
    matrices: FloatArray,
    pivots: NDArray[np.int64],
    mass: FloatArray,
    places: NDArray[np.int64],
    phase: int,
) -> int:
    """One Newton correction with f known at Y; then accept the stage, go on, or give up.

    Where the caller solves it begins in ``phase`` ITERATE, CORRECT or CONCLUDE.
    """
    verdict = IN_DOUBT
    if phase == phases.ITERATE:
        if state.trouble >= TROUBLE:
            keep_residual(rows)
        if places.size == 0:
            _set_residual(state, rows)
        else:
            _set_residual_with_mass(state, rows, mass, places)
        if state.trouble >= TROUBLE and state.iteration > 0:
            if places.size > 0 and state.outside == 0:
                magnify(rows, matrices, mass, places, state.scaled)
            if look_back(state, rows, mass, places):
                return _ask(state)
            if state.between == TOO_FAR:
                finish_stage(state, rows, mass, places)
                return 0
        state.n_solves += 1
        if state.outside == 1:
            state.phase = phases.CORRECT
            return phases.NEED_SOLUTION
        solve(pivots, rows, matrices)
    if phase != phases.CONCLUDE:
        verdict = _correct(state, rows, places)
    if verdict == IN_DOUBT:
        if phase != phases.CONCLUDE and state.outside == 1:
            state.phase = phases.CONCLUDE
            return phases.NEED_MAGNITUDE
        if state.outside == 0:
            magnify(rows, matrices, mass, places, state.scaled)
        verdict = judge_beside_rounding(state, rows, places)
    if verdict == SOLVED:
        finish_stage(state, rows, mass, places)
        return 0
    if verdict in (DIVERGED, FALSE) or state.iteration >= MAX_ITERATIONS[state.stage]:
        if verdict == FALSE:
            state.wary = max(state.wary, CAUTION)
            state.trust, state.reached = 0.0, math.inf
        newton_failed(state, rows, places.size > 0)
        return 0
    state.jacobian_age += state.differenced
    state.phase = phases.ITERATE
    return _ask(state)


@inlined
def _correct(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> int:
    """Add the correction; return whether the stage solves its formula, as far as is known."""
    if state.trouble >= WATCHED - 1 and state.halvings == 0:
        begin_near(state, rows)
    size = _add_correction(state, rows)
    if state.between == MIXED:
        return judge_mixture(state, size)
    if not _converging(state, size):
        if not math.isfinite(size):
            remember_not_finite(state, rows)
        return DIVERGED
    state.iteration += 1
    rate = state.rate
    left = size if rate >= 0.5 else size * rate / (1.0 - rate)
    return judge(state, rows, places) if left <= state.settings.kappa[state.stage - 1] else OPEN


@inlined
def _note_residual(state: Numbers, size: float) -> None:
    """Keep the norm of a residual, and what the last correction has left of the one before."""
    state.left = size / state.unsolved if state.iteration > 0 and size > 0.0 else 1.0
    state.unsolved = size


@inlined
def _set_residual(state: Numbers, rows: FloatArray) -> None:
    """Fill the row RESIDUAL and note its norm."""
    n = rows.shape[1]
    scaled, total = state.scaled, 0.0
    for i in range(n):
        residual = scaled * rows[at.F, i] + rows[at.CONSTANT, i] - rows[at.Y, i]
        rows[at.RESIDUAL, i] = residual
        total += (residual * rows[at.WEIGHT, i]) ** 2
    _note_residual(state, math.sqrt(total / n))


@kernel
def _set_residual_with_mass(
    state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]
) -> None:
    """Fill the row RESIDUAL and note its norm over the equations with derivatives."""
    n = rows.shape[1]
    scaled, total = state.scaled, 0.0
    # What the caller has evaluated of an implicit equation is the whole of it.
    whole = state.implicit == 1 and state.evaluated > 0
    for i in range(n):
        rows[at.SCRATCH, i] = rows[at.CONSTANT, i] - rows[at.Y, i]
    for i in range(n):
        if is_algebraic(places, i):
            residual = rows[at.F, i]
            before = abs(rows[at.RESIDUAL, i])
            if state.iteration > 0 and state.between == 0 and abs(residual) <= PROVED * before:
                # The Jacobian was seen to remove it.
                rows[at.SEEN, i] = max(rows[at.SEEN, i], before)
        else:
            residual = scaled * rows[at.F, i]
            if not whole:
                residual += product(mass, places, rows, at.SCRATCH, i)
        rows[at.RESIDUAL, i] = residual
        total += (residual * rows[at.ROW_WEIGHT, i]) ** 2
    _note_residual(state, math.sqrt(total / n))


@inlined
def _add_correction(state: Numbers, rows: FloatArray) -> float:
    """Add the row DELTA, adapted to the present step, to Y; return its norm."""
    relaxation, squares = state.relaxation, 0.0
    for i in range(rows.shape[1]):
        change = rows[at.DELTA, i] * relaxation
        rows[at.DELTA, i] = change
        rows[at.Y, i] += change
        squares += (change * rows[at.WEIGHT, i]) ** 2
    return math.sqrt(squares / rows.shape[1])


@inlined
def _converging(state: Numbers, size: float) -> bool:
    """Update the convergence rate; return whether there is hope."""
    if not math.isfinite(size):
        return False
    if state.iteration > 0:
        ratio = size / state.last_norm if state.last_norm > 0.0 else 0.0
        if ratio > DIVERGING:
            return False
        state.rate = max(state.settings.forget * state.rate, ratio)
        state.rate_age = 0
    state.last_norm = size
    return True


@inlined
def finish_stage(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> None:
    """Keep a converged stage, test the error after stage 1, accept the step after stage 3."""
    stage, weight = state.stage, error_weight(places)
    state.phase = phases.START_STAGE
    state.stage = stage + 1
    if stage == 1:
        _keep(state, rows, at.Y_1, at.F_1)
        _test_error(state, rows, mass, places)
    elif stage == 2:
        _keep(state, rows, at.Y_2, at.F_2)
        if state.fixed == 0 and not _goes_on(state, rows, weight):
            if places.size > 0 and state.error > state.settings.straight:
                reject(state, rows, 0.5, at.STAGE_HISTORY + state.k + 1, weight)
                return
            _copy(rows, at.Y_1, at.Y, at.F_1, at.F)
            state.phase = phases.ACCEPT
    else:
        for i in range(rows.shape[1]):
            rows[at.SCRATCH, i] = rows[at.Y, i] - rows[at.Y_1, i]
        if state.fixed == 0 and norm(rows, at.SCRATCH, weight) > state.settings.disagreement:
            reject(state, rows, 0.5, at.SCRATCH, weight)
        else:
            state.phase = phases.ACCEPT


@inlined
def _goes_on(state: Numbers, rows: FloatArray, weight: int) -> bool:
    """Tell whether stage 2, which has no error test, goes on as stage 1 did.

    Beside a jump a stage may have a solution on either side. The extended formula would take the difference
    of their slopes for a derivative. The step is then that of stage 1, which has passed its test, or shorter.
    """
    return error_of(state, rows, at.Y_2, weight) <= largest_error(state)


@inlined
def _keep(state: Numbers, rows: FloatArray, y: int, f: int) -> None:
    """Store a stage; its slope follows from the formula without another call."""
    inverse = 1.0 / state.scaled
    for i in range(rows.shape[1]):
        rows[y, i] = rows[at.Y, i]
        rows[f, i] = (rows[at.Y, i] - rows[at.CONSTANT, i]) * inverse


@inlined
def _test_error(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> None:
    """Compare ∇^{k+1} ȳ1 / ((k + 1) H_k), the local error of stage 1, with the tolerance."""
    k, weight = state.k, error_weight(places)
    push(rows, at.Y_1, k + 2, at.STAGE_HISTORY)
    error = SCALARS[k, 3] * norm(rows, at.STAGE_HISTORY + k + 1, weight)
    state.error = error
    if error > 1.0 and state.fixed == 0 and not _is_of_the_start(state, rows, mass, places, error):
        shrink = 1.0 / (state.settings.shrink * power(error, 1.0 / (k + 1)))
        reject(state, rows, min(0.9, max(0.1, shrink)), at.STAGE_HISTORY + k + 1, weight)
    elif state.last == 1:
        state.phase = phases.ACCEPT


@inlined
def _is_of_the_start(
    state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64], error: float
) -> bool:
    """Tell whether an error is that of the algebraic values which the step starts from.

    They may have been left beside their equations by more than a tolerance. No step is so short that it
    would not lead back to them; M y, which has an error of its own, hardly changes in it.
    """
    k = state.k
    if places.size == 0 or state.failures < LATE or k > 1 or error > FORGIVEN:
        return False
    for i in range(rows.shape[1]):
        change = SCALARS[k, 3] * product(mass, places, rows, at.STAGE_HISTORY + k + 1, i)
        if abs(change) * rows[at.ROW_WEIGHT, i] > 1.0:
            return False
    return True
