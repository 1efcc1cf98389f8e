"""Compilation of functions, in one place.

All of them are kept on disk (:mod:`mebdf.compiled.cache`). Division by zero gives inf or NaN, which the
integrators watch for: checking every division would cost more than the division.

Floating-point operations are compiled as they are written: none is contracted, reordered or replaced by
another. So a kernel returns the same bits on every processor and from every level that it is inlined into. It
calls no function of the C library: :mod:`mebdf.kernels.elementary` has those that are needed.

Kernels allocate no memory. Numba's reference counts, which take a fifth of the time of a run, are switched
off by the private option ``_nrt``; a kernel that creates an array does not compile.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
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
        Any other function; without the wrappers for being handed on and for Python, it compiles faster.
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

    def njit(kind: str = "", **options: Any) -> Any:
        return lambda function: cached(nb.njit(**_OPTIONS, **options)(function), sources, kind)

    def kernel(function: Any) -> Any:
        bare = njit(no_cfunc_wrapper=True, no_cpython_wrapper=True)(function)
        if bare is function:  # NUMBA_DISABLE_JIT is set
            return function
        return _for_kernels(bare, cache(partial(njit("called", no_cfunc_wrapper=True), function)))

    return Decorators(
        entry=njit(),
        kernel=kernel,
        unlocked=njit(nogil=True, no_cfunc_wrapper=True),
        inlined=njit(inline="always", no_cfunc_wrapper=True),
    )


def _for_kernels(bare: Any, for_python: Callable[[], Any]) -> Any:
    """Return a compiled function without a wrapper for Python; Python calls another one, made then.

    The wrapper takes the arguments apart. For those of a mechanism it takes a second to compile, and every
    kernel above would contain it once more.
    """

    def add_overload(compiled: Any) -> None:
        bare.overloads[tuple(compiled.signature.args)] = compiled  # numba's own lets Python find it, too

    def compile_for_python(*arguments: Any, **named: Any) -> Any:
        called = for_python()
        entry = called._compile_for_args(*arguments, **named)
        for compiled in called.overloads.values():
            if compiled.entry_point is entry:
                bare._insert([kind._code for kind in compiled.signature.args], entry, False)
        return entry

    bare.add_overload, bare._compile_for_args, bare.for_python = add_overload, compile_for_python, for_python
    return bare
