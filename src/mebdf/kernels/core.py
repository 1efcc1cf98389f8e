"""The MEBDF as a machine that asks its caller for evaluations.

``resume`` runs until it needs the right-hand side or the Jacobian, or until a step is accepted, and
returns which. The caller evaluates at ``real[T_EVAL]`` and ``rows[Y]``, fills ``rows[F]`` or
``matrices[JACOBIAN]`` and calls again. So one source serves compiled problems, where the loop around it
never leaves compiled code, and Python callables.

The iteration matrix is dense, or the caller's: with ``count[OUTSIDE]`` the machine holds no matrix and asks

- NEED_JACOBIAN: evaluate the Jacobian; ``count[FINITE]`` = 0 where it is not and the last one stays;
- NEED_FACTORS: prepare solutions with I − ``real[SCALED]`` J; fill ``count[SIGN]`` with the sign of the
  determinant, 0 where it vanishes, and ``real[TRACE]`` with the trace of J. If ``count[BACK]`` is 1, J is
  from now on the one before the newest; if it is 2 and there is no mass matrix, J is zero;
- NEED_SOLUTION: fill ``rows[DELTA]`` with the solution for ``rows[RESIDUAL]``;
- NEED_MAGNITUDE: fill ``rows[MAGNITUDE]``. Few steps need it.

One step, Cash's three stages on one iteration matrix I − hβJ:

1. BDF with k back values at t_{n+1} gives ȳ1;
2. the same BDF on {ȳ1, y_n, …} at t_{n+2} gives ȳ2;
3. the extended formula at t_{n+1}, with f̄1 and f̄2 known and hβ f(y) implicit, gives y_{n+1}.

Cash (1983), Comput. Math. Appl. 9, 645; Cash & Considine (1992), ACM TOMS 18, 142; Hairer & Wanner,
Solving Ordinary Differential Equations II, V.3.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
from mebdf.kernels.coefficients import SCALARS
from mebdf.kernels.control import LEAST_STEP, choose, limit_step, set_weights
from mebdf.kernels.history import push, rescale
from mebdf.kernels.jit import entry, inlined
from mebdf.kernels.newton import iterate, start_stage
from mebdf.kernels.phases import (
    ACCEPT,
    AFTER,
    CONCLUDE,
    CORRECT,
    FACTORISE,
    FACTORISED,
    FAILED,
    ITERATE,
    LINEARISED,
    NEED_JACOBIAN,
    NO_PROGRESS,
    START_STAGE,
    STEP,
    STEP_ACCEPTED,
    STEP_TOO_SMALL,
)
from mebdf.kernels.renewal import begin_stages, renew_matrix, take_over
from mebdf.kernels.start import start

MOST_VAIN: Final = 100
"""Failures of Newton's iteration with a new Jacobian after which the progress is looked at."""
LEAST_PROGRESS: Final = 1.0e-6
"""Share of the remaining time that must have been covered meanwhile: else some 1e8 failures would follow."""
ROUNDING: Final = 1.0e-10
"""Distance from the end, in steps, that is none."""


@entry
def resume(
    real: FloatArray,
    count: NDArray[np.int64],
    rows: FloatArray,
    matrices: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Go on until something is needed; return what: NEED_F …, STEP_ACCEPTED or FAILED.

    After STEP_ACCEPTED the solution at ``real[T]`` is ``rows[HISTORY]``, and the polynomial of degree
    ``count[K_LAST]`` + 1 through the history is the dense output between ``real[T_OLD]`` and ``real[T]``,
    until the next call.
    """
    request = 0
    while request == 0:
        phase = count[at.PHASE]
        if phase in (ITERATE, CORRECT, CONCLUDE):
            request = iterate(real, count, rows, matrices, mass, places, phase)
        elif phase == START_STAGE:
            request = start_stage(real, count, rows, mass, places)
        elif phase == STEP:
            request = _begin_step(real, count, rows, mass, places)
        elif phase == FACTORISE:
            request = renew_matrix(real, count, matrices, mass, places)
        elif phase == FACTORISED:
            begin_stages(real, count, rows, matrices, places.size > 0)
        elif phase == LINEARISED:
            request = take_over(count, real, rows, matrices)
        elif phase == ACCEPT:
            _accept(real, count, rows, places)
            request = STEP_ACCEPTED
        elif phase == AFTER:
            count[at.PHASE] = STEP
            choose(real, count, rows, mass, places)
        else:
            request = start(real, count, rows, mass, places)
    return request


@inlined
def _begin_step(
    real: FloatArray,
    count: NDArray[np.int64],
    rows: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Limit the step, and renew the iteration matrix where the step or its age demands it."""
    limit_step(real, count, rows)
    h = real[at.H]
    # A whole integration that is as short as that is one step.
    if not abs(h) > LEAST_STEP * abs(real[at.T]) and (count[at.LAST] == 0 or h == 0.0):
        count[at.REASON] = STEP_TOO_SMALL
        return FAILED
    if count[at.VAIN] >= MOST_VAIN and _stands_still(real, count):
        count[at.REASON] = NO_PROGRESS
        return FAILED
    set_weights(real, rows, mass, places)
    scaled = h * SCALARS[count[at.K], 0]
    real[at.SCALED] = scaled
    if count[at.RATE_AGE] > real[at.UNSURE]:
        real[at.RATE] = 1.0
    if (
        real[at.FACTORED] != 0.0
        and abs(scaled / real[at.FACTORED] - 1.0) <= real[at.SAME_MATRIX]
        and count[at.MATRIX_AGE] < real[at.RENEW]
    ):
        real[at.RELAXATION] = 2.0 / (1.0 + scaled / real[at.FACTORED])
        count[at.STAGE] = 1
        count[at.PHASE] = START_STAGE
        return 0
    count[at.PHASE] = FACTORISE
    # Where every stage took one iteration, RATE is 1 for unknown: a Jacobian that costs little is renewed.
    slow = real[at.RATE] > real[at.SLOW] and (real[at.RATE] != 1.0 or count[at.DIFFERENCED] == 0)
    old = count[at.JACOBIAN_AGE] >= real[at.OLD_JACOBIAN] or slow or count[at.N_J] == 0
    if not old or count[at.FRESH] == 1:
        return 0
    # Its value ahead is that of the polynomial through the history: the sum of its differences.
    ahead = count[at.AHEAD] == 1
    for i in range(rows.shape[1]):
        rows[at.Y, i] = rows[at.HISTORY, i]
        for m in range(1, count[at.K] + 1 if ahead else 0):
            rows[at.Y, i] += rows[at.HISTORY + m, i]
    real[at.T_EVAL] = real[at.T] + h if ahead else real[at.T]
    count[at.PHASE] = LINEARISED
    count[at.N_J] += 1
    count[at.JACOBIAN_AGE] = 0
    count[at.FRESH] = 1
    return NEED_JACOBIAN


@inlined
def _stands_still(real: FloatArray, count: NDArray[np.int64]) -> bool:
    """Tell whether the last failures have brought next to no progress, and count anew."""
    progress, left = abs(real[at.T] - real[at.T_MARK]), abs(real[at.T_END] - real[at.T])
    count[at.VAIN] = 0
    real[at.T_MARK] = real[at.T]
    return progress < LEAST_PROGRESS * left


@inlined
def _accept(real: FloatArray, count: NDArray[np.int64], rows: FloatArray, places: NDArray[np.int64]) -> None:
    """Make y_{n+1} the newest value."""
    push(rows, at.Y, count[at.K] + 3, at.HISTORY)
    real[at.T_OLD] = real[at.T]
    real[at.T] += real[at.H]
    real[at.H_LAST] = real[at.H]
    beyond = real[at.T] - real[at.T_END]
    # What no step could cross is no distance either.
    if abs(beyond) <= max(ROUNDING * abs(real[at.H]), LEAST_STEP * abs(real[at.T])):
        real[at.T] = real[at.T_END]
    elif beyond * real[at.H] > 0.0:
        # The dense output of this step is the solution at the end.
        share = 1.0 - beyond / real[at.H]
        rescale(rows, count[at.K] + 1, share, share - 1.0)
        real[at.H_LAST] *= share
        real[at.T] = real[at.T_END]
    count[at.K_LAST] = count[at.K]
    count[at.STEPS] += 1
    count[at.EQUAL_STEPS] += 1
    count[at.JACOBIAN_AGE] += 1 - count[at.DIFFERENCED]
    count[at.MATRIX_AGE] += 1
    count[at.RATE_AGE] += 1
    count[at.FRESH] = 0
    count[at.AHEAD] = 0
    # Algebraic variables do not heed the history: its noise can make each new step fail, however short.
    if places.size == 0 or count[at.EQUAL_STEPS] > 1:
        count[at.FAILURES] = 0
    count[at.WARY] = max(count[at.WARY] - 1, 0)
    count[at.BAD] = -1
    count[at.WORST] = -1
    count[at.CARRIED] = count[at.STAGE] > 3
    count[at.PHASE] = AFTER
