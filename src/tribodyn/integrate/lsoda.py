"""LSODA of SciPy: Adams and backward differentiation formulae, switched by stiffness.

Source: L. Petzold, Automatic selection of methods for solving stiff and nonstiff systems
of ordinary differential equations, SIAM J. Sci. Stat. Comput. 4 (1983) 136-148.
"""

from __future__ import annotations

from typing import Any

from tribodyn.core.arrays import FloatArray
from tribodyn.integrate.base import Interpolant
from tribodyn.integrate.scipy_steps import ScipyMethod


def interpolant(solver: Any) -> Interpolant:
    """Evaluate Nordsieck's polynomial; its place inside LSODA differs between versions of SciPy."""

    def interpolate(t: float) -> FloatArray:
        y: FloatArray = solver.dense_output()(t)
        return y

    return interpolate


LSODA = ScipyMethod("LSODA", interpolant)
