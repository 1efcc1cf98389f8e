"""How kernels are compiled, in one place.

All of them are kept on disk (:mod:`tribodyn.kernels.cache`). Division by zero gives inf or NaN, which the
integrators watch for: checking every division would cost more than the division. Products and sums may be
contracted and divisions by constants turned into products, which changes the last bits but nothing that is
not a number. Loops that add up over the nodes of a joint may do so in any order, which lets the processor
take four nodes at once.
"""

from __future__ import annotations

from typing import Any, Final

import numba as nb

from tribodyn.kernels.cache import cached

_OPTIONS: Final[dict[str, Any]] = {
    "error_model": "numpy",
    "fastmath": {"contract", "arcp"},
}


def _njit(**options: Any) -> Any:
    """Return a decorator that compiles with these options."""
    return lambda function: cached(nb.njit(**options)(function))


entry: Final[Any] = _njit(**_OPTIONS)
"""A function that a compiled integrator may be handed."""

kernel: Final[Any] = _njit(**_OPTIONS, no_cfunc_wrapper=True)
"""Any other function; without the wrapper for being handed on, it compiles faster."""

unlocked: Final[Any] = _njit(**_OPTIONS, nogil=True, no_cfunc_wrapper=True)
"""A function that takes so long that other threads of the process should go on meanwhile."""

inlined: Final[Any] = _njit(**_OPTIONS, inline="always", no_cfunc_wrapper=True)
"""The same, for the few lines that every node of a joint runs through, and for levels that only pass on.

Numba compiles into each function all that it calls: every level above a joint or a film compiles it anew."""

summing: Final[Any] = _njit(
    **_OPTIONS | {"fastmath": {"contract", "arcp", "reassoc", "nsz"}}, no_cfunc_wrapper=True
)
"""A function around a loop that adds up, in any order."""
