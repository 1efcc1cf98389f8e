"""The 64 bits of a number as an integer, and back."""

import struct
from typing import Any, Final

from mebdf.compiled.kernel import UNCOMPILED, Instruction

MANTISSA: Final = 52  #: Bits of a mantissa.
BIAS: Final = 1023  #: Offset of an exponent.
FRACTION: Final = (1 << MANTISSA) - 1  #: Bits of the fraction of a number.
ONE: Final = BIAS << MANTISSA  #: The bits of 1.
SIGN: Final = -(1 << 63)  #: The sign bit.


def _uncompiled_bits(number: float) -> int:
    found: int = struct.unpack("<q", struct.pack("<d", number))[0]
    return found


def _uncompiled_number(bits: int) -> float:
    found: float = struct.unpack("<d", struct.pack("<q", bits))[0]
    return found


_MODULE: Final = "mebdf.kernels.elementary.instructions"
#: Return the bits of a number as a signed integer.
bits_of: Final[Any] = _uncompiled_bits if UNCOMPILED else Instruction(_uncompiled_bits, _MODULE, "bits")
#: Return the number with these bits.
number_of: Final[Any] = (
    _uncompiled_number if UNCOMPILED else Instruction(_uncompiled_number, _MODULE, "number")
)
