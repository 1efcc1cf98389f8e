"""Newton matrices of the solver class that are too large for the compiled core: LAPACK and SuperLU."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack
from scipy.sparse import coo_array, csc_array, diags_array, issparse
from scipy.sparse.linalg import splu

from tribodyn.core.arrays import FloatArray

ORDERS: Final = ("MMD_AT_PLUS_A", "COLAMD")
"""Orders of columns for SuperLU: good for symmetric patterns, and for any."""
PIVOT: Final = 0.1
"""Share of the largest entry of its column at which SuperLU takes the entry on the diagonal as the pivot."""

Evaluation = Callable[[float, FloatArray], Any]


class Algebra(Protocol):
    """What the compiled core asks of its caller, see :mod:`tribodyn.kernels.mebdf.core`."""

    def linearise(self, t: float, y: FloatArray) -> bool:
        """Evaluate the Jacobian; where it is not finite keep the last one and return False."""
        ...

    def factorise(self, scaled: float) -> bool:
        """Prepare solutions with M − ``scaled`` J; return whether it is regular."""
        ...

    def solve(self, residual: FloatArray) -> FloatArray:
        """Return the solution for a right-hand side, shape (n,)."""
        ...

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """Return Σ_j (|M_ij| + |scaled J_ij|) |y_j|, shape (n,), as ``kernels.mebdf.matrix.magnify``."""
        ...

    def entry_not_finite(self) -> tuple[int, int]:
        """Return row and column of the first entry of the Jacobian that was not finite."""
        ...


class _Kept:
    """The last finite Jacobian, in whatever form it is evaluated.

    Parameters
    ----------
    jacobian
        ``jacobian(t, y)``.
    mass
        Mass matrix, sparse, shape (n, n).
    algebraic
        Which equations have no derivatives, shape (n,): step and β do not multiply their Jacobian.
    typical
        Size of each variable at which its relative tolerance is as large as the absolute one, shape (n,).
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
        self._factors: Any = None

    def _factor(self, scaled: float) -> FloatArray:
        """Return what multiplies the Jacobian of each equation, shape (n,)."""
        return np.where(self._algebraic, 1.0, scaled)

    def linearise(self, t: float, y: FloatArray) -> bool:
        """See :class:`Algebra`."""
        self._newest = self._jacobian(t, y)
        newest = self._newest
        finite = bool(np.isfinite(newest.data if is_sparse(newest) else newest).all())
        if finite:
            self._matrix = self._newest
        return finite

    def _magnitude(self, y: FloatArray, scaled: float, product: Callable[[FloatArray], Any]) -> FloatArray:
        """Return the magnitude from the product of the absolute Jacobian with the sizes of variables."""
        of_jacobian = product(np.abs(y))
        if np.any(self._algebraic):
            of_jacobian = of_jacobian + np.where(self._algebraic, product(self._typical), 0.0)
        magnitude: FloatArray = abs(self._mass) @ np.abs(y) + abs(scaled) * of_jacobian
        return magnitude


class Full(_Kept):
    """LU decomposition of LAPACK."""

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        matrix = np.asfortranarray(self._mass.toarray() - self._factor(scaled)[:, None] * self._matrix)
        *self._factors, singular = lapack.dgetrf(matrix, overwrite_a=True)
        return bool(singular == 0)

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


class Banded(_Kept):
    """Banded LU decomposition of LAPACK; rows of the Jacobian are diagonals, ``packed[i - j + upper, j]``.

    Parameters
    ----------
    jacobian, mass, algebraic, typical
        ``jacobian(t, y)``, packed, shape (lower + upper + 1, n); the mass matrix within these diagonals.
    lower, upper
        Numbers of diagonals below and above the main one.
    """

    def __init__(
        self,
        jacobian: Evaluation,
        mass: Any,
        algebraic: NDArray[np.bool_],
        typical: FloatArray,
        lower: int,
        upper: int,
    ) -> None:
        super().__init__(jacobian, mass, algebraic, typical)
        n = self._n
        self._lower, self._upper = lower, upper
        row: Any = np.arange(n) - upper + np.arange(lower + upper + 1)[:, None]
        self._row = row
        self._inside = (row >= 0) & (row < n)
        self._of_algebraic = algebraic[np.where(self._inside, row, 0)]
        self._packed_mass = packed(mass, lower, upper)

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        work = np.zeros((2 * self._lower + self._upper + 1, self._n), order="F")
        work[self._lower :] = self._diagonals(scaled)
        *self._factors, singular = lapack.dgbtrf(work, self._lower, self._upper, overwrite_ab=True)
        return bool(singular == 0)

    def _diagonals(self, scaled: float) -> FloatArray:
        """Return those of the Newton matrix, shape (lower + upper + 1, n), with zeros beyond its corners."""
        factor = np.where(self._of_algebraic, 1.0, scaled)
        return np.where(self._inside, self._packed_mass - factor * self._matrix, 0.0)

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        factors, pivots = self._factors
        solution: FloatArray = lapack.dgbtrs(factors, self._lower, self._upper, residual, pivots)[0]
        return solution

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""

        def sums(sizes: FloatArray) -> Any:
            terms = np.abs(self._matrix * sizes)[self._inside]
            return np.bincount(self._row[self._inside], weights=terms, minlength=self._n)

        return self._magnitude(y, scaled, sums)

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        diagonal, column = np.argwhere(~np.isfinite(self._newest))[0]
        return int(self._row[diagonal, column]), int(column)


class Tridiagonal(Banded):
    """One diagonal below and one above the main one: a decomposition that is several times faster."""

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        above, main, below = self._diagonals(scaled)
        *self._factors, singular = lapack.dgttrf(below[:-1], main, above[1:])
        return bool(singular == 0)

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        solution: FloatArray = lapack.dgttrs(*self._factors, residual)[0]
        return solution


class Sparse(_Kept):
    """SuperLU; the Jacobian is a sparse matrix in compressed columns."""

    _order = ""

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        matrix = csc_array(self._mass - diags_array(self._factor(scaled)) @ self._matrix)
        try:
            if not self._order:
                self._order = min(ORDERS, key=lambda order: _factors(matrix, order).nnz)
            self._factors = _factors(matrix, self._order)
        except RuntimeError:  # SuperLU says so of a singular matrix
            return False
        return True

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        solution: FloatArray = self._factors.solve(residual)
        return solution

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        return self._magnitude(y, scaled, lambda sizes: abs(self._matrix) @ sizes)

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        entries = coo_array(self._newest)
        first = int(np.argmax(~np.isfinite(entries.data)))
        return int(entries.row[first]), int(entries.col[first])


def banded(jacobian: Evaluation, matrices: tuple[Any, Any, Any], width: tuple[int, int]) -> Banded:
    """Return who solves with ``width`` diagonals below and above the main one; see :class:`Banded`."""
    kind = Tridiagonal if width == (1, 1) else Banded
    return kind(jacobian, *matrices, *width)


def packed(matrix: Any, lower: int, upper: int) -> FloatArray:
    """Return a sparse matrix by its diagonals, shape (lower + upper + 1, n)."""
    entries = coo_array(matrix)
    diagonals = np.zeros((lower + upper + 1, matrix.shape[0]))
    diagonals[upper + entries.row - entries.col, entries.col] = entries.data
    return diagonals


def is_sparse(matrix: Any) -> bool:
    """Tell whether a matrix is a sparse one of SciPy's."""
    return bool(issparse(matrix))


def _factors(matrix: Any, order: Any) -> Any:
    """Return the factors of a sparse matrix whose columns SuperLU orders."""
    return splu(matrix, permc_spec=order, diag_pivot_thresh=PIVOT)
