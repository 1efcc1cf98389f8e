"""The Jacobian of a solver class of SciPy: given, constant or from differences."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import OdeSolver
from scipy.integrate._ivp.common import num_jac
from scipy.optimize._numdiff import group_columns
from scipy.sparse import csc_matrix

from tribodyn.core.arrays import FloatArray

Jacobian = Callable[[float, FloatArray], FloatArray]


def make_jacobian(solver: OdeSolver, jac: Any, sparsity: Any, threshold: FloatArray) -> Jacobian:
    """Return ``jacobian(t, y)`` of shape (n, n); a wrong shape is refused here where it can be seen.

    Parameters
    ----------
    solver
        Whose right-hand side is differenced; its evaluations for that are not counted, as in SciPy.
    jac
        Callable, matrix or ``None``.
    sparsity
        Where the differences may not be zero, shape (n, n), or ``None``.
    threshold
        Size of each component below which the difference no longer shrinks with it, shape (n,).
    """
    if jac is None:
        return _differences(solver, sparsity, threshold)
    if callable(jac):
        return lambda t, y: _checked(jac(t, y.copy()), solver.n)
    constant = _checked(jac, solver.n)
    return lambda t, y: constant


def _checked(matrix: Any, n: int) -> FloatArray:
    """Return a dense matrix of shape (n, n)."""
    dense: FloatArray = np.asarray(_dense(matrix), dtype=np.float64)
    if dense.shape != (n, n):
        raise ValueError(f"`jac` is expected to have shape {(n, n)}, but actually has {dense.shape}.")
    return dense


def _dense(matrix: Any) -> Any:
    """Return what may be a sparse matrix as a dense one."""
    return matrix.toarray() if hasattr(matrix, "toarray") else matrix


def _differences(solver: OdeSolver, sparsity: Any, threshold: FloatArray) -> Jacobian:
    """Return the Jacobian by the finite differences of SciPy's own solvers."""
    difference: Any = num_jac
    factor: FloatArray | None = None
    pattern: Any = None
    if sparsity is not None:
        structure = csc_matrix(sparsity)
        pattern = (structure, group_columns(structure))

    def jacobian(t: float, y: FloatArray) -> FloatArray:
        nonlocal factor
        f = solver.fun_single(t, y)
        matrix, factor = difference(solver.fun_vectorized, t, y, f, threshold, factor, pattern)
        return np.asarray(_dense(matrix))

    return jacobian
