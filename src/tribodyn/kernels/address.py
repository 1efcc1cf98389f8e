"""Compiled functions that kernels call by their addresses.

A kernel contains the machine code of all that it calls. What few models need is handed to kernels in their
data instead: it is compiled where a model needs it, once, and no kernel contains it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numba.experimental.function_type  # noqa: F401  # tells numba of such functions
from numba.core.types import WrapperAddressProtocol


def address_of(compiled: Any, signature: Any) -> int:
    """Return the address of the machine code of an ``entry`` of ``kernels/jit.py``, for a signature."""
    result = compiled.get_compile_result(signature)
    return int(result.library.get_pointer_to_function(result.fndesc.llvm_cfunc_wrapper_name))


class ByAddress(WrapperAddressProtocol):
    """A compiled function as a field of what kernels read; its type says nothing of which function it is.

    Parameters
    ----------
    function
        An ``entry`` of :mod:`tribodyn.kernels.jit`.
    signature
        Its numba signature.
    """

    def __init__(self, function: Callable[..., None], signature: Any) -> None:
        self.function, self._signature = function, signature

    def __call__(self, *arguments: Any) -> None:
        """Call the function, as kernels do where they are not compiled."""
        self.function(*arguments)

    def signature(self) -> Any:
        """Return the signature, as numba asks for it."""
        return self._signature

    def __wrapper_address__(self) -> int:
        """Return the address, as numba asks for it."""
        return self._address

    @cached_property
    def _address(self) -> int:
        return address_of(self.function, self._signature)
