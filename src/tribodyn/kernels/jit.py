"""How kernels are compiled, in one place."""

from __future__ import annotations

from typing import Any, Final

import numba as nb

kernel: Final[Any] = nb.njit(cache=True, error_model="numpy")
"""Compile and cache on disk. Division by zero gives inf or NaN, which the integrators watch for; checking
every division would cost more than the division."""

inlined: Final[Any] = nb.njit(cache=True, error_model="numpy", inline="always")
"""The same, for the few lines that every node of a joint runs through."""
