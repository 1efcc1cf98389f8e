"""State of an MEBDF integration: plain arrays, so that compiled code and Python drive the same core."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.coefficients import MAX_K

# Entries of ``MebdfState.real``.
T: Final = 0
T_END: Final = 1
H: Final = 2
H_MAX: Final = 3
T_EVAL: Final = 4
SCALED: Final = 5
"""Step times β of the present step."""
FACTORED: Final = 6
"""Step times β that the factorised matrix belongs to; 0 when there is none."""
RATE: Final = 7
"""Estimate of the convergence rate of Newton's iteration."""
LAST_NORM: Final = 8
T_OLD: Final = 9
H_LAST: Final = 10
"""Signed size of the last accepted step; the differences belong to it."""
ERROR: Final = 11
DIRECTION: Final = 12
RELAXATION: Final = 13
"""What Newton corrections are multiplied by because the matrix belongs to another step."""
T_BAD: Final = 14
"""Time at which the right-hand side was not finite last."""
UNSOLVED: Final = 15
"""Norm of the residual of the formula, in units of the tolerance, where f was known last."""
UNSOLVED_BEFORE: Final = 16
"""The same one iteration earlier."""
T_MARK: Final = 17
"""Time at which failures began to be counted."""
TRUST: Final = 18
"""Largest residual, in units of the tolerance, that the present Jacobian is trusted to remove."""
OVERSHOT: Final = 19
"""What the last correction was magnified by to rise above rounding, 0 where it was not."""
TRACE: Final = 20
"""Trace of the Jacobian in use."""
SETTINGS: Final = 21
"""First of the entries that hold the settings of the controllers."""

# Settings, in ``real[SETTINGS + ...]``; their values stand in ``DEFAULTS``.
KAPPA: Final = SETTINGS - 1
"""Share of the tolerance that Newton's iteration may leave in stages 1, 2, 3: entries KAPPA + stage."""
SLOW: Final = SETTINGS + 3
"""Convergence rate above which a new matrix takes a new Jacobian."""
OLD_JACOBIAN: Final = SETTINGS + 4
"""Age of the Jacobian at which a new matrix takes a new one."""
SAME_MATRIX: Final = SETTINGS + 5
"""Relative change of step times β up to which the matrix is kept."""
SAFETY_LOWER: Final = SETTINGS + 6
SAFETY: Final = SETTINGS + 7
SAFETY_HIGHER: Final = SETTINGS + 8
LEAST_GROWTH: Final = SETTINGS + 9
LEAST_GROWTH_WITH_MASS: Final = 1.2
"""Where algebraic equations converge by what the matrix knows of them, a longer step saves less."""
LARGEST_GROWTH: Final = SETTINGS + 10
"""Largest growth of the step at once; its square where there is one back value."""
DISAGREEMENT: Final = SETTINGS + 11
"""Largest distance of y_{n+1} from ȳ1 in units of the tolerance."""
FORGET: Final = SETTINGS + 12
"""How much of the estimated convergence rate the next stage inherits."""
WAIT: Final = SETTINGS + 13
"""Steps to wait, beyond k, before order and step are chosen anew."""
SHRINK: Final = SETTINGS + 14
"""Reluctance of the step after a failed error test."""
RENEW: Final = SETTINGS + 15
"""Steps after which the matrix is renewed although the step has not changed."""
UNSURE: Final = SETTINGS + 16
"""Steps after which a convergence rate that was not measured again is forgotten."""
EARLY: Final = SETTINGS + 17
"""Error, in units of the tolerance, above which the step is shortened before it fails."""
TIGHT: Final = SETTINGS + 18
"""Share of the tolerances that the method uses: errors of steps add up."""
DOUBTFUL: Final = SETTINGS + 19
"""Residual of the formula, in units of the tolerance, that a small correction may not leave."""
TINY: Final = SETTINGS + 20
"""Correction that is small, in units of the tolerance; without trust, over the residual."""
DEFAULTS: Final = (
    *(0.24, 0.42, 0.20),
    *(0.05, 40.0, 0.05),
    *(1.44, 1.54, 1.62, 1.05, 6.0),
    *(1.9, 0.28, 2.0, 1.9, 20.0, 3.0, 0.9),
    0.3,
    *(10.0, 0.02),
)
N_REAL: Final = SETTINGS + len(DEFAULTS)

# A Jacobian by many differences must be worse before it is renewed.
EVALUATIONS: Final = 40
"""Evaluations a Jacobian costs, over the convergence rate at which it is renewed."""
SLOWEST: Final = 0.5
"""Largest of these rates."""
PRICE: Final = 4
"""Iterations beyond the first of stages, over the evaluations a Jacobian costs, until it is renewed."""
LEAST_PRICE: Final = 10
"""Least number of these iterations."""

# Entries of ``MebdfState.counts``.
PHASE: Final = 0
K: Final = 1
EQUAL_STEPS: Final = 2
ITERATION: Final = 3
STAGE: Final = 4
STEPS: Final = 5
REJECTED: Final = 6
N_F: Final = 7
N_J: Final = 8
N_LU: Final = 9
JACOBIAN_AGE: Final = 10
"""Steps since the Jacobian was evaluated; where it is differenced, iterations beyond the first of a stage."""
CARRIED: Final = 11
"""Whether stage 2 of the last step predicts stage 1 of this one, with its derivative."""
FAILURES: Final = 12
"""Failed error tests in a row."""
K_LAST: Final = 13
FRESH: Final = 14
"""Whether the Jacobian was evaluated at the present point."""
REASON: Final = 15
LARGEST_K: Final = 16
FIXED: Final = 17
"""Whether step and order are held, for convergence tests."""
INSIDE: Final = 18
"""Whether the right-hand side may not be evaluated beyond the end."""
BAD: Final = 19
"""Component in which the right-hand side was not finite last, −1 if it never was."""
N_SOLVES: Final = 20
LAST: Final = 21
"""Whether this is a last step that may not look beyond the end."""
WORST: Final = 22
"""Component to blame for the last rejected step, −1 if there was none since the last accepted one."""
CAUSE: Final = 23
"""Why the last step was rejected."""
RATE_AGE: Final = 24
"""Steps since the convergence rate was measured."""
MATRIX_AGE: Final = 25
"""Steps since the matrix was factorised."""
DIFFERENCED: Final = 26
"""Whether the Jacobian comes from differences: each costs as many evaluations as there are equations."""
WARY: Final = 27
"""Steps to come in which every stage must show by an evaluation that it solves its formula."""
VAIN: Final = 28
"""Failures of Newton's iteration with a new Jacobian since ``real[T_MARK]``."""
OUTSIDE: Final = 29
"""Whether the caller keeps the Jacobian and solves with the iteration matrix."""
FINITE: Final = 30
"""Whether the newest Jacobian is finite."""
SIGN: Final = 31
"""Sign of the determinant of the iteration matrix, 0 where it is singular."""
BACK: Final = 32
"""Which Jacobian is in use: 0 the newest, 1 the one before it, 2 zero (with a mass matrix still that)."""
HIGHER: Final = 33
"""Whether a variable has an index above 1: constraints must then hold better than the tolerance."""
IMPLICIT: Final = 34
"""Whether the caller evaluates the whole residual of an equation in t, y and y'."""
AHEAD: Final = 35
"""Whether the next Jacobian is that of the predicted value."""
REFERENCE: Final = 36
"""Sign of the determinant for short steps, 0 while it is unknown."""
PIVOTS: Final = 37
"""First of n row exchanges of the factorised matrix."""

# Rows of ``MebdfState.rows``.
ATOL: Final = 0
RTOL: Final = 1
WEIGHT: Final = 2
"""Reciprocal error scale 1/(atol + rtol |y|)."""
Y: Final = 3
"""Point at which the caller evaluates."""
F: Final = 4
"""Derivative the caller fills in."""
CONSTANT: Final = 5
"""What a stage knows before it starts."""
Y_1: Final = 6
F_1: Final = 7
Y_2: Final = 8
F_2: Final = 9
DELTA: Final = 10
"""Newton correction."""
RESIDUAL: Final = 11
PREDICTED: Final = 12
"""Extrapolation to the point of the stage."""
CONSTANT_3: Final = 13
"""What stage 3 takes from the history."""
MAGNITUDE: Final = 14
"""|y_i| + |hβ| Σ_j |J_ij y_j|: the rounding of the residual is a share of it."""
ERROR_WEIGHT: Final = 15
"""WEIGHT, and 0 for what is not in the error test; with a mass matrix alone, as the next rows."""
ROW_WEIGHT: Final = 16
"""Reciprocal scale of the residual of an equation with derivatives, 0 for an algebraic one."""
POWER: Final = 17
"""Power of the step in the weight of a variable: its index less one."""
TESTED: Final = 18
"""1 for a variable in the error test, else 0."""
SEEN: Final = 19
"""Largest residual of an algebraic equation that the present Jacobian was seen to remove."""
HISTORY: Final = 20
"""First of the backward differences ∇^i y_n."""
N_DIFFERENCES: Final = MAX_K + 3
STAGE_HISTORY: Final = HISTORY + N_DIFFERENCES
"""First of the backward differences with ȳ1 as the newest value."""
SCRATCH: Final = STAGE_HISTORY + N_DIFFERENCES
N_ROWS: Final = SCRATCH + N_DIFFERENCES

# Matrices of ``MebdfState.matrices``.
JACOBIAN: Final = 0
"""Jacobian the caller fills in."""
LAST_JACOBIAN: Final = 1
"""Last Jacobian that was finite."""
FACTORS: Final = 2
"""Inverse or LU factors of the iteration matrix."""
PREVIOUS_JACOBIAN: Final = 3
"""Finite Jacobian that was in use before the last one."""


class MebdfState(NamedTuple):
    """Everything an integration of ``n`` equations needs between two calls of ``resume``.

    Attributes
    ----------
    real, counts
        Numbers named above; ``counts`` ends with the row exchanges.
    rows
        Vectors named above, shape (N_ROWS, n).
    matrices
        Matrices named above, shape (4, n, n); of no size where the caller solves.
    mass
        Entries of the mass matrix, row by row; of no size where it is the unit matrix.
    places
        Where each row begins in ``mass``, n + 1 numbers, then the column of each entry.
    """

    real: FloatArray
    counts: NDArray[np.int64]
    rows: FloatArray
    matrices: FloatArray
    mass: FloatArray
    places: NDArray[np.int64]


class Mass(NamedTuple):
    """A constant mass matrix by its entries, and what goes with it.

    Attributes
    ----------
    entries
        Entries that are not zero, row by row.
    places
        Where each row begins in ``entries``, n + 1 numbers, then the column of each entry.
    slope
        y' at the start, shape (n,): as far as it is not known 0.
    indices
        Index of each variable, shape (n,).
    tested
        Whether a variable is in the error test, shape (n,).
    implicit
        Whether the mass matrix is −∂f/∂y' of a residual f(t, y, y') = 0 that the caller evaluates, and renews
        with the Jacobian ∂f/∂y.
    """

    entries: FloatArray
    places: NDArray[np.int64]
    slope: FloatArray
    indices: NDArray[np.int64]
    tested: NDArray[np.bool_]
    implicit: bool = False


def new_state(
    t: float,
    y: FloatArray,
    t_end: float,
    rtol: float | FloatArray,
    atol: FloatArray,
    *,
    max_step: float = np.inf,
    first_step: float = 0.0,
    largest_k: int = MAX_K,
    inside: bool = False,
    differenced: int = 0,
    outside: bool = False,
    mass: Mass | None = None,
) -> MebdfState:
    """Return the state before the first step.

    Parameters
    ----------
    t, t_end
        Start and end of the integration; backward in time if ``t_end < t``.
    y
        Initial value, shape (n,).
    rtol, atol
        Tolerances, numbers or shape (n,).
    max_step
        Largest step size.
    first_step
        Size of the first step; 0 to estimate it.
    largest_k
        Largest number of back values, 1 to MAX_K.
    inside
        Whether the right-hand side may not be evaluated beyond ``t_end``.
    differenced
        How many evaluations of the right-hand side a Jacobian by differences costs; 0 for one that is given.
    outside
        Whether the caller solves with the iteration matrix, see :mod:`mebdf.kernels.core`.
    mass
        Mass matrix, ``None`` for the unit matrix.
    """
    n = y.size
    size = 0 if outside else n
    real = np.zeros(N_REAL)
    real[[T, T_OLD, T_MARK]] = t
    real[T_END] = t_end
    real[DIRECTION] = 1.0 if t_end >= t else -1.0
    real[H] = first_step
    real[H_MAX] = max_step
    real[[RATE, RELAXATION]] = 1.0
    real[SETTINGS:] = DEFAULTS
    count = np.zeros(PIVOTS + size, dtype=np.int64)
    count[[K, K_LAST]] = 1
    count[LARGEST_K] = largest_k
    count[INSIDE] = inside
    count[DIFFERENCED] = min(differenced, 1)
    real[SLOW] = max(real[SLOW], min(differenced / EVALUATIONS, SLOWEST))
    if differenced > 0:
        real[OLD_JACOBIAN] = max(PRICE * differenced, LEAST_PRICE)
    count[OUTSIDE] = outside
    count[[BAD, WORST]] = -1
    count[REFERENCE] = mass is None
    rows = np.zeros((N_ROWS, n))
    rows[ATOL] = atol
    rows[RTOL] = rtol
    rows[[Y, HISTORY]] = y
    matrices = np.zeros((4, size, size))
    if mass is None:
        return MebdfState(real, count, rows, matrices, np.zeros(0), np.zeros(0, dtype=np.int64))
    rows[F_1] = mass.slope
    rows[POWER] = np.maximum(mass.indices - 1, 0)
    rows[TESTED] = mass.tested
    count[IMPLICIT] = mass.implicit
    if np.any(mass.indices > 1):
        count[HIGHER] = 1
        real[SAME_MATRIX] = 0.0  # algebraic equations know no step that a correction could be adapted to
    real[LEAST_GROWTH] = LEAST_GROWTH_WITH_MASS
    return MebdfState(real, count, rows, matrices, mass.entries, mass.places)
