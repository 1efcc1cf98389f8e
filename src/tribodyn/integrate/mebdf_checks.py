"""What a solver class of SciPy refuses or warns of, in the words SciPy's own use."""

from __future__ import annotations

from collections.abc import Iterable
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike

from tribodyn.core.arrays import FloatArray

SMALLEST_RTOL = 100.0 * float(np.finfo(np.float64).eps)


def tolerances(rtol: ArrayLike, atol: ArrayLike, n: int) -> tuple[FloatArray, FloatArray]:
    """Return relative and absolute tolerances, each of shape (n,)."""
    relative = np.asarray(rtol, dtype=np.float64)
    if np.any(relative < SMALLEST_RTOL):
        warn(
            "At least one element of `rtol` is too small. "
            f"Setting `rtol = np.maximum(rtol, {SMALLEST_RTOL})`.",
            stacklevel=3,
        )
        relative = np.maximum(relative, SMALLEST_RTOL)
    return _vector("rtol", relative, n), _vector("atol", np.asarray(atol, dtype=np.float64), n)


def _vector(name: str, values: FloatArray, n: int) -> FloatArray:
    """Return ``values`` with shape (n,)."""
    if values.ndim > 0 and values.shape != (n,):
        raise ValueError(f"`{name}` has wrong shape.")
    if np.any(values < 0.0) or np.any(np.isnan(values)):
        raise ValueError(f"`{name}` must be positive.")
    return np.broadcast_to(values, (n,)).copy()


def largest_step(max_step: float) -> float:
    """Return the largest step."""
    if not max_step > 0:
        raise ValueError("`max_step` must be positive.")
    return float(max_step)


def starting_step(first_step: float | None, t0: float, t_bound: float) -> float:
    """Return the first step, 0 if the method is to choose it."""
    if first_step is None:
        return 0.0
    if not first_step > 0:
        raise ValueError("`first_step` must be positive.")
    if first_step > abs(t_bound - t0):
        raise ValueError("`first_step` exceeds bounds.")
    return float(first_step)


def warn_extraneous(names: Iterable[str]) -> None:
    """Warn of arguments that have no effect."""
    if listed := ", ".join(f"`{name}`" for name in names):
        warn(f"The following arguments have no effect for a chosen solver: {listed}.", stacklevel=3)
