"""A problem as the plain functions of time and state that methods call."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Problem, Statistics


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
    statistics
        Where evaluations are counted.
    """

    def __init__(self, problem: Problem, statistics: Statistics) -> None:
        self._rhs = problem.functions.rhs
        self._jac = problem.functions.jac
        self._data = problem.data
        self._memory = problem.memory
        self._names = problem.state_names
        self._n = problem.y0.size
        self._zeros = np.zeros(self._n)
        self._last_jacobian: FloatArray | None = None
        self._statistics = statistics
        self.note = ""

    def rhs(self, t: float, y: FloatArray) -> FloatArray:
        """Return dy/dt, a new array of shape (n,)."""
        self._statistics.rhs_evaluations += 1
        f = np.empty(self._n)
        self._rhs(t, y, self._data, self._memory, f)
        # inf * 0 and nan * 0 are nan: one product tells what isfinite().all() tells, faster.
        if f.dot(self._zeros) != 0.0:
            self.note = f"rate of {self.first_not_finite(f)} was not finite at t = {t:.9g} s"
        return f

    def jac(self, t: float, y: FloatArray) -> FloatArray:
        """Return the Jacobian of the right-hand side, a new array of shape (n, n)."""
        self._statistics.jacobian_evaluations += 1
        f = np.empty(self._n)
        jacobian = np.zeros((self._n, self._n))
        self._jac(t, y, self._data, self._memory, f, jacobian)
        if np.isfinite(jacobian).all():
            self._last_jacobian = jacobian
        elif self._last_jacobian is None:
            row, column = np.argwhere(~np.isfinite(jacobian))[0]
            entry = f"d({self._names[row]} rate)/d({self._names[column]})"
            raise IntegrationFailure(t, f"the Jacobian entry {entry} is not finite")
        return self._last_jacobian.copy()

    def first_not_finite(self, values: FloatArray) -> str:
        """Return the name of the first state whose value is not finite, empty if all are."""
        bad = np.flatnonzero(~np.isfinite(values))
        return self._names[int(bad[0])] if bad.size else ""

    def reason(self, reason: str) -> str:
        """Add to the reason of a failure what was not finite since the last accepted step."""
        return f"{reason}; the {self.note}" if self.note else reason
