"""Newton matrices of the solver class that are too large for the compiled core: LAPACK and SuperLU."""

from collections.abc import Callable
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import blas, lapack
from scipy.sparse import coo_array, csc_array, issparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from mebdf.arrays import FloatArray
from mebdf.kernels.phases import NEED_FACTORS, NEED_JACOBIAN, NEED_MAGNITUDE, NEED_SOLUTION
from mebdf.kernels.state import DELTA, MAGNITUDE, RESIDUAL, MebdfState

#: Orders of columns for SuperLU: good for symmetric patterns, and for any.
ORDERS: Final = ("MMD_AT_PLUS_A", "COLAMD")
#: Share of the largest entry of its column at which SuperLU takes the entry on the diagonal as the pivot.
PIVOT: Final = 0.1

#: Diagonals of a banded decomposition over entries a column up to which it is the faster one.
NARROW: Final = 4.0

Evaluation = Callable[[float, FloatArray], Any]
Solution = Callable[[FloatArray], FloatArray]


class Algebra(Protocol):
    """Requests of the compiled core to its caller, see :mod:`mebdf.kernels.core`."""

    def linearise(self, t: float, y: FloatArray) -> bool:
        """Evaluate the Jacobian; where it is not finite keep the last one and return False."""
        ...

    def go_back(self, to_zero: bool) -> None:
        """Use the Jacobian before the newest one, or zero, from now on."""
        ...

    def factorise(self, scaled: float) -> int:
        """Prepare solutions with M − ``scaled`` J; return the sign of the determinant, 0 if singular."""
        ...

    def trace(self) -> float:
        """Return the trace of the Jacobian in use."""
        ...

    def solve(self, residual: FloatArray) -> FloatArray:
        """Return the solution for a right-hand side, shape (n,)."""
        ...

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """Return Σ_j (|M_ij| + |scaled J_ij|) |y_j|, shape (n,), as ``kernels.matrix.magnify``."""
        ...

    def entry_not_finite(self) -> tuple[int, int]:
        """Return row and column of the first entry of the Jacobian that was not finite."""
        ...


class _Kept:
    """The last finite Jacobian, in whatever form it is evaluated.

    ``jacobian``: ``jacobian(t, y)``; ``mass``: mass matrix, sparse, shape (n, n); ``algebraic``: which
    equations have no derivatives, shape (n,): step and β do not multiply their Jacobian; ``typical``: size of
    each variable at which its relative tolerance is as large as the absolute one, shape (n,).
    """

    def __init__(
        self, jacobian: Evaluation, mass: Any, algebraic: NDArray[np.bool_], typical: FloatArray
    ) -> None:
        self._jacobian = jacobian
        self._typical = typical
        self._mass = mass
        self._n = algebraic.size
        self._algebraic = algebraic
        self._newest: Any = None
        self._matrix: Any = None
        self._previous: Any = None
        self._is_zero = False
        self._factors: Any = None

    def _factor(self, scaled: float) -> FloatArray:
        """Return the factor of the Jacobian of each equation, shape (n,)."""
        return np.where(self._algebraic, 1.0, scaled)

    def linearise(self, t: float, y: FloatArray) -> bool:
        """See :class:`Algebra`."""
        self._newest = self._jacobian(t, y)
        newest = self._newest
        finite = bool(np.isfinite(newest.data if is_sparse(newest) else newest).all())
        if finite:
            if not self._is_zero:
                self._previous = self._matrix
            self._matrix, self._is_zero = self._newest, False
        return finite

    def go_back(self, to_zero: bool) -> None:
        """See :class:`Algebra`."""
        self._is_zero = to_zero or self._previous is None
        self._matrix = 0.0 * self._matrix if self._is_zero else self._previous

    def trace(self) -> float:
        """See :class:`Algebra`."""
        return float(self._matrix.trace())

    def _magnitude(self, y: FloatArray, scaled: float, product: Callable[[FloatArray], Any]) -> FloatArray:
        """Return the magnitude from the product of the absolute Jacobian with the sizes of variables."""
        of_jacobian = product(np.abs(y))
        if np.any(self._algebraic):
            of_jacobian = of_jacobian + np.where(self._algebraic, product(self._typical), 0.0)
        magnitude: FloatArray = abs(self._mass) @ np.abs(y) + abs(scaled) * of_jacobian
        return magnitude


class Full(_Kept):
    """LU decomposition of LAPACK."""

    def factorise(self, scaled: float) -> int:
        """See :class:`Algebra`."""
        matrix = np.asfortranarray(self._mass.toarray() - self._factor(scaled)[:, None] * self._matrix)
        *self._factors, singular = lapack.dgetrf(matrix, overwrite_a=True)
        return 0 if singular else _sign(np.diagonal(self._factors[0]), _exchanges(self._factors[1]))

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        solution: FloatArray = lapack.dgetrs(*self._factors, residual)[0]
        return solution

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        return self._magnitude(y, scaled, lambda sizes: np.abs(self._matrix) @ sizes)

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        row, column = np.argwhere(~np.isfinite(self._newest))[0]
        return int(row), int(column)


class _Places:
    """Places of the entries of the Jacobian and of the mass matrix in the diagonals of :func:`by_bands`."""

    def __init__(self, jacobian: Any, mass: Any) -> None:
        self._rows, self._starts = jacobian.indices, jacobian.indptr
        (below, column), (below_of_mass, column_of_mass) = _below(jacobian), _below(mass)
        everywhere = np.append(below, below_of_mass)
        self.lower, self.upper = int(np.max(everywhere, initial=0)), int(-np.min(everywhere, initial=0))
        main = self.lower + self.upper
        self.width = self.lower + main + 1
        self.of_jacobian = column, main + below
        self.of_mass = column_of_mass, main + below_of_mass

    def are_those_of(self, jacobian: Any) -> bool:
        """Tell whether a Jacobian has the same entries."""
        return np.array_equal(self._starts, jacobian.indptr) and np.array_equal(self._rows, jacobian.indices)


class Sparse(_Kept):
    """Bands by LAPACK where these are narrow, else SuperLU; the Jacobian is in compressed columns."""

    _order = ""
    _places: _Places | None = None

    def factorise(self, scaled: float) -> int:
        """See :class:`Algebra`."""
        jacobian, mass = self._matrix, self._mass
        if self._places is None or not self._places.are_those_of(jacobian):
            self._places = _Places(jacobian, mass)
        places = self._places
        entries = self._factor(scaled)[jacobian.indices] * jacobian.data
        if places.width > NARROW * jacobian.nnz / self._n:
            scaled_jacobian = csc_array((entries, jacobian.indices, jacobian.indptr), shape=mass.shape)
            self._factors, sign = self._by_superlu(csc_array(mass - scaled_jacobian))
        else:
            packed = np.zeros((self._n, places.width))
            packed[places.of_mass] = mass.data
            packed[places.of_jacobian] -= entries
            self._factors, sign = by_bands(packed.T, places.lower, places.upper)
        return sign

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        solution: FloatArray = self._factors(residual)
        return solution

    def _by_superlu(self, matrix: Any) -> tuple[Solution | None, int]:
        """Return the solver of a matrix, ``None`` if it is singular, and the sign of its determinant."""
        try:
            if not self._order:
                self._order = min(ORDERS, key=lambda order: _superlu(matrix, order).nnz)
            factors = _superlu(matrix, self._order)
        except RuntimeError:  # SuperLU says so of a singular matrix
            return None, 0
        exchanges = sum(self._n - _cycles(order) for order in (factors.perm_r, factors.perm_c))
        return factors.solve, _sign(factors.U.diagonal(), exchanges)

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        return self._magnitude(y, scaled, lambda sizes: abs(self._matrix) @ sizes)

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        entries = coo_array(self._newest)
        first = int(np.argmax(~np.isfinite(entries.data)))
        return int(entries.row[first]), int(entries.col[first])


def by_bands(packed: FloatArray, lower: int, upper: int) -> tuple[Solution | None, int]:
    """Return the solver of a banded matrix, ``None`` if it is singular, and the sign of its determinant.

    ``packed``: its diagonals as LAPACK has them, shape (2 lower + upper + 1, n): entry (i, j) in row lower +
    upper + i − j and column j; destroyed; ``lower``, ``upper``: numbers of diagonals below and above the main
    one.
    """
    banded, pivots, singular = lapack.dgbtrf(packed, lower, upper, overwrite_ab=True)
    if singular:
        return None, 0
    exchanges = _exchanges(pivots)
    sign = _sign(banded[lower + upper], exchanges)
    if exchanges:
        return lambda residual: lapack.dgbtrs(banded, lower, upper, residual, pivots)[0], sign
    # Without exchanges of rows BLAS does the same in a third of the time.
    above, below = (
        np.asfortranarray(banded[lower : lower + upper + 1]),
        np.asfortranarray(banded[lower + upper :]),
    )
    return lambda residual: blas.dtbsv(
        upper, above, blas.dtbsv(lower, below, residual, lower=1, diag=1)
    ), sign


def _exchanges(pivots: NDArray[np.int32]) -> int:
    """Return the number of rows that LAPACK has exchanged."""
    return int(np.count_nonzero(pivots != np.arange(pivots.size)))


def _cycles(order: NDArray[np.int32]) -> int:
    """Return the number of cycles of a permutation."""
    n = order.size
    moves = csc_array((np.ones(n), order, np.arange(n + 1)), shape=(n, n))
    return int(connected_components(moves)[0])


def _sign(pivots: FloatArray, exchanges: int) -> int:
    """Return the sign of a determinant from the pivots and the number of exchanges."""
    return 1 - 2 * ((int(np.count_nonzero(pivots < 0.0)) + exchanges) % 2)


def _below(matrix: Any) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the distances of a matrix's entries below the main diagonal, and their columns."""
    column = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    return matrix.indices - column, column


def is_sparse(matrix: Any) -> bool:
    """Tell whether a matrix is a sparse one of SciPy's."""
    return bool(issparse(matrix))


def _superlu(matrix: Any, order: Any) -> Any:
    """Return the factors of a sparse matrix whose columns SuperLU orders."""
    return splu(matrix, permc_spec=order, diag_pivot_thresh=PIVOT)


def answer(request: int, state: MebdfState, algebra: Algebra, t: float, y: FloatArray) -> None:
    """Answer a request of the core for a solution."""
    scaled, rows = state.number("scaled"), state.rows
    if request == NEED_JACOBIAN:
        state.numbers["finite"] = algebra.linearise(t, y)
    elif request == NEED_FACTORS:
        back = state.number("back")
        if back:
            algebra.go_back(to_zero=back == 2 and state.places.size == 0)
        state.numbers["sign"] = algebra.factorise(scaled)
        state.numbers["trace_of_j"] = algebra.trace()
    elif request == NEED_SOLUTION:
        rows[DELTA] = algebra.solve(rows[RESIDUAL])
    elif request == NEED_MAGNITUDE:
        rows[MAGNITUDE] = algebra.magnitude(scaled, y)
