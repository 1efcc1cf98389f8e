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

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
from mebdf.kernels.arrays import copy
from mebdf.kernels.control import newton_failed
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.matrix import factorise
from mebdf.kernels.phases import (
    FACTORISE,
    FACTORISED,
    FAILED,
    JACOBIAN_NOT_FINITE,
    NEED_FACTORS,
    SINGULAR,
    START_STAGE,
)


@kernel
def take_over(count: NDArray[np.int64], real: FloatArray, rows: FloatArray, matrices: FloatArray) -> int:
    """Keep a new Jacobian if it is finite, and the one before it."""
    count[at.PHASE] = FACTORISE
    real[at.TRUST] = 0.0
    for i in range(rows.shape[1]):
        rows[at.SEEN, i] = 0.0
    if count[at.OUTSIDE] == 0:
        n, total = matrices.shape[1], 0.0
        for i in range(n):
            for j in range(n):
                total += matrices[at.JACOBIAN, i, j]
        count[at.FINITE] = math.isfinite(total)
        for i in range(n if count[at.FINITE] == 1 else 0):
            if count[at.BACK] == 0:
                copy(matrices[at.LAST_JACOBIAN, i], matrices[at.PREVIOUS_JACOBIAN, i])
            copy(matrices[at.JACOBIAN, i], matrices[at.LAST_JACOBIAN, i])
    count[at.BACK] = 0
    if count[at.FINITE] == 0 and count[at.N_J] == 1:
        count[at.REASON] = JACOBIAN_NOT_FINITE
        return FAILED
    return 0


@kernel
def renew_matrix(
    real: FloatArray,
    count: NDArray[np.int64],
    matrices: FloatArray,
    mass: FloatArray,
    places: NDArray[np.int64],
) -> int:
    """Factorise with the Jacobian in use."""
    real[at.FACTORED] = real[at.SCALED]
    real[at.RELAXATION] = 1.0
    real[at.RATE] = 1.0
    count[at.MATRIX_AGE] = 0
    count[at.N_LU] += 1
    count[at.PHASE] = FACTORISED
    if count[at.OUTSIDE] == 1:
        return NEED_FACTORS
    real[at.TRACE] = 0.0
    for i in range(matrices.shape[1]):
        real[at.TRACE] += matrices[at.LAST_JACOBIAN, i, i]
    count[at.SIGN] = factorise(count, matrices, mass, places, real[at.SCALED])
    return 0


@inlined
def _is_outgrown(real: FloatArray, count: NDArray[np.int64], n: int, massive: bool) -> bool:
    """Tell whether, by the Jacobian in use, something grows faster than the step."""
    if count[at.REFERENCE] == 0:
        count[at.REFERENCE] = count[at.SIGN]
    return count[at.SIGN] != count[at.REFERENCE] or (not massive and real[at.SCALED] * real[at.TRACE] > n)


@inlined
def begin_stages(
    real: FloatArray,
    count: NDArray[np.int64],
    rows: FloatArray,
    matrices: FloatArray,
    massive: bool,
) -> None:
    """Begin with stage 1 if the matrix is regular and nothing outgrows the step; else go back to another one.

    An old Jacobian is renewed first; where the newest one is outgrown the one before it follows, then none.
    """
    count[at.STAGE] = 1
    count[at.PHASE] = START_STAGE
    if count[at.SIGN] == 0:
        newton_failed(real, count, rows, massive)
        count[at.CAUSE] = SINGULAR
    elif count[at.BACK] < 2 and _is_outgrown(real, count, rows.shape[1], massive):
        if count[at.FRESH] == 0:
            newton_failed(real, count, rows, massive)
            return
        count[at.BACK] += 1
        count[at.PHASE] = FACTORISE
        for i in range(matrices.shape[1]):
            copy(matrices[at.PREVIOUS_JACOBIAN, i], matrices[at.LAST_JACOBIAN, i])
            if count[at.BACK] == 2 and not massive:
                for j in range(matrices.shape[1]):
                    matrices[at.LAST_JACOBIAN, i, j] = 0.0
