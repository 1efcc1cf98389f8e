"""Radau of SciPy: the implicit Runge-Kutta method Radau IIA of order 5.

Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer 1996, IV.8.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.integrate.base import Interpolant
from tribodyn.integrate.scipy_steps import ScipyMethod


def interpolant(solver: Any) -> Interpolant:
    """Evaluate the collocation polynomial ``y(t) = y_old + Q (x, x², x³)``, ``x = (t - t_old) / h``."""

    def interpolate(t: float) -> FloatArray:
        polynomial = solver.sol
        x = (t - polynomial.t_old) / polynomial.h
        y: FloatArray = polynomial.y_old + polynomial.Q @ np.array((x, x * x, x * x * x))
        return y

    return interpolate


def resume(solver: Any) -> None:
    """Renew the derivative at the start of the step.

    It is part of the error estimate. Left as it was before the memory of a contact changed,
    it doubled the number of steps of an oscillator whose damping jumps at accepted steps.
    """
    solver.f = solver.fun(solver.t, solver.y)


RADAU = ScipyMethod("Radau", interpolant, resume)
