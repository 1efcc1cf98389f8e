"""How functions are compiled, in one place.

All of them are kept on disk (:mod:`mebdf.compiled.cache`). Division by zero gives inf or NaN, which the
integrators watch for: checking every division would cost more than the division.

Floating-point operations are compiled as they are written: none is contracted, reordered or replaced by
another. So a kernel returns the same bits on every processor and from every level that it is inlined into. It
calls no function of the C library: :mod:`mebdf.kernels.elementary` has those that are needed.

Kernels allocate no memory. Numba's reference counts, which take a fifth of the time of a run, are switched
off by the private option ``_nrt``; a kernel that creates an array does not compile.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numba as nb

from mebdf.compiled.cache import Sources, cached

_OPTIONS: Final[dict[str, Any]] = {
    "error_model": "numpy",
    "_nrt": False,
}


class Decorators(NamedTuple):
    """Decorators of the functions that a package compiles.

    Attributes
    ----------
    entry
        A function that a compiled integrator may be handed.
    kernel
        Any other function; without the wrapper for being handed on, it compiles faster.
    unlocked
        A function that takes so long that other threads of the process should go on meanwhile.
    inlined
        As ``kernel``, for a few lines in a loop, and for levels that only pass arguments on: numba compiles
        into each function all that it calls, again at every level.
    """

    entry: Any
    kernel: Any
    unlocked: Any
    inlined: Any


def decorators(sources: Sources) -> Decorators:
    """Return the decorators of a package, whose machine code is made from ``sources``."""

    def njit(**options: Any) -> Any:
        return lambda function: cached(nb.njit(**_OPTIONS, **options)(function), sources)

    return Decorators(
        entry=njit(),
        kernel=njit(no_cfunc_wrapper=True),
        unlocked=njit(nogil=True, no_cfunc_wrapper=True),
        inlined=njit(inline="always", no_cfunc_wrapper=True),
    )
