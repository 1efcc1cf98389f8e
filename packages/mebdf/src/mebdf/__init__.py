"""A solver for stiff and differential-algebraic equations: ``solve_ivp(..., method=mebdf.MEBDF)``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mebdf.solver import MEBDF

__all__ = ["MEBDF"]


def __getattr__(name: str) -> Any:
    """Import the solver class on first use: SciPy and numba take a second."""
    if name == "MEBDF":
        from mebdf.solver import MEBDF

        return MEBDF
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
