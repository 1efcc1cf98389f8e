"""Methods of other packages under our rules: BDF, Radau and LSODA of SciPy, CVODE of SUNDIALS.

BDF: backward differentiation formulae of variable order 1 to 5, quasi-constant step; L. F. Shampine, M. W.
Reichelt, The MATLAB ODE suite, SIAM J. Sci. Comput. 18 (1997) 1-22. Radau: implicit Runge-Kutta method Radau
IIA of order 5; E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer 1996, IV.8. LSODA:
Adams and backward differentiation formulae, switched by stiffness; L. Petzold, Automatic selection of methods
for solving stiff and nonstiff systems of ordinary differential equations, SIAM J. Sci. Stat. Comput. 4 (1983)
136-148.
"""

import importlib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.integrate.base import Interpolant, Segment, Step, VectorFunction


@dataclass(frozen=True)
class ScipyMethod:
    """A solver class of ``scipy.integrate``."""

    class_name: str  #: Name of a subclass of ``scipy.integrate.OdeSolver`` that accepts ``jac``.
    #: Makes of a solver the function that gives the state inside its last step. What
    #: ``solver.dense_output()`` returns does the same; its checks take as long as two to four right-hand
    #: sides of a mechanism.
    interpolant: Callable[[Any], Interpolant]
    #: Called with the solver before each step but the first: the memory of the problem may have changed the
    #: right-hand side since the step before.
    resume: Callable[[Any], None] | None = None

    def prepare(self) -> None:
        """Import SciPy, which reading a case does not need."""
        self._solver_class()

    def steps(self, segment: Segment) -> Iterator[Step]:
        """Yield the accepted steps, see :class:`tribodyn.integrate.base.Method`."""
        rhs, jac, t_start, y_start, t_end, rtol, atol, statistics, longest = segment
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
    """Step; what SciPy would warn of appears as the failure it leads to."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        message: str | None = solver.step()
    return message and "the step became shorter than the spacing between numbers"


def _inside_bdf(solver: Any) -> Interpolant:
    """Evaluate Newton's polynomial on the backward differences ``D`` of the method.

    ``y(t) = sum_j D_j prod_{m<j} (t - t_n + m h) / ((m + 1) h)``, with ``h`` the step to be
    tried next: the method rescales ``D`` to it as soon as a step is accepted.
    """

    def interpolate(t: float) -> FloatArray:
        x = (t - solver.t) / (solver.h_abs * solver.direction)
        weights = [1.0]
        for m in range(solver.order):
            weights.append(weights[-1] * (x + m) / (m + 1))
        y: FloatArray = np.array(weights) @ solver.D[: len(weights)]
        return y

    return interpolate


BDF = ScipyMethod("BDF", _inside_bdf)


def _inside_radau(solver: Any) -> Interpolant:
    """Evaluate the collocation polynomial ``y(t) = y_old + Q (x, x², x³)``, ``x = (t - t_old) / h``."""

    def interpolate(t: float) -> FloatArray:
        polynomial = solver.sol
        x = (t - polynomial.t_old) / polynomial.h
        y: FloatArray = polynomial.y_old + polynomial.Q @ np.array((x, x * x, x * x * x))
        return y

    return interpolate


def _renew_rate(solver: Any) -> None:
    """Renew the derivative at the start of the step.

    It is part of the error estimate. Left as it was before the memory of a contact changed,
    it doubled the number of steps of an oscillator whose damping jumps at accepted steps.
    """
    solver.f = solver.fun(solver.t, solver.y)


RADAU = ScipyMethod("Radau", _inside_radau, _renew_rate)


def _inside_lsoda(solver: Any) -> Interpolant:
    """Evaluate Nordsieck's polynomial; its place inside LSODA differs between versions of SciPy."""

    def interpolate(t: float) -> FloatArray:
        y: FloatArray = solver.dense_output()(t)
        return y

    return interpolate


LSODA = ScipyMethod("LSODA", _inside_lsoda)


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
