"""The larger and the smaller of two numbers, in the form that loops over four nodes at once understand.

Python's ``max`` and ``min`` choose one of two; to the compiler, a running maximum made of such choices is no
sum that it may split. The processor's own maximum is. NaN stays NaN.
"""

from __future__ import annotations

from typing import Any

import numba
from llvmlite import ir
from numba import float64
from numba.extending import intrinsic


def _builtin(name: str) -> Any:
    """Return a function of two numbers that is an instruction of the compiler."""

    @intrinsic
    def function(typingctx: Any, a: Any, b: Any) -> Any:
        number = ir.DoubleType()

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            types = ir.FunctionType(number, [number, number])
            called = builder.module.declare_intrinsic(name, [number], types)
            return builder.call(called, arguments)

        return float64(float64, float64), generate

    return function


_uncompiled: bool = vars(numba.config)["DISABLE_JIT"]
larger: Any = max if _uncompiled else _builtin("llvm.maximum")
smaller: Any = min if _uncompiled else _builtin("llvm.minimum")
