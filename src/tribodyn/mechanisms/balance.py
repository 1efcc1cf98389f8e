"""Balance of the loads on a shaft: Newton's method for rough contact."""

from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.problem import ask
from tribodyn.kernels import dense

#: A step passes less than σ, and the way through the widest clearances is some hundreds of that.
_MAX_ITERATIONS: Final = 4000
_CONVERGED: Final = 1.0e-13  #: Length of a step that changes nothing any more [m].

#: Returns the generalised loads at an attitude, shape (n,), and their derivative, shape (n, n).
Residual: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]


def damped_newton(
    residual: Residual, start: FloatArray, scale: FloatArray, longest: float
) -> FloatArray | None:
    """Solve residual = 0 by Newton's method with bounded steps and a line search.

    The stiffness of rough contact changes by e every third of σ, so a step may not pass much more.

    ``residual``: loads and their derivative, see :data:`Residual`; ``start``: first guess, shape (n,);
    ``scale``: size of a unit of each unknown as a length of one metre counts, shape (n,); ``longest``:
    longest step [m]. Returns the solution, or None where the iteration does not settle. Raises Stopped if the
    caller wanted to stop before the end.
    """
    q = start.copy()
    load, jacobian = residual(q)
    size = float(dense.norm(load * scale))
    for _ in range(_MAX_ITERATIONS):
        ask()
        # A little stiffness where there is none lets the shaft move to where there is some.
        floor = 1.0e-6 * np.abs(jacobian[:2, :2]).max(initial=1.0)
        damped = jacobian - np.diag(floor / scale**2)
        step = np.asarray(dense.solve(damped, -load), dtype=np.float64)
        length = float(np.abs(step / scale).max())
        if not np.isfinite(length):
            return None
        step *= min(1.0, longest / length) if length > 0.0 else 1.0
        q, load, jacobian, size = _line_search(residual, q, step, size, scale)
        if length < _CONVERGED:
            return q
    return None


def _line_search(
    residual: Residual, q: FloatArray, step: FloatArray, size: float, scale: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Halve the step up to five times until the residual is smaller than ``size``; then take it all the same.

    Return the end of the step with the loads there, their derivative and their size.
    """
    share = 1.0
    for _ in range(5):
        trial, gradient = residual(q + share * step)
        reached = float(dense.norm(trial * scale))
        if reached < size:
            break
        share *= 0.5
    return q + share * step, trial, gradient, reached
