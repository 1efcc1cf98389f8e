"""The protocol between the driver and a method that advances one step at a time.

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

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol, TypeAlias

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Statistics

VectorFunction: TypeAlias = Callable[[float, FloatArray], FloatArray]
"""``fun(t, y)``: a new array, (n,) for a right-hand side, (n, n) for a Jacobian."""

Interpolant: TypeAlias = Callable[[float], FloatArray]
"""``interpolate(t)``: the state (n,) at a time inside the step it belongs to."""


class Step(NamedTuple):
    """An accepted step.

    Attributes
    ----------
    t_old, t
        Begin and end [s].
    y
        State at the end, shape (n,).
    interpolate
        The solution inside the step.
    """

    t_old: float
    t: float
    y: FloatArray
    interpolate: Interpolant


class Segment(NamedTuple):
    """A plain initial value problem.

    Attributes
    ----------
    rhs, jac
        Right-hand side and its Jacobian; both return a new array at each call.
    t_start
        Begin [s].
    y_start
        State there, shape (n,).
    t_end
        End [s], after ``t_start``.
    rtol
        Relative tolerance.
    atol
        Absolute tolerance of each state, shape (n,).
    statistics
        Where LU decompositions and rejected steps are added.
    longest
        Length that no step exceeds [s].
    """

    rhs: VectorFunction
    jac: VectorFunction
    t_start: float
    y_start: FloatArray
    t_end: float
    rtol: float
    atol: FloatArray
    statistics: Statistics
    longest: float = math.inf


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
