"""How kernels are compiled, in one place.

All of them are kept on disk (:mod:`tribodyn.kernels.cache`). Division by zero gives inf or NaN, which the
integrators watch for: checking every division would cost more than the division.

Floating-point operations are compiled as they are written: none is contracted, reordered or replaced by
another. So a kernel returns the same bits on every processor and from every level that it is inlined into,
apart from the elementary functions of the C library.

Kernels allocate no memory. Numba's reference counts, which take a fifth of the time of a run, are switched
off by the private option ``_nrt``; a kernel that creates an array does not compile.
"""

from __future__ import annotations

from typing import Any, Final

import numba as nb

from tribodyn.kernels.cache import cached

_OPTIONS: Final[dict[str, Any]] = {
    "error_model": "numpy",
    "_nrt": False,
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
