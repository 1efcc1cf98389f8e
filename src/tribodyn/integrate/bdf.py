"""BDF of SciPy: backward differentiation formulae of variable order 1 to 5, quasi-constant step.

Source: L. F. Shampine, M. W. Reichelt, The MATLAB ODE suite, SIAM J. Sci. Comput. 18 (1997) 1-22.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.integrate.base import Interpolant
from tribodyn.integrate.scipy_steps import ScipyMethod


def interpolant(solver: Any) -> Interpolant:
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


BDF = ScipyMethod("BDF", interpolant)
