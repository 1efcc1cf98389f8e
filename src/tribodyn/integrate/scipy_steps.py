"""Stepping a solver class of ``scipy.integrate`` under the rules of a method."""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Statistics
from tribodyn.integrate.base import Step, VectorFunction


@dataclass(frozen=True)
class ScipyMethod:
    """A solver class of ``scipy.integrate``, for instance ``"BDF"``.

    SciPy is imported when the first step is asked for: reading a case needs no solver.

    Attributes
    ----------
    class_name
        Name of a subclass of ``scipy.integrate.OdeSolver`` that accepts ``jac``.
    """

    class_name: str

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
    ) -> Iterator[Step]:
        """Yield the accepted steps, see :class:`tribodyn.integrate.base.Method`."""
        solver_class = getattr(importlib.import_module("scipy.integrate"), self.class_name)
        solver = solver_class(rhs, t_start, y_start.copy(), t_end, rtol=rtol, atol=atol, jac=jac)
        decompositions = 0
        while solver.status == "running":
            t_old = float(solver.t)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # what LSODA warns of is told in the failure
                message = solver.step()
            statistics.lu_decompositions += int(solver.nlu) - decompositions
            decompositions = int(solver.nlu)
            if message is not None:
                raise IntegrationFailure(t_old, message)
            yield Step(t_old, float(solver.t), np.ascontiguousarray(solver.y), solver.dense_output())
