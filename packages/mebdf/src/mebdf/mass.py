"""The mass matrix of the solver class for SciPy: checked, and as the compiled core keeps it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import svd
from scipy.sparse import csr_array, diags_array, eye_array
from scipy.sparse.linalg import LinearOperator, splu

from mebdf.algebra import is_sparse
from mebdf.arrays import FloatArray
from mebdf.kernels.state import Mass

HIGHEST_INDEX: Final = 3
LARGEST: Final = 500  #: Number of equations up to which singular values are taken.


@dataclass(frozen=True)
class MassMatrix:
    """A constant mass matrix and the index of each variable."""

    matrix: Any  #: Compressed rows without zeros, shape (n, n).
    index: NDArray[np.int64]  #: Index of each variable, shape (n,).
    tested: NDArray[np.bool_]  #: Whether a variable is in the error test, shape (n,).

    @cached_property
    def algebraic_equations(self) -> NDArray[np.bool_]:
        """Whether an equation has no derivatives, shape (n,)."""
        empty: NDArray[np.bool_] = np.diff(self.matrix.indptr) == 0
        return empty

    @cached_property
    def algebraic_variables(self) -> NDArray[np.bool_]:
        """Whether a variable has no derivative in any equation, shape (n,)."""
        return algebraic_variables(self.matrix)

    def for_core(self, slope: FloatArray) -> Mass:
        """Return it as the compiled core keeps it, with y' at the start."""
        matrix = self.matrix
        places = np.concatenate((matrix.indptr, matrix.indices)).astype(np.int64)
        return Mass(matrix.data.astype(np.float64), places, slope, self.index, self.tested)


@dataclass(frozen=True)
class Split:
    """Algebraic part of a system with a singular mass matrix."""

    constraints: Any  #: P: combinations of equations without derivatives, shape (m, n), sparse.
    free: Any  #: Z: directions in which M does not hold the state, shape (n, m), sparse.
    slope: Callable[[FloatArray], FloatArray]  #: Returns M⁺ f, the y' of least size for M y' = f.
    along: Callable[[FloatArray], FloatArray]  #: Returns rows times M⁺, shape (m, n) of (m, n).


def split(mass: MassMatrix) -> Split:
    """Split equations and variables; by rows and columns of zeros where that is all."""
    n = mass.matrix.shape[0]
    equations, variables = ~mass.algebraic_equations, ~mass.algebraic_variables
    if np.count_nonzero(equations) == np.count_nonzero(variables):
        try:
            factors: Any = splu(mass.matrix[equations][:, variables].tocsc()) if equations.any() else None
        except RuntimeError:  # singular
            factors = None
        if factors is not None or not equations.any():
            return _by_zeros(factors, equations, variables)
    if n > LARGEST:
        raise ValueError(f"`mass` of more than {LARGEST} equations must be singular by rows of zeros alone.")
    left, values, right = svd(mass.matrix.toarray())
    rank = int(np.count_nonzero(values > n * np.finfo(np.float64).eps * values.max(initial=0.0)))
    inverse = right[:rank].T @ (left[:, :rank] / values[:rank]).T
    constraints, free = csr_array(left[:, rank:].T), csr_array(right[rank:].T)
    return Split(constraints, free, lambda f: inverse @ f, lambda rows: rows @ inverse)


def _by_zeros(factors: Any, equations: NDArray[np.bool_], variables: NDArray[np.bool_]) -> Split:
    """Return the split by rows and columns of zeros; ``factors`` solve with the rest."""

    def slope(f: FloatArray) -> FloatArray:
        y = np.zeros(equations.size)
        if factors is not None:
            y[variables] = factors.solve(f[equations])
        return y

    def along(rows: FloatArray) -> FloatArray:
        product = np.zeros_like(rows)
        if factors is not None:
            product[:, equations] = factors.solve(np.ascontiguousarray(rows[:, variables].T), "T").T
        return product

    unit = csr_array(eye_array(equations.size))
    return Split(unit[~equations], csr_array(unit[:, ~variables]), slope, along)


def algebraic_variables(matrix: Any) -> NDArray[np.bool_]:
    """Return the empty columns of a sparse matrix."""
    used = np.zeros(matrix.shape[1], dtype=bool)
    used[matrix.indices] = True
    return ~used


def read_mass(mass: Any, index: ArrayLike | None, test_algebraic: bool | None, n: int) -> MassMatrix | None:
    """Check a user's mass matrix; ``None`` without one.

    ``mass``: shape (n, n), dense or sparse, or its diagonal, shape (n,); or ``None``; ``index``: index of
    each variable, 1 to 3, shape (n,); ``None`` for 1; ``test_algebraic``: whether algebraic variables are in
    the error test; ``None`` for those of index 1; ``n``: number of equations.
    """
    if mass is None:
        if index is not None or test_algebraic is not None:
            raise ValueError("`index` and `test_algebraic` need a `mass` matrix.")
        return None
    matrix = _matrix(mass, n)
    numbers = np.ones(n, dtype=np.int64) if index is None else _index(index, n)
    return with_index(matrix, numbers, test_algebraic)


def with_index(matrix: Any, index: NDArray[np.int64], test_algebraic: bool | None) -> MassMatrix:
    """Return a mass matrix, in compressed rows without zeros, with the index of each variable."""
    tested = index == 1 if test_algebraic is None else np.full(index.size, test_algebraic)
    return MassMatrix(matrix, index, tested | ~algebraic_variables(matrix))


def _matrix(mass: Any, n: int) -> Any:
    if isinstance(mass, LinearOperator):
        raise ValueError("`mass` is a LinearOperator; give its matrix, dense or sparse: `mass @ np.eye(n)`.")
    if callable(mass):
        raise ValueError(
            "`mass` is a function; it must be a constant matrix, dense or sparse, or its diagonal. For one "
            "that depends on t or y give `fun(t, y, slope)` = M(t, y) @ slope - f(t, y), and `slope`, "
            "y' at the start."
        )
    if np.iscomplexobj(mass.data if is_sparse(mass) else np.asarray(mass)):
        raise ValueError("`mass` must be real.")
    if is_sparse(mass):
        matrix = csr_array(mass, dtype=np.float64)
    else:
        dense = np.asarray(mass, dtype=np.float64)
        matrix = csr_array(diags_array(dense) if dense.ndim == 1 else np.atleast_2d(dense))
    if matrix.shape != (n, n):
        raise ValueError(f"`mass` is expected to have shape {(n, n)} or {(n,)}, not {matrix.shape}.")
    if not np.isfinite(matrix.data).all():
        raise ValueError("`mass` must be finite.")
    matrix.sum_duplicates()
    matrix.eliminate_zeros()
    return matrix


def _index(index: ArrayLike, n: int) -> NDArray[np.int64]:
    numbers = np.asarray(index)
    if numbers.shape != (n,):
        raise ValueError(f"`index` is expected to have shape {(n,)}, not {numbers.shape}.")
    if not np.isin(numbers, range(1, HIGHEST_INDEX + 1)).all():
        raise ValueError(f"`index` must hold whole numbers from 1 to {HIGHEST_INDEX}.")
    return numbers.astype(np.int64)
