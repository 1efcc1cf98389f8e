"""The Jacobian of the solver class for SciPy: given, constant or from differences, and who solves with it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from scipy.integrate import OdeSolver
from scipy.integrate._ivp.common import num_jac
from scipy.optimize._numdiff import group_columns
from scipy.sparse import coo_array, csc_array, csc_matrix, diags_array

from tribodyn.core.arrays import FloatArray
from tribodyn.integrate.mebdf_algebra import Algebra, Banded, Full, Sparse, is_sparse
from tribodyn.integrate.mebdf_doubt import Doubted

LARGEST_IN_CORE: Final = 64
"""Number of equations up to which the compiled core solves: its decomposition is a plain loop."""
NARROW: Final = 4.0
"""Diagonals of a banded decomposition over entries a column up to which it is the faster one."""

Jacobian = Callable[[float, FloatArray], Any]
Bands = tuple[int, int]


def make_jacobian(
    solver: OdeSolver,
    jac: Any,
    sparsity: Any,
    bands: Bands | None,
    threshold: FloatArray,
    in_trouble: Callable[[], bool],
) -> tuple[Jacobian, Algebra | None]:
    """Return ``jacobian(t, y)`` of shape (n, n), and who solves with it instead of the compiled core.

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
    threshold
        Size of each component below which the difference no longer shrinks with it, shape (n,).
    in_trouble
        Tells whether a Jacobian that was given should be compared with the right-hand side.
    """
    n = solver.n

    def watched(given: Jacobian) -> Jacobian:
        differences = _differences(solver, None, threshold)
        return Doubted(given, differences, solver.fun_single, threshold, in_trouble)

    if bands is not None and sparsity is not None:
        raise ValueError("Give either `jac_sparsity` or `lband` and `uband`.")
    if jac is None:
        pattern = _pattern(sparsity, bands, n)
        evaluate = _differences(solver, pattern, threshold)
        if pattern is None or n <= LARGEST_IN_CORE:
            return _chosen(lambda t, y: _dense(evaluate(t, y)), n)
        width = bands or _bands(pattern)
        if bands is None and 2 * width[0] + width[1] + 1 > NARROW * pattern.nnz / n:
            return evaluate, Sparse(evaluate, n)
        return evaluate, Banded(lambda t, y: _packed(evaluate(t, y), width), n, *width)
    given = jac if callable(jac) else _Constant(jac)
    if bands is not None:
        evaluate = _checked(given, (bands[0] + bands[1] + 1, n))
        if n <= LARGEST_IN_CORE:
            return watched(lambda t, y: _unpacked(evaluate(t, y), bands)), None
        return evaluate, Banded(evaluate, n, *bands)
    evaluate = _checked(given, (n, n))
    if n <= LARGEST_IN_CORE:
        return watched(lambda t, y: _dense(evaluate(t, y))), None
    evaluate = _Remembered(evaluate, float(solver.t), solver.y.copy())
    if is_sparse(evaluate.first):
        return evaluate, Sparse(evaluate, n)
    return _chosen(lambda t, y: _dense(evaluate(t, y)), n)


def _chosen(jacobian: Jacobian, n: int) -> tuple[Jacobian, Algebra | None]:
    """Return a dense Jacobian, and who solves with it."""
    return jacobian, None if n <= LARGEST_IN_CORE else Full(jacobian, n)


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
        matrix: Any = (
            csc_array(value, dtype=np.float64) if is_sparse(value) else np.asarray(value, np.float64)
        )
        if matrix.shape != shape:
            raise ValueError(f"`jac` is expected to have shape {shape}, but actually has {matrix.shape}.")
        return matrix

    return jacobian


def _dense(matrix: Any) -> FloatArray:
    """Return what may be a sparse matrix as a dense one."""
    dense: FloatArray = matrix.toarray() if is_sparse(matrix) else np.asarray(matrix)
    return dense


def _pattern(sparsity: Any, bands: Bands | None, n: int) -> Any:
    """Return where the Jacobian may differ from zero; ``None`` for everywhere."""
    if bands is not None:
        offsets = range(-min(bands[0], n - 1), min(bands[1], n - 1) + 1)
        ones: Any = [np.ones(n - abs(k)) for k in offsets]
        return csc_matrix(diags_array(ones, offsets=list(offsets)))
    if sparsity is None:
        return None
    pattern = csc_matrix(sparsity)
    if pattern.shape != (n, n):
        raise ValueError(
            f"`jac_sparsity` is expected to have shape {(n, n)}, but actually has {pattern.shape}."
        )
    return pattern


def _bands(pattern: Any) -> Bands:
    """Return how many diagonals below and above the main one are not empty."""
    entries = coo_array(pattern)
    below = entries.row.astype(np.int64) - entries.col
    return max(int(below.max(initial=0)), 0), max(int(-below.min(initial=0)), 0)


def _packed(matrix: Any, bands: Bands) -> FloatArray:
    """Return a sparse matrix by its diagonals."""
    entries = coo_array(matrix)
    packed = np.zeros((bands[0] + bands[1] + 1, matrix.shape[0]))
    packed[bands[1] + entries.row - entries.col, entries.col] = entries.data
    return packed


def _unpacked(packed: FloatArray, bands: Bands) -> FloatArray:
    """Return the dense matrix with these diagonals."""
    n = packed.shape[1]
    row = np.arange(n) - bands[1] + np.arange(len(packed))[:, None]
    inside = (row >= 0) & (row < n)
    dense = np.zeros((n, n))
    dense[row[inside], np.broadcast_to(np.arange(n), row.shape)[inside]] = packed[inside]
    return dense


def _differences(solver: OdeSolver, pattern: Any, threshold: FloatArray) -> Jacobian:
    """Return the Jacobian by the finite differences of SciPy's own solvers."""
    difference: Any = num_jac
    factor: FloatArray | None = None
    grouped: Any = None if pattern is None else (pattern, group_columns(pattern))

    def jacobian(t: float, y: FloatArray) -> Any:
        nonlocal factor
        f = solver.fun_single(t, y)
        matrix, factor = difference(solver.fun_vectorized, t, y, f, threshold, factor, grouped)
        return matrix

    return jacobian
