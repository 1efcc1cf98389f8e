"""A Jacobian that was given, compared with the right-hand side at the start and where no way is made."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final
from warnings import warn

import numpy as np

from mebdf.arrays import FloatArray

Dense = Callable[[float, FloatArray], FloatArray]

FIRST: Final = 32
"""Evaluation at which it is compared after the start, then at twice as many, and so on: next to no cost."""
CHANGE: Final = 1e-6
"""Relative change of the state along which it is compared."""
WRONG: Final = 0.9
"""Difference of the derivatives, relative to the larger one, of a Jacobian that is wrong, not rough."""
NOISE: Final = 1e-12
"""Difference, relative to the right-hand side, that its rounding may be."""


class CheckedJacobian:
    """The Jacobian given, until it turns out to be wrong; differences from then on.

    Newton's iteration with −J contracts only for steps below a third of the fastest time constant, so
    a wrong sign would cost steps by the ten thousand. One that is too large makes all corrections tiny.

    Parameters
    ----------
    given, differences
        ``jacobian(t, y)`` of shape (n, n).
    fun
        Right-hand side ``fun(t, y)``.
    threshold
        Size of each component below which it is as good as zero, shape (n,).
    in_trouble
        Tells whether steps fail so often that a comparison is worth its three evaluations.
    """

    def __init__(
        self,
        given: Dense,
        differences: Dense,
        fun: Dense,
        threshold: FloatArray,
        in_trouble: Callable[[], bool],
    ) -> None:
        self._jacobian, self._differences = given, differences
        self._fun, self._threshold, self._in_trouble = fun, threshold, in_trouble
        self._signs = np.random.default_rng(0).choice([-1.0, 1.0], threshold.size)
        self._count, self._next = 0, float(FIRST)

    def __call__(self, t: float, y: FloatArray) -> FloatArray:
        """Return the Jacobian."""
        self._count += 1
        matrix = self._jacobian(t, y)
        if self._count > 1 and (self._count < self._next or not self._in_trouble()):
            return matrix
        self._next = max(self._next, 2.0 * self._count)
        if not self._is_wrong(matrix, t, y):
            return matrix
        warn(
            f"`jac` is not the derivative of `fun` at t = {t:g}; finite differences are used from here on.",
            RuntimeWarning,
            stacklevel=2,
        )
        self._jacobian, self._next = self._differences, np.inf
        return self._differences(t, y)

    def _is_wrong(self, matrix: FloatArray, t: float, y: FloatArray) -> bool:
        """Compare on both sides, since a kink may lie on one of them."""
        f = self._fun(t, y)
        return all(self._differs(matrix, t, y, f, side) for side in (CHANGE, -CHANGE))

    def _differs(self, matrix: FloatArray, t: float, y: FloatArray, f: FloatArray, side: float) -> bool:
        change = side * self._signs * (np.abs(y) + self._threshold)
        found, expected = self._fun(t, y + change) - f, matrix @ change
        larger = max(np.linalg.norm(found), np.linalg.norm(expected))
        return bool(np.linalg.norm(found - expected) > max(WRONG * larger, NOISE * np.linalg.norm(f)))
