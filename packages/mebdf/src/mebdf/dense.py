"""The solution between the ends of a step of the solver class for SciPy."""

from typing import Final

import numpy as np
from scipy.integrate import DenseOutput

from mebdf.arrays import FloatArray

#: Length of a jump: SciPy's search for events ends at intervals a quarter as long.
JUMP: Final = 16.0 * float(np.finfo(np.float64).eps)
MOST: Final = 1e-4  #: Length of a jump, at most, as a share of the time to the next breakpoint.


class MebdfDenseOutput(DenseOutput):
    """Newton's polynomial through the newest value and the differences of the last accepted step.

    ``t_old``, ``t``: begin and end of the step; ``step``: signed size to which the differences belong;
    ``differences``: at the end of the step, shape (degree + 1, n); they are copied.
    """

    def __init__(self, t_old: float, t: float, step: float, differences: FloatArray) -> None:
        super().__init__(t_old, t)
        self._step, self._differences = step, differences.copy()

    def _call_impl(self, t: FloatArray) -> FloatArray:
        """Return the solution at ``t``, shape (n,) or (n, number of times)."""
        s = (t - self.t) / self._step
        weight = np.ones_like(s)
        weights = [weight]
        for m in range(1, len(self._differences)):
            weight = weight * (s + m - 1.0) / m
            weights.append(weight)
        y: FloatArray = np.tensordot(self._differences, np.array(weights), axes=(0, 0))
        return y


def end_of_jump(t: float, t_end: float) -> float:
    """Return the end of a step that is a jump: far enough for SciPy to locate events, if there is room."""
    length = min(JUMP * (1.0 + abs(t)), MOST * abs(t_end - t))
    end = t + float(np.copysign(length, t_end - t))
    return end if end != t else float(np.nextafter(t, t_end))


class JumpDenseOutput(DenseOutput):
    """A jump of algebraic variables, as a step that is short beside all others.

    SciPy locates events by single times and needs the values before the jump at the beginning of the step,
    where it has seen them. Arrays of times are output times: they get the values behind the jump.

    ``t_old``, ``t``: begin and end of the step; ``before``, ``after``: values, shape (n,) each.
    """

    def __init__(self, t_old: float, t: float, before: FloatArray, after: FloatArray) -> None:
        super().__init__(t_old, t)
        self._before, self._after = before, after

    def _call_impl(self, t: FloatArray) -> FloatArray:
        """Return the values at ``t``, shape (n,) or (n, number of times)."""
        if t.ndim == 0 and (t == self.t_old or abs(t - self.t_old) < 0.5 * abs(self.t - self.t_old)):
            return self._before.copy()
        return np.multiply.outer(self._after, np.ones_like(t))
