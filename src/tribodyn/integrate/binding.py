"""A problem as the plain functions of time and state that methods call."""

from __future__ import annotations

from math import isfinite
from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics


def all_finite(values: FloatArray) -> bool:
    """Tell whether no number is infinite or nan; for few numbers faster than NumPy, and without warnings."""
    return isfinite(sum(values.tolist()))


class Binding:
    """Right-hand side and Jacobian of a problem, counted and watched for numbers that are not finite.

    A trial state of Newton's iteration may lie where the model is not defined. The right-hand
    side then hands the NaN to the method, which shortens its step; what happened is
    remembered for the message if it cannot recover. The Jacobian only steers that iteration,
    so the last finite one is as good there.

    Parameters
    ----------
    problem
        The problem; its memory is read at each call.
    functions
        Its functions.
    statistics
        Where evaluations are counted.
    """

    def __init__(self, problem: Problem, functions: CompiledFunctions, statistics: Statistics) -> None:
        self._rhs = functions.rhs
        self._jac = functions.jac
        self._data = problem.data
        self._memory = problem.memory
        self._names = problem.state_names
        self._n = problem.y0.size
        self._places = None if problem.algebra is None else problem.algebra.places
        self._last_jacobian: FloatArray | None = None
        self._statistics = statistics
        self.note = ""

    def rhs(self, t: float, y: FloatArray) -> FloatArray:
        """Return dy/dt, a new array of shape (n,)."""
        self._statistics.rhs_evaluations += 1
        f = np.empty(self._n)
        y = np.require(y, requirements=["C", "A", "W"])  # what some integrators give must not be written to
        self._rhs(t, y, self._data, self._memory, f)
        if not all_finite(f):
            self.note = f"rate of {self.first_not_finite(f)} was not finite at t = {t:.9g} s"
        return f

    def jac(self, t: float, y: FloatArray) -> FloatArray:
        """Return the Jacobian of the right-hand side, a new array of shape (n, n)."""
        jacobian = self._filled(t, y)
        if self._places is not None:
            entries, jacobian = jacobian, np.zeros((self._n, self._n))
            np.add.at(jacobian, tuple(self._places), entries)
        if np.isfinite(jacobian).all():
            self._last_jacobian = jacobian
        elif self._last_jacobian is None:
            row, column = np.argwhere(~np.isfinite(jacobian))[0]
            entry = f"d(rate of {self._names[row]})/d({self._names[column]})"
            raise IntegrationFailure(t, f"the Jacobian entry {entry} is not finite")
        return self._last_jacobian.copy()

    def sparse_jac(self, t: float, y: FloatArray) -> Any:
        """Return the Jacobian in compressed columns, shape (n, n); as it is where it is not finite."""
        from scipy.sparse import coo_array, csc_array

        filled = self._filled(t, y)
        if self._places is None:
            return csc_array(filled)
        return coo_array((filled, tuple(self._places)), shape=(self._n, self._n)).tocsc()

    def _filled(self, t: float, y: FloatArray) -> FloatArray:
        """Return the array that ``jac`` fills: (n, n), or (n_entries,) with an algebra of its own."""
        self._statistics.jacobian_evaluations += 1
        shape = (self._n, self._n) if self._places is None else self._places.shape[1:]
        jacobian, y = np.zeros(shape), np.require(y, requirements=["C", "A", "W"])
        self._jac(t, y, self._data, self._memory, np.empty(self._n), jacobian)
        return jacobian

    def first_not_finite(self, values: FloatArray) -> str:
        """Return the name of the first state whose value is not finite, empty if all are."""
        bad = np.flatnonzero(~np.isfinite(values))
        return self._names[int(bad[0])] if bad.size else ""

    def reason(self, reason: str) -> str:
        """Add to the reason of a failure what was not finite since the last accepted step."""
        return f"{reason}; the {self.note}" if self.note else reason
