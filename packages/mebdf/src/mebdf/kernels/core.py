"""The MEBDF as a machine that asks its caller for evaluations.

``resume`` runs until it needs the right-hand side or the Jacobian, or until a step is accepted, and
returns which. The caller evaluates at ``state.t_eval`` and ``rows[Y]``, fills ``rows[F]`` or
``matrices[JACOBIAN]`` and calls again. So one source serves compiled problems, where the loop around it
never leaves compiled code, and Python callables.

The iteration matrix is dense, or the caller's: with ``state.outside`` the machine holds no matrix and asks

- NEED_JACOBIAN: evaluate the Jacobian; ``state.finite`` = 0 where it is not and the last one stays;
- NEED_FACTORS: prepare solutions with I − ``state.scaled`` J; fill ``state.sign`` with the sign of the
  determinant, 0 where it vanishes, and ``state.trace_of_j`` with the trace of J. If ``state.back`` is 1, J is
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

from typing import Annotated, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.coefficients import SCALARS
from mebdf.kernels.control import LEAST_STEP, choose, limit_step, set_weights, start
from mebdf.kernels.history import push, rescale
from mebdf.kernels.jit import entry, inlined
from mebdf.kernels.newton import iterate, start_stage
from mebdf.kernels.renewal import begin_stages, renew_matrix, take_over
from mebdf.kernels.state import NUMBERS, Numbers

#: Failures of Newton's iteration with a new Jacobian after which the progress is looked at.
MOST_VAIN: Final = 100
#: Share of the time, past or remaining, that must have been covered meanwhile: else some 1e8 would follow.
LEAST_PROGRESS: Final = 1.0e-6
MOST_CALLS: Final = 8000  #: Evaluations, with such a failure among them, after which it is looked at, too.
ROUNDING: Final = 1.0e-10  #: Distance from the end, in steps, that is none.


@entry
def resume(
    numbers: Annotated[NDArray[np.void], NUMBERS, 1],
    rows: FloatMatrix,
    matrices: FloatCube,
    pivots: NDArray[np.int64],
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Go on until something is needed; return what: NEED_F …, STEP_ACCEPTED or FAILED.

    After STEP_ACCEPTED the solution at ``state.t`` is ``rows[HISTORY]``, and the polynomial of degree
    ``state.k_last`` + 1 through the history is the dense output between ``state.t_old`` and ``state.t``,
    until the next call.
    """
    state, request = numbers[0], 0
    while request == 0:
        phase = state.phase
        if phase in (phases.ITERATE, phases.CORRECT, phases.CONCLUDE):
            request = iterate(state, rows, matrices, pivots, mass, places, phase)
        elif phase == phases.START_STAGE:
            request = start_stage(state, rows, mass, places)
        elif phase == phases.STEP:
            request = _begin_step(state, rows, mass, places)
        elif phase == phases.FACTORISE:
            request = renew_matrix(state, matrices, pivots, mass, places)
        elif phase == phases.FACTORISED:
            begin_stages(state, rows, matrices, places.size > 0)
        elif phase == phases.LINEARISED:
            request = take_over(state, rows, matrices)
        elif phase == phases.ACCEPT:
            _accept(state, rows, places)
            request = phases.STEP_ACCEPTED
        elif phase == phases.AFTER:
            state.phase = phases.STEP
            choose(state, rows, mass, places)
        else:
            request = start(state, rows, mass, places)
    return request


@inlined
def _begin_step(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> int:
    """Limit the step, and renew the iteration matrix where the step or its age demands it."""
    limit_step(state, rows)
    h = state.h
    # A whole integration that is as short as that is one step.
    if not abs(h) > LEAST_STEP * abs(state.t) and (state.last == 0 or h == 0.0):
        state.reason = phases.STEP_TOO_SMALL
        return phases.FAILED
    calls = state.n_f - state.f_mark
    if (state.vain >= MOST_VAIN or (state.vain > 0 and calls >= MOST_CALLS)) and _stands_still(state):
        state.reason = phases.NO_PROGRESS
        return phases.FAILED
    set_weights(state, rows, mass, places)
    scaled = h * SCALARS[state.k, 0]
    state.scaled = scaled
    if state.rate_age > state.settings.unsure:
        state.rate = 1.0
    if (
        state.factored != 0.0
        and abs(scaled / state.factored - 1.0) <= state.settings.same_matrix
        and state.matrix_age < state.settings.renew
    ):
        state.relaxation = 2.0 / (1.0 + scaled / state.factored)
        state.stage = 1
        state.phase = phases.START_STAGE
        return 0
    state.phase = phases.FACTORISE
    # Where every stage took one iteration, RATE is 1 for unknown: a Jacobian that costs little is renewed.
    slow = state.rate > state.settings.slow and (state.rate != 1.0 or state.differenced == 0)
    old = state.jacobian_age >= state.settings.old_jacobian or slow or state.n_j == 0
    if not old or state.fresh == 1:
        return 0
    # Its value ahead is that of the polynomial through the history: the sum of its differences.
    ahead = state.ahead == 1
    for i in range(rows.shape[1]):
        rows[at.Y, i] = rows[at.HISTORY, i]
        for m in range(1, state.k + 1 if ahead else 0):
            rows[at.Y, i] += rows[at.HISTORY + m, i]
    state.t_eval = state.t + h if ahead else state.t
    state.phase = phases.LINEARISED
    state.n_j += 1
    state.jacobian_age = 0
    state.fresh = 1
    return phases.NEED_JACOBIAN


@inlined
def _stands_still(state: Numbers) -> bool:
    """Tell whether there was next to no progress since the last look, and count anew."""
    progress, left = abs(state.t - state.t_mark), abs(state.t_end - state.t)
    state.vain = 0
    state.t_mark, state.f_mark = state.t, state.n_f
    return progress < LEAST_PROGRESS * min(left, max(abs(state.t), progress))


@inlined
def _accept(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> None:
    """Make y_{n+1} the newest value."""
    push(rows, at.Y, state.k + 3, at.HISTORY)
    state.t_old = state.t
    state.t += state.h
    state.h_last = state.h
    beyond = state.t - state.t_end
    # What no step could cross is no distance either.
    if abs(beyond) <= max(ROUNDING * abs(state.h), LEAST_STEP * abs(state.t)):
        state.t = state.t_end
    elif beyond * state.h > 0.0:
        # The dense output of this step is the solution at the end.
        share = 1.0 - beyond / state.h
        rescale(rows, state.k + 1, share, share - 1.0)
        state.h_last *= share
        state.t = state.t_end
    state.k_last = state.k
    state.steps += 1
    state.equal_steps += 1
    state.jacobian_age += 1 - state.differenced
    state.matrix_age += 1
    state.rate_age += 1
    state.fresh = 0
    state.ahead = 0
    # Algebraic variables do not heed the history: its noise can make each new step fail, however short.
    if places.size == 0 or state.equal_steps > 1:
        state.failures = 0
    state.wary = max(state.wary - 1, 0)
    if state.trouble == 1 and state.differenced == 1:
        # The Jacobian may be one of differences across a jump that now lies behind.
        state.factored = 0.0
        state.jacobian_age = int(state.settings.old_jacobian) + 1
    state.trouble = max(state.trouble - 1, 0)
    state.bad = -1
    state.worst = -1
    state.carried = state.stage > 3
    state.phase = phases.AFTER
