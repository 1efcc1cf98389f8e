"""A solver for stiff and differential-algebraic equations: ``solve_ivp(..., method=mebdf.MEBDF)``."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mebdf.dae import solve_dae
    from mebdf.solver import MEBDF

__all__ = ["MEBDF", "solve_dae"]


def __getattr__(name: str) -> Any:
    """Import the solver on first use: SciPy and numba take a second."""
    if name == "MEBDF":
        from mebdf.solver import MEBDF

        return MEBDF
    if name == "solve_dae":
        from mebdf.dae import solve_dae

        return solve_dae
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
