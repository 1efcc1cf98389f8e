"""The protocol of a method that advances one step at a time, and a problem as its plain functions.

A method sees a plain initial value problem without memory, breakpoints or output times:
everything in :mod:`tribodyn.core.problem` that is more than that is the driver's. To add
a method, write one file with a class that has ``steps``, and one line in ``SOLVERS``.

The rules of a method
---------------------
1. ``steps`` yields every accepted step once, in order, and ends when ``t_end`` is reached.
   The last step ends at ``t_end`` exactly.
2. ``Step.interpolate`` is valid until the next step is asked for and not after, so a
   method may keep the interpolant in its own workspace.
3. ``Step.y`` and what ``interpolate`` returns are contiguous arrays of 64-bit floats that
   the method does not change afterwards.
4. Between two steps the driver may change what ``rhs`` computes (the memory of the
   problem changes when a step is accepted). A method may go on with old derivatives in
   its history; it must not rely on them for more than its accuracy.
5. A method that cannot go on raises :class:`~tribodyn.core.errors.IntegrationFailure`.
6. Evaluations are counted by the functions handed in; a method adds to ``statistics``
   only what it alone knows, the rejected steps and the LU decompositions.
"""

import math
from collections.abc import Callable, Iterator
from math import isfinite
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import CompiledFunctions, Problem, Statistics

#: ``fun(t, y)``: a new array, (n,) for a right-hand side, (n, n) for a Jacobian.
VectorFunction: TypeAlias = Callable[[float, FloatArray], FloatArray]

#: ``interpolate(t)``: the state (n,) at a time inside the step it belongs to.
Interpolant: TypeAlias = Callable[[float], FloatArray]


class Step(NamedTuple):
    """An accepted step."""

    #: Begin and end [s].
    t_old: float
    t: float
    y: FloatArray  #: State at the end, shape (n,).
    interpolate: Interpolant  #: The solution inside the step.


class Segment(NamedTuple):
    """A plain initial value problem."""

    #: Right-hand side and its Jacobian; both return a new array at each call.
    rhs: VectorFunction
    jac: VectorFunction
    t_start: float  #: Begin [s].
    y_start: FloatArray  #: State there, shape (n,).
    t_end: float  #: End [s], after ``t_start``.
    rtol: float  #: Relative tolerance.
    atol: FloatArray  #: Absolute tolerance of each state, shape (n,).
    statistics: Statistics  #: Where LU decompositions and rejected steps are added.
    longest: float = math.inf  #: Length that no step exceeds [s].


class Method(Protocol):
    """A method that advances an initial value problem step by step."""

    def prepare(self) -> None:
        """Import the packages of the method; raise ``InputError`` if one is not installed.

        Called once before a run, so that neither the time of the import is counted as
        integration nor the memory of a problem changed by a run that cannot begin.
        """
        ...

    def steps(self, segment: Segment) -> Iterator[Step]:
        """Yield the accepted steps from the begin to the end of a segment."""
        ...


def all_finite(values: FloatArray) -> bool:
    """Tell whether no number is infinite or nan; for few numbers faster than NumPy, and without warnings."""
    return isfinite(sum(values.tolist()))


class Binding:
    """Right-hand side and Jacobian of a problem, counted and watched for numbers that are not finite.

    A trial state of Newton's iteration may lie where the model is not defined. The right-hand
    side then hands the NaN to the method, which shortens its step; what happened is
    remembered for the message if it cannot recover. The Jacobian only steers that iteration,
    so the last finite one is as good there.

    ``problem``: the problem; its memory is read at each call; ``statistics``: where evaluations are counted.
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
