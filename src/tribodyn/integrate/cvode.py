"""CVODE of SUNDIALS: variable-order BDF in compiled code, through the package scikit-sundae.

Source: A. C. Hindmarsh et al., SUNDIALS: Suite of nonlinear and differential/algebraic
equation solvers, ACM Trans. Math. Softw. 31 (2005) 363-396.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.integrate.base import Segment, Step, VectorFunction


class Cvode:
    """CVODE with its BDF formulae, Newton's iteration and a dense matrix."""

    def prepare(self) -> None:
        """Import scikit-sundae."""
        _cvode_class()

    def steps(self, segment: Segment) -> Iterator[Step]:
        """Yield the accepted steps, see :class:`tribodyn.integrate.base.Method`.

        LU decompositions and rejected steps are not reported by scikit-sundae.
        """
        # Without a least step CVODE goes on, printing warnings, when its steps no longer change t.
        t_old, t_end = segment.t_start, segment.t_end
        least = 4.0 * float(np.spacing(max(abs(t_old), abs(t_end))))
        functions = {"rhsfn": _filling(segment.rhs), "jacfn": _filling_matrix(segment.jac)}
        bounds = {"min_step": least, "max_step": min(segment.longest, t_end - t_old)}
        solver = _cvode_class()(**functions, **bounds, rtol=segment.rtol, atol=segment.atol)
        solver.init_step(t_old, segment.y_start)

        def interpolate(t: float) -> FloatArray:
            y: FloatArray = solver.step(t, "normal", None).y
            return y

        while t_old < t_end:
            result = solver.step(t_end, "onestep", t_end)
            if result.success and result.t == t_old:
                # After an interpolation CVODE returns to the end of the step before it goes on.
                result = solver.step(t_end, "onestep", t_end)
            if not result.success or not result.t > t_old:
                raise IntegrationFailure(t_old, result.message)
            yield Step(t_old, result.t, result.y, interpolate)
            t_old = result.t


def _cvode_class() -> Any:
    """Return the class of scikit-sundae, or say how to install it."""
    try:
        return importlib.import_module("sksundae.cvode").CVODE
    except ImportError as error:
        raise InputError(
            "the solver 'cvode' needs the package scikit-sundae: install tribodyn[sundials], "
            "or choose another solver",
            key="solver.name",
        ) from error


def _filling(rhs: VectorFunction) -> Any:
    """Return ``rhs`` in the form CVODE calls."""

    def rhsfn(t: float, y: FloatArray, yp: FloatArray) -> None:
        yp[:] = rhs(t, y)

    return rhsfn


def _filling_matrix(jac: VectorFunction) -> Any:
    """Return ``jac`` in the form CVODE calls."""

    def jacfn(t: float, y: FloatArray, yp: FloatArray, jacobian: FloatArray) -> None:
        jacobian[:] = jac(t, y)

    return jacfn


CVODE = Cvode()
