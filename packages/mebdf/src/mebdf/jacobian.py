"""The Jacobian of the solver class for SciPy: given, constant or from differences, and who solves with it."""

from collections.abc import Callable
from functools import cache
from typing import Any, Final, NamedTuple
from warnings import warn

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import OdeSolver
from scipy.sparse import csc_array, csc_matrix, dia_array, diags_array, eye_array
from scipy.sparse.linalg import LinearOperator

from mebdf.algebra import Algebra, Full, Sparse, is_sparse
from mebdf.arrays import FloatArray
from mebdf.differences import (
    DenseDifferences,
    Differences,
    DifferencesOfTerms,
    GroupedDifferences,
    typical_sizes,
)
from mebdf.kernels.ahead import FIRST
from mebdf.mass import MassMatrix

Dense = Callable[[float, FloatArray], FloatArray]

CHANGE: Final = 1e-6  #: Relative change of the state along which it is compared.
#: Difference of the derivatives, relative to the larger one, of a Jacobian that is wrong, not rough.
WRONG: Final = 0.9
NOISE: Final = 1e-12  #: Difference, relative to the right-hand side, that its rounding may be.


class CheckedJacobian:
    """The Jacobian given, until it turns out to be wrong; differences from then on.

    Newton's iteration with −J contracts only for steps below a third of the fastest time constant, so
    a wrong sign would cost steps by the ten thousand. One that is too large makes all corrections tiny.

    ``given``, ``differences``: ``jacobian(t, y)`` of shape (n, n); ``fun``: right-hand side ``fun(t, y)``;
    ``threshold``: size of each component below which it is as good as zero, shape (n,); ``progress``: returns
    the number of Jacobians so far, and whether steps fail so often that a comparison is worth its three
    evaluations.

    Attributes
    ----------
    is_wrong
        Whether it turned out to be.
    """

    def __init__(
        self,
        given: Dense,
        differences: Dense,
        fun: Dense,
        threshold: FloatArray,
        progress: Callable[[], tuple[int, bool]],
    ) -> None:
        self._jacobian, self._differences = given, differences
        self._fun, self._threshold, self._progress = fun, threshold, progress
        self._signs = _signs(threshold.size)
        self._next, self.is_wrong = float(FIRST), False

    def __call__(self, t: float, y: FloatArray) -> FloatArray:
        """Return the Jacobian."""
        matrix = self._jacobian(t, y)
        count, in_trouble = self._progress()
        if count > 1 and (count < self._next or not in_trouble):
            return matrix
        self._next = max(self._next, 2.0 * count)
        self.is_wrong = self._contradicts(matrix, t, y)
        if not self.is_wrong:
            return matrix
        warn(
            f"`jac` is not the derivative of `fun` at t = {t:g}; finite differences are used from here on.",
            RuntimeWarning,
            stacklevel=2,
        )
        self._jacobian, self._next = self._differences, np.inf
        return self._differences(t, y)

    def _contradicts(self, matrix: FloatArray, t: float, y: FloatArray) -> bool:
        """Compare on both sides, since a kink may lie on one of them."""
        f = self._fun(t, y)
        return all(self._differs(matrix, t, y, f, side) for side in (CHANGE, -CHANGE))

    def _differs(self, matrix: FloatArray, t: float, y: FloatArray, f: FloatArray, side: float) -> bool:
        change = side * self._signs * (np.abs(y) + self._threshold)
        found, expected = self._fun(t, y + change) - f, matrix @ change
        larger = max(np.linalg.norm(found), np.linalg.norm(expected))
        return bool(np.linalg.norm(found - expected) > max(WRONG * larger, NOISE * np.linalg.norm(f)))


@cache
def _signs(n: int) -> FloatArray:
    return np.random.default_rng(0).choice([-1.0, 1.0], n)


#: Number of equations up to which the compiled core solves: its decomposition is a plain loop.
LARGEST_IN_CORE: Final = 64

Jacobian = Callable[[float, FloatArray], Any]
Bands = tuple[int, int]


class Linear(NamedTuple):
    """The Jacobian, and who solves with it."""

    jacobian: Jacobian  #: ``jacobian(t, y)``, shape (n, n).
    algebra: Algebra | None  #: Who solves instead of the compiled core, which does where this is ``None``.
    evaluations: int  #: How many evaluations of the right-hand side the Jacobian costs, 0 if it is given.


class Matrices(NamedTuple):
    """Companions of the Jacobian: arguments of the classes that solve."""

    mass: Any  #: Mass matrix, sparse, shape (n, n).
    algebraic: NDArray[np.bool_]  #: Which equations have no derivatives, shape (n,).
    #: Size of each component at which its relative tolerance is as large as the absolute one, shape (n,).
    typical: FloatArray


def make_jacobian(
    solver: OdeSolver,
    jac: Any,
    sparsity: Any,
    bands: Bands | None,
    tolerances: tuple[FloatArray, FloatArray],
    mass: MassMatrix | None,
    progress: Callable[[], tuple[int, bool]],
) -> Linear:
    """Return the Jacobian and who solves with it.

    Parameters
    ----------
    solver
        Whose right-hand side is differenced; its evaluations for that are not counted, as in SciPy.
    jac
        Callable, matrix or ``None``; with ``bands`` its diagonals, shape (lower + upper + 1, n).
    sparsity
        Where the differences may not be zero, shape (n, n), or ``None``.
    bands
        Numbers of diagonals below and above the main one, or ``None``.
    tolerances
        Relative and absolute tolerance of each component, shape (n,) each.
    mass
        Mass matrix, ``None`` for the unit matrix.
    progress
        As for `CheckedJacobian`.
    """
    n = solver.n
    rtol, atol = tolerances
    algebraic = mass is not None and bool(mass.algebraic_equations.any())
    sizes = typical_sizes(rtol, atol, algebraic=algebraic)

    def watched(given: Linear) -> Linear:
        if given.algebra is not None:
            return given
        differences = _differenced(solver, DenseDifferences(sizes), mass)
        return given._replace(
            jacobian=CheckedJacobian(given.jacobian, differences, solver.fun_single, atol, progress)
        )

    if bands is not None and sparsity is not None:
        raise ValueError("Give either `jac_sparsity` or `lband` and `uband`.")
    matrices = _matrices(mass, n, atol / rtol) if n > LARGEST_IN_CORE else None
    if jac is None:
        return _by_differences(solver, _pattern(sparsity, bands, n), sizes, mass, matrices)
    given = jac if callable(jac) and not isinstance(jac, LinearOperator) else _Constant(jac)
    if bands is not None:
        return watched(_by_diagonals(_checked(given, (bands[0] + bands[1] + 1, n)), bands, matrices))
    evaluate = _checked(given, (n, n))
    if matrices is not None:
        evaluate = _Remembered(evaluate, float(solver.t), solver.y.copy())
        if is_sparse(evaluate.first):
            return Linear(evaluate, Sparse(evaluate, *matrices), 0)
    return watched(_full(evaluate, matrices))


def _matrices(mass: MassMatrix | None, n: int, typical: FloatArray) -> Matrices:
    """Return the arguments of solutions outside of the core beside the Jacobian."""
    if mass is None:
        return Matrices(csc_array(eye_array(n)), np.zeros(n, dtype=bool), typical)
    return Matrices(csc_array(mass.matrix), mass.algebraic_equations, typical)


def _by_differences(
    solver: OdeSolver, pattern: Any, threshold: FloatArray, mass: MassMatrix | None, matrices: Matrices | None
) -> Linear:
    """Return a Jacobian by differences; ``threshold`` are values below which these no longer shrink."""
    n = solver.n
    if pattern is None:
        return _full(_differenced(solver, DenseDifferences(threshold), mass), matrices, n)
    grouped = GroupedDifferences(pattern, threshold)
    evaluate = _differenced(solver, grouped, mass)
    if matrices is None:
        return _full(evaluate, matrices, grouped.evaluations)
    return Linear(evaluate, Sparse(evaluate, *matrices), grouped.evaluations)


def _by_diagonals(evaluate: Jacobian, bands: Bands, matrices: Matrices | None) -> Linear:
    """Return a Jacobian that is given by its diagonals."""
    offsets = range(bands[1], -bands[0] - 1, -1)

    def sparse(t: float, y: FloatArray) -> Any:
        return csc_array(dia_array((evaluate(t, y), offsets), shape=(y.size, y.size)))

    return _full(sparse, matrices) if matrices is None else Linear(sparse, Sparse(sparse, *matrices), 0)


def _full(evaluate: Jacobian, matrices: Matrices | None, evaluations: int = 0) -> Linear:
    """Return a dense Jacobian."""

    def dense(t: float, y: FloatArray) -> FloatArray:
        matrix = evaluate(t, y)
        full: FloatArray = matrix.toarray() if is_sparse(matrix) else np.asarray(matrix)
        return full

    return Linear(dense, None if matrices is None else Full(dense, *matrices), evaluations)


class _Constant:
    """A Jacobian that never changes."""

    def __init__(self, matrix: Any) -> None:
        self._matrix = matrix

    def __call__(self, t: float, y: FloatArray) -> Any:
        """Return it."""
        return self._matrix


class _Remembered:
    """A Jacobian that was evaluated at the start, to see of what kind it is, and need not be again."""

    def __init__(self, jacobian: Jacobian, t: float, y: FloatArray) -> None:
        self._jacobian, self._t, self._y = jacobian, t, y
        self.first: Any = jacobian(t, y)

    def __call__(self, t: float, y: FloatArray) -> Any:
        """Return the Jacobian."""
        if self.first is not None and t == self._t and np.array_equal(y, self._y):
            first, self.first = self.first, None
            return first
        return self._jacobian(t, y)


def _checked(jac: Jacobian, shape: tuple[int, int]) -> Jacobian:
    """Return ``jac`` with dense values or in compressed columns; refuse a wrong shape."""

    def jacobian(t: float, y: FloatArray) -> Any:
        value = jac(t, y.copy())
        if isinstance(value, LinearOperator):
            raise ValueError(
                "`jac` is a LinearOperator; give its matrix, dense or sparse: `jac @ np.eye(n)`."
            )
        matrix: Any = _columns(value) if is_sparse(value) else np.asarray(value, np.float64)
        if matrix.shape != shape:
            raise ValueError(f"`jac` is expected to have shape {shape}, but actually has {matrix.shape}.")
        return matrix

    return jacobian


def _columns(matrix: Any) -> Any:
    """Return a sparse matrix in compressed columns, each entry once."""
    columns = csc_array(matrix, dtype=np.float64)
    if not columns.has_canonical_format:
        columns = columns.copy()
        columns.sum_duplicates()
    return columns


def _pattern(sparsity: Any, bands: Bands | None, n: int) -> Any:
    """Return the places of a Jacobian that may differ from zero, in compressed columns; ``None``: all."""
    if bands is not None:
        offsets = range(-min(bands[0], n - 1), min(bands[1], n - 1) + 1)
        ones: Any = [np.ones(n - abs(k)) for k in offsets]
        return csc_array(diags_array(ones, offsets=list(offsets)))
    if sparsity is None:
        return None
    pattern = csc_array(csc_matrix(sparsity), copy=True)
    if pattern.shape != (n, n):
        raise ValueError(
            f"`jac_sparsity` is expected to have shape {(n, n)}, but actually has {pattern.shape}."
        )
    pattern.sum_duplicates()
    pattern.eliminate_zeros()
    return pattern


def _differenced(solver: OdeSolver, differences: Differences, mass: MassMatrix | None) -> Jacobian:
    """Return the Jacobian by finite differences of the right-hand side."""
    if mass is not None:
        differences = DifferencesOfTerms(differences, mass.algebraic_equations)
    return lambda t, y: differences(
        lambda states: solver.fun_vectorized(t, states), y, solver.fun_single(t, y)
    )
