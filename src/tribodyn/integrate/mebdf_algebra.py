"""Newton matrices of the solver class that are too large for the compiled core: LAPACK and SuperLU."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Protocol

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import coo_array, csc_array, eye_array, issparse
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
        """Prepare solutions with 1 − ``scaled`` J; return whether it is regular."""
        ...

    def solve(self, residual: FloatArray) -> FloatArray:
        """Return the solution for a right-hand side, shape (n,)."""
        ...

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """Return |y_i| + |scaled| Σ_j |J_ij y_j|, shape (n,)."""
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
    n
        Number of equations.
    """

    def __init__(self, jacobian: Evaluation, n: int) -> None:
        self._jacobian = jacobian
        self._n = n
        self._newest: Any = None
        self._matrix: Any = None
        self._factors: Any = None

    def linearise(self, t: float, y: FloatArray) -> bool:
        """See :class:`Algebra`."""
        self._newest = self._jacobian(t, y)
        newest = self._newest
        finite = bool(np.isfinite(newest.data if is_sparse(newest) else newest).all())
        if finite:
            self._matrix = self._newest
        return finite


class Full(_Kept):
    """LU decomposition of LAPACK."""

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        matrix = np.asfortranarray(-scaled * self._matrix)
        matrix[np.diag_indices(self._n)] += 1.0
        *self._factors, singular = lapack.dgetrf(matrix, overwrite_a=True)
        return bool(singular == 0)

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        solution: FloatArray = lapack.dgetrs(*self._factors, residual)[0]
        return solution

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        product: FloatArray = np.abs(self._matrix) @ np.abs(y)
        return np.abs(y) + abs(scaled) * product

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        row, column = np.argwhere(~np.isfinite(self._newest))[0]
        return int(row), int(column)


class Banded(_Kept):
    """Banded LU decomposition of LAPACK; rows of the Jacobian are diagonals, ``packed[i - j + upper, j]``.

    Parameters
    ----------
    jacobian, n
        ``jacobian(t, y)``, packed, shape (lower + upper + 1, n).
    lower, upper
        Numbers of diagonals below and above the main one.
    """

    def __init__(self, jacobian: Evaluation, n: int, lower: int, upper: int) -> None:
        super().__init__(jacobian, n)
        self._lower, self._upper = lower, upper
        row: Any = np.arange(n) - upper + np.arange(lower + upper + 1)[:, None]
        self._row = row
        self._inside = (row >= 0) & (row < n)

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        work = np.zeros((2 * self._lower + self._upper + 1, self._n), order="F")
        work[self._lower :] = np.where(self._inside, -scaled * self._matrix, 0.0)
        work[self._lower + self._upper] += 1.0
        *self._factors, singular = lapack.dgbtrf(work, self._lower, self._upper, overwrite_ab=True)
        return bool(singular == 0)

    def solve(self, residual: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        factors, pivots = self._factors
        solution: FloatArray = lapack.dgbtrs(factors, self._lower, self._upper, residual, pivots)[0]
        return solution

    def magnitude(self, scaled: float, y: FloatArray) -> FloatArray:
        """See :class:`Algebra`."""
        terms = np.abs(self._matrix * y)[self._inside]
        sums: Any = np.bincount(self._row[self._inside], weights=terms, minlength=self._n)
        magnitude: FloatArray = np.abs(y) + abs(scaled) * sums
        return magnitude

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        diagonal, column = np.argwhere(~np.isfinite(self._newest))[0]
        return int(self._row[diagonal, column]), int(column)


class Sparse(_Kept):
    """SuperLU; the Jacobian is a sparse matrix in compressed columns."""

    def __init__(self, jacobian: Evaluation, n: int) -> None:
        super().__init__(jacobian, n)
        self._unit = csc_array(eye_array(n))
        self._order = ""

    def factorise(self, scaled: float) -> bool:
        """See :class:`Algebra`."""
        matrix = csc_array(self._unit - scaled * self._matrix)
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
        product: FloatArray = abs(self._matrix) @ np.abs(y)
        return np.abs(y) + abs(scaled) * product

    def entry_not_finite(self) -> tuple[int, int]:
        """See :class:`Algebra`."""
        entries = coo_array(self._newest)
        first = int(np.argmax(~np.isfinite(entries.data)))
        return int(entries.row[first]), int(entries.col[first])


def is_sparse(matrix: Any) -> bool:
    """Tell whether a matrix is a sparse one of SciPy's."""
    return bool(issparse(matrix))


def _factors(matrix: Any, order: Any) -> Any:
    """Return the factors of a sparse matrix whose columns SuperLU orders."""
    return splu(matrix, permc_spec=order, diag_pivot_thresh=PIVOT)
