"""The 64 bits of a number as an integer, and back."""

from __future__ import annotations

import struct
from typing import Any, Final

import numba
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

MANTISSA: Final = 52
"""Bits of a mantissa."""
BIAS: Final = 1023
"""Offset of an exponent."""
FRACTION: Final = (1 << MANTISSA) - 1
"""Bits of the fraction of a number."""
ONE: Final = BIAS << MANTISSA
"""The bits of 1."""
SIGN: Final = -(1 << 63)
"""The sign bit."""


@intrinsic
def _bits(typing: Any, number: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.int64(types.float64), generate


@intrinsic
def _number(typing: Any, bits: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.DoubleType())

    return types.float64(types.int64), generate


def _uncompiled_bits(number: float) -> int:
    found: int = struct.unpack("<q", struct.pack("<d", number))[0]
    return found


def _uncompiled_number(bits: int) -> float:
    found: float = struct.unpack("<d", struct.pack("<q", bits))[0]
    return found


_UNCOMPILED: Final[bool] = vars(numba.config)["DISABLE_JIT"]
bits_of: Final[Any] = _uncompiled_bits if _UNCOMPILED else _bits
"""Return the bits of a number as a signed integer."""
number_of: Final[Any] = _uncompiled_number if _UNCOMPILED else _number
"""Return the number with these bits."""
