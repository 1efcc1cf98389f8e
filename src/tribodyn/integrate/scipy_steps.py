"""Stepping a solver class of ``scipy.integrate`` under the rules of a method."""

from __future__ import annotations

import importlib
import math
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Statistics
from tribodyn.integrate.base import Interpolant, Step, VectorFunction


@dataclass(frozen=True)
class ScipyMethod:
    """A solver class of ``scipy.integrate``.

    Attributes
    ----------
    class_name
        Name of a subclass of ``scipy.integrate.OdeSolver`` that accepts ``jac``.
    interpolant
        Makes of a solver the function that gives the state inside its last step. What
        ``solver.dense_output()`` returns does the same; its checks take as long as two to
        four right-hand sides of a mechanism.
    resume
        Called with the solver before each step but the first: the memory of the problem may
        have changed the right-hand side since the step before.
    """

    class_name: str
    interpolant: Callable[[Any], Interpolant]
    resume: Callable[[Any], None] | None = None

    def prepare(self) -> None:
        """Import SciPy, which reading a case does not need."""
        self._solver_class()

    def steps(
        self,
        rhs: VectorFunction,
        jac: VectorFunction,
        t_start: float,
        y_start: FloatArray,
        t_end: float,
        rtol: float,
        atol: FloatArray,
        statistics: Statistics,
        longest: float = math.inf,
    ) -> Iterator[Step]:
        """Yield the accepted steps, see :class:`tribodyn.integrate.base.Method`."""
        options = {"rtol": rtol, "atol": atol, "jac": jac, "max_step": longest}
        solver = self._solver_class()(rhs, t_start, y_start.copy(), t_end, **options)
        interpolate = self.interpolant(solver)
        decompositions = 0
        while solver.status == "running":
            t_old = float(solver.t)
            if self.resume is not None and t_old > t_start:
                self.resume(solver)
            message = _step_quietly(solver)
            statistics.lu_decompositions += int(solver.nlu) - decompositions
            decompositions = int(solver.nlu)
            if message is not None or not solver.t > t_old:  # LSODA goes on at a time of NaN
                raise IntegrationFailure(t_old, message or "the method made no progress")
            yield Step(t_old, float(solver.t), np.ascontiguousarray(solver.y), interpolate)

    def _solver_class(self) -> Any:
        """Return the class of SciPy."""
        return getattr(importlib.import_module("scipy.integrate"), self.class_name)


def _step_quietly(solver: Any) -> str | None:
    """Step; what SciPy would warn of is told by the failure it leads to."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        message: str | None = solver.step()
    return message and "the step became shorter than the spacing between numbers"
