"""How kernels are compiled, in one place.

All of them are cached on disk. Division by zero gives inf or NaN, which the integrators watch for: checking
every division would cost more than the division.
"""

from __future__ import annotations

from typing import Any, Final

import numba as nb

# Numba's own types do not know every option.
_njit: Final[Any] = nb.njit

entry: Final[Any] = _njit(cache=True, error_model="numpy")
"""A function that a compiled integrator may be handed."""

kernel: Final[Any] = _njit(cache=True, error_model="numpy", no_cfunc_wrapper=True)
"""Any other function; without the wrapper for being handed on, it compiles in half the time."""

inlined: Final[Any] = _njit(cache=True, error_model="numpy", inline="always", no_cfunc_wrapper=True)
"""The same, for the few lines that every node of a joint runs through."""
