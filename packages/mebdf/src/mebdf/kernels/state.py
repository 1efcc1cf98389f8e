"""State of an MEBDF integration: a record and arrays, for compiled code and Python alike."""

from typing import Annotated, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix
from mebdf.kernels.coefficients import MAX_K

#: ``least_growth`` with a mass matrix: where algebraic equations converge by what the matrix knows of them, a
#: longer step saves less.
LEAST_GROWTH_WITH_MASS: Final = 1.2

# A Jacobian by many differences must be worse before it is renewed.
EVALUATIONS: Final = 40  #: Evaluations a Jacobian costs, over the convergence rate at which it is renewed.
SLOWEST: Final = 0.5  #: Largest of these rates.
#: Iterations beyond the first of stages, over the evaluations a Jacobian costs, until it is renewed.
PRICE: Final = 4
LEAST_PRICE: Final = 10  #: Least number of these iterations.

# Rows of ``MebdfState.rows``.
ATOL: Final = 0
RTOL: Final = 1
WEIGHT: Final = 2  #: Reciprocal error scale 1/(atol + rtol |y|).
Y: Final = 3  #: Point at which the caller evaluates.
F: Final = 4  #: Derivative the caller fills in.
CONSTANT: Final = 5  #: Part of a stage's formula that does not depend on its value.
Y_1: Final = 6
F_1: Final = 7
Y_2: Final = 8
F_2: Final = 9
DELTA: Final = 10  #: Newton correction.
RESIDUAL: Final = 11
PREDICTED: Final = 12  #: Extrapolation to the point of the stage.
CONSTANT_3: Final = 13  #: Part of stage 3 from the history.
MAGNITUDE: Final = 14  #: |y_i| + |hβ| Σ_j |J_ij y_j|: the rounding of the residual is a share of it.
#: WEIGHT, and 0 for what is not in the error test; with a mass matrix alone, as the next rows.
ERROR_WEIGHT: Final = 15
#: Reciprocal scale of the residual of an equation with derivatives, 0 for an algebraic one.
ROW_WEIGHT: Final = 16
POWER: Final = 17  #: Power of the step in the weight of a variable: its index less one.
TESTED: Final = 18  #: 1 for a variable in the error test, else 0.
SEEN: Final = 19  #: Largest residual of an algebraic equation that the present Jacobian was seen to remove.
HISTORY: Final = 20  #: First of the backward differences ∇^i y_n.
N_DIFFERENCES: Final = MAX_K + 3
#: First of the backward differences with ȳ1 as the newest value.
STAGE_HISTORY: Final = HISTORY + N_DIFFERENCES
SCRATCH: Final = STAGE_HISTORY + N_DIFFERENCES
N_ROWS: Final = SCRATCH + N_DIFFERENCES

# Matrices of ``MebdfState.matrices``.
JACOBIAN: Final = 0  #: Jacobian the caller fills in.
LAST_JACOBIAN: Final = 1  #: Last Jacobian that was finite.
FACTORS: Final = 2  #: Inverse or LU factors of the iteration matrix.
PREVIOUS_JACOBIAN: Final = 3  #: Finite Jacobian that was in use before the last one.


class Settings:
    """Settings of the controllers, with their defaults."""

    #: Share of the tolerance that Newton's iteration may leave in stages 1, 2, 3.
    kappa: tuple[float, ...] = (0.24, 0.42, 0.20)
    slow: float = 0.05  #: Convergence rate above which a new matrix takes a new Jacobian.
    old_jacobian: float = 40.0  #: Age of the Jacobian at which a new matrix takes a new one.
    same_matrix: float = 0.05  #: Relative change of step times β up to which the matrix is kept.
    safety_lower: float = 1.44
    safety: float = 1.54
    safety_higher: float = 1.62
    least_growth: float = 1.05
    #: Largest growth of the step at once; its square where there is one back value.
    largest_growth: float = 6.0
    disagreement: float = 1.9  #: Largest distance of y_{n+1} from ȳ1 in units of the tolerance.
    forget: float = 0.28  #: Share of the estimated convergence rate that the next stage inherits.
    wait: float = 2.0  #: Steps to wait, beyond k, before order and step are chosen anew.
    shrink: float = 1.9  #: Reluctance of the step after a failed error test.
    renew: float = 20.0  #: Steps after which the matrix is renewed although the step has not changed.
    unsure: float = 3.0  #: Steps after which a convergence rate that was not measured again is forgotten.
    #: Error, in units of the tolerance, above which the step is shortened before it fails.
    early: float = 0.9
    tight: float = 0.3  #: Share of the tolerances that the method uses: errors of steps add up.
    larger_change: float = 30.0  #: Largest distance of stage 2 from its extrapolation over that of stage 1.
    #: Error of stage 1, in units of the tolerance, that stage 2 is compared with at least.
    no_change: float = 1.0e-3
    #: Error of stage 1, in units of the tolerance, up to which a step may end with it where there is a mass
    #: matrix: its error is that of a lower order, which no test has counted. Without one nothing is gained.
    straight: float = 1.0e-4
    #: Factor of the step when Newton's iteration fails although the Jacobian is new.
    failed_newton: float = 0.25
    #: Residual of the formula, in units of the tolerance, that a small correction may not leave.
    doubtful: float = 10.0
    #: Correction that is small, in units of the tolerance; without trust, over the residual.
    tiny: float = 0.02


class Numbers:
    """Numbers of an integration, the fields of a record; whole numbers are also used for true and false."""

    settings: Settings
    t: float
    t_end: float
    h: float
    h_max: float
    t_eval: float
    scaled: float  #: Step times β of the present step.
    factored: float  #: Step times β that the factorised matrix belongs to; 0 when there is none.
    rate: float  #: Estimate of the convergence rate of Newton's iteration.
    last_norm: float
    t_old: float
    h_last: float  #: Signed size of the last accepted step; the differences belong to it.
    error: float
    direction: float
    relaxation: float  #: Factor of Newton corrections because the matrix belongs to another step.
    t_bad: float  #: Time at which the right-hand side was not finite last.
    #: Norm of the residual of the formula, in units of the tolerance, where f was known last.
    unsolved: float
    left: float  #: Share of the residual that the last correction has left; 1 where that is not known.
    t_mark: float  #: Time at which failures began to be counted.
    #: Largest residual, in units of the tolerance, that the present Jacobian is trusted to remove.
    trust: float
    reached: float  #: Smallest residual, in units of the tolerance, to which it was seen to reduce one.
    #: Factor by which the last correction was magnified to rise above rounding, 0 where it was not.
    overshot: float
    trace_of_j: float  #: Trace of the Jacobian in use.
    phase: int
    k: int
    equal_steps: int
    iteration: int
    evaluated: int  #: Evaluations for the present stage, whose first residual may follow from another one.
    stage: int
    steps: int
    rejected: int
    n_f: int
    n_j: int
    n_lu: int
    #: Steps since the Jacobian was evaluated; if it is differenced, iterations beyond the first of stages.
    jacobian_age: int
    carried: int  #: Whether stage 2 of the last step predicts stage 1 of this one, with its derivative.
    failures: int  #: Failed error tests in a row.
    k_last: int
    fresh: int  #: Whether the Jacobian was evaluated at the present point.
    reason: int
    largest_k: int
    fixed: int  #: Whether step and order are held, for convergence tests.
    inside: int  #: Whether the right-hand side may not be evaluated beyond the end.
    bad: int  #: Component in which the right-hand side was not finite last, −1 if it never was.
    n_solves: int
    last: int  #: Whether this is a last step that may not look beyond the end.
    #: Component to blame for the last rejected step, −1 if there was none since the last accepted one.
    worst: int
    cause: int  #: Why the last step was rejected.
    rate_age: int  #: Steps since the convergence rate was measured.
    matrix_age: int  #: Steps since the matrix was factorised.
    #: Whether the Jacobian comes from differences: each costs as many evaluations as there are equations.
    differenced: int
    wary: int  #: Steps to come in which every stage must show by an evaluation that it solves its formula.
    vain: int  #: Failures of Newton's iteration with a new Jacobian since ``t_mark``.
    f_mark: int  #: Evaluations until ``t_mark``.
    outside: int  #: Whether the caller keeps the Jacobian and solves with the iteration matrix.
    finite: int  #: Whether the newest Jacobian is finite.
    sign: int  #: Sign of the determinant of the iteration matrix, 0 where it is singular.
    back: int  #: Jacobian in use: 0 the newest, 1 the one before it, 2 zero (with a mass matrix still that).
    #: Whether a variable has an index above 1: constraints must then hold better than the tolerance.
    higher: int
    implicit: int  #: Whether the caller evaluates the whole residual of an equation in t, y and y'.
    ahead: int  #: Whether the next Jacobian is that of the predicted value.
    reference: int  #: Sign of the determinant for short steps, 0 while it is unknown.
    #: Whether the solution of the stage lies between two known values, see :mod:`mebdf.kernels.acceptance`.
    between: int
    halvings: int  #: Halvings of their distance in the present stage.
    trouble: int  #: Measure of the failures of Newton's iteration in the last steps.


def _type_of(fields: type) -> np.dtype[np.void]:
    """Return the type of a record with the annotated fields of a class."""
    kinds: dict[Any, Any] = {float: (np.float64,), int: (np.int64,), tuple[float, ...]: (np.float64, 3)}
    if fields is not Settings:
        kinds[Settings] = (_type_of(Settings),)
    named = [(name, *kinds[kind]) for name, kind in fields.__annotations__.items()]
    return np.dtype((np.record, np.dtype(named, align=True)))


#: Type of the record of :class:`Numbers`, which compiled code takes as one address.
NUMBERS: Final = _type_of(Numbers)


def _defaults() -> NDArray[np.void]:
    """Return the numbers that every integration begins with, shape (1,)."""
    numbers = np.zeros(1, dtype=NUMBERS)
    for name in Settings.__annotations__:
        numbers["settings"][name] = getattr(Settings, name)
    for name in ("rate", "relaxation", "k", "k_last"):
        numbers[name] = 1
    numbers["bad"] = numbers["worst"] = -1
    return numbers


_DEFAULTS: Final = _defaults()


class MebdfState(NamedTuple):
    """Everything an integration of ``n`` equations needs between two calls of ``resume``."""

    #: One record of :class:`Numbers`, shape (1,): compiled code is handed an array sooner than a record.
    numbers: Annotated[NDArray[np.void], NUMBERS, 1]
    rows: FloatMatrix  #: Vectors named above, shape (N_ROWS, n).
    matrices: FloatCube  #: Matrices named above, shape (4, n, n); of no size where the caller solves.
    #: Row exchanges of the factorised matrix, shape (n,); of no size where the caller solves.
    pivots: NDArray[np.int64]
    mass: FloatArray  #: Entries of the mass matrix, row by row; of no size where it is the unit matrix.
    #: Where each row begins in ``mass``, n + 1 numbers, then the column of each entry.
    places: NDArray[np.int64]

    def number(self, name: str) -> Any:
        """Return a number of the record."""
        return self.numbers[name].item()


class Mass(NamedTuple):
    """A constant mass matrix by its entries, and what goes with it."""

    entries: FloatArray  #: Entries that are not zero, row by row.
    #: Where each row begins in ``entries``, n + 1 numbers, then the column of each entry.
    places: NDArray[np.int64]
    slope: FloatArray  #: y' at the start, shape (n,): as far as it is not known 0.
    indices: NDArray[np.int64]  #: Index of each variable, shape (n,).
    tested: NDArray[np.bool_]  #: Whether a variable is in the error test, shape (n,).
    #: Whether the mass matrix is −∂f/∂y' of a residual f(t, y, y') = 0 that the caller evaluates, and renews
    #: with the Jacobian ∂f/∂y.
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
    # Attributes of a record take ten times as long as fields of an array.
    numbers = _DEFAULTS.copy()
    settings = numbers["settings"]
    numbers["t"] = numbers["t_old"] = numbers["t_mark"] = t
    numbers["t_end"] = t_end
    numbers["direction"] = 1.0 if t_end >= t else -1.0
    numbers["h"], numbers["h_max"] = first_step, max_step
    numbers["largest_k"], numbers["inside"], numbers["outside"] = largest_k, inside, outside
    numbers["differenced"] = min(differenced, 1)
    settings["slow"] = max(Settings.slow, min(differenced / EVALUATIONS, SLOWEST))
    if differenced > 0:
        settings["old_jacobian"] = max(PRICE * differenced, LEAST_PRICE)
    numbers["reference"] = mass is None
    rows = np.zeros((N_ROWS, n))
    rows[ATOL] = atol
    rows[RTOL] = rtol
    rows[[Y, HISTORY]] = y
    matrices, pivots = np.zeros((4, size, size)), np.zeros(size, dtype=np.int64)
    if mass is None:
        return MebdfState(numbers, rows, matrices, pivots, np.zeros(0), np.zeros(0, dtype=np.int64))
    rows[F_1] = mass.slope
    rows[POWER] = np.maximum(mass.indices - 1, 0)
    rows[TESTED] = mass.tested
    numbers["implicit"] = mass.implicit
    if np.any(mass.indices > 1):
        numbers["higher"] = 1
        # Algebraic equations contain no step that a correction could be adapted to.
        settings["same_matrix"] = 0.0
    settings["least_growth"] = LEAST_GROWTH_WITH_MASS
    return MebdfState(numbers, rows, matrices, pivots, mass.entries, mass.places)
