"""The iteration matrix I − hβJ, and which Jacobian it is made of.

A component with an eigenvalue λ that grows faster than the step has 1 − hβλ < 0. Its correction points
against its residual: Newton's iteration moves away from the right side of a jump. No solution is followed by
such steps. Either the Jacobian is wrong, most often differenced across an upward jump, or the step is too
long.

Two numbers show this for any basis and scales of the variables. The determinant is negative where the number
of such components is odd. The trace over the number of equations, the mean rate of growth, exceeds 1/(hβ)
where several components jump at once. With a mass matrix M the determinant of M − hβJ has the sign that it
has for short steps, as long as M and the algebraic equations stay regular. The trace is not used there.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.control import newton_failed
from mebdf.kernels.jit import copy, inlined, kernel
from mebdf.kernels.matrix import factorise
from mebdf.kernels.state import Numbers


@kernel
def take_over(state: Numbers, rows: FloatArray, matrices: FloatArray) -> int:
    """Keep a new Jacobian if it is finite, and the one before it."""
    state.phase = phases.FACTORISE
    state.trust, state.reached = 0.0, math.inf
    for i in range(rows.shape[1]):
        rows[at.SEEN, i] = 0.0
    if state.outside == 0:
        n, total = matrices.shape[1], 0.0
        for i in range(n):
            for j in range(n):
                total += matrices[at.JACOBIAN, i, j]
        state.finite = math.isfinite(total)
        for i in range(n if state.finite == 1 else 0):
            if state.back == 0:
                copy(matrices[at.LAST_JACOBIAN, i], matrices[at.PREVIOUS_JACOBIAN, i])
            copy(matrices[at.JACOBIAN, i], matrices[at.LAST_JACOBIAN, i])
    state.back = 0
    if state.finite == 0 and state.n_j == 1:
        state.reason = phases.JACOBIAN_NOT_FINITE
        return phases.FAILED
    return 0


@kernel
def renew_matrix(
    state: Numbers,
    matrices: FloatArray,
    pivots: NDArray[np.int64],
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Factorise with the Jacobian in use."""
    state.factored = state.scaled
    state.relaxation = 1.0
    state.rate = 1.0
    state.matrix_age = 0
    state.n_lu += 1
    state.phase = phases.FACTORISED
    if state.outside == 1:
        return phases.NEED_FACTORS
    state.trace_of_j = 0.0
    for i in range(matrices.shape[1]):
        state.trace_of_j += matrices[at.LAST_JACOBIAN, i, i]
    state.sign = factorise(pivots, matrices, mass, places, state.scaled)
    return 0


@inlined
def _is_outgrown(state: Numbers, n: int, massive: bool) -> bool:
    """Tell whether, by the Jacobian in use, something grows faster than the step."""
    if state.reference == 0:
        state.reference = state.sign
    return state.sign != state.reference or (not massive and state.scaled * state.trace_of_j > n)


@inlined
def begin_stages(state: Numbers, rows: FloatArray, matrices: FloatArray, massive: bool) -> None:
    """Begin with stage 1 if the matrix is regular and nothing outgrows the step; else go back to another one.

    An old Jacobian is renewed first; where the newest one is outgrown the one before it follows, then none.
    """
    state.stage = 1
    state.phase = phases.START_STAGE
    if state.sign == 0:
        newton_failed(state, rows, massive)
        state.cause = phases.SINGULAR
    elif state.back < 2 and _is_outgrown(state, rows.shape[1], massive):
        if state.fresh == 0:
            newton_failed(state, rows, massive)
            return
        state.back += 1
        state.phase = phases.FACTORISE
        for i in range(matrices.shape[1]):
            copy(matrices[at.PREVIOUS_JACOBIAN, i], matrices[at.LAST_JACOBIAN, i])
            if state.back == 2 and not massive:
                for j in range(matrices.shape[1]):
                    matrices[at.LAST_JACOBIAN, i, j] = 0.0
