"""Numbers as sums of two: exact sums and products; their 64 bits; the length of a vector of two components.

Sums: Knuth, The Art of Computer Programming 2, section 4.2.2; products: Dekker (1971), Numer. Math. 18, 224.
No fused multiply-add is used, which not every processor has.
"""

import math
import struct
from fractions import Fraction
from typing import Any, Final

from mebdf.compiled.kernel import UNCOMPILED, Instruction
from mebdf.kernels.jit import kernel

_SPLITTER: Final = 134217729.0  #: 2²⁷ + 1.


@kernel
def ordered_sum(a: float, b: float) -> tuple[float, float]:
    """Return a + b, rounded, and its rounding error; |a| ≥ |b| or a = 0."""
    total = a + b
    return total, b - (total - a)


@kernel
def sum_of(a: float, b: float) -> tuple[float, float]:
    """Return a + b, rounded, and its rounding error."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


@kernel
def halves(a: float) -> tuple[float, float]:
    """Return two numbers of 26 bits whose sum is ``a``; |a| < 2⁹⁹⁶."""
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high


@kernel
def product_of(a: float, b: float) -> tuple[float, float]:
    """Return a b, rounded, and its rounding error, where that is a normal number and nothing overflows."""
    product = a * b
    a_1, a_2 = halves(a)
    b_1, b_2 = halves(b)
    return product, ((a_1 * b_1 - product) + a_1 * b_2 + a_2 * b_1) + a_2 * b_2


@kernel
def quotient_of(a: float, a_low: float, b: float, b_low: float) -> tuple[float, float]:
    """Return (a + a_low)/(b + b_low) as a sum of two numbers, to about 2⁻¹⁰² of it."""
    quotient = a / b
    product, error = product_of(quotient, b)
    return quotient, (((a - product) - error) + (a_low - quotient * b_low)) / b


def two_parts(exact: Fraction, bits: int = 0) -> tuple[float, float]:
    """Return a constant as a sum of two numbers; the first a multiple of 2^−bits where ``bits`` are given."""
    high = float(Fraction(round(exact * 2**bits), 2**bits)) if bits else float(exact)
    return high, float(exact - Fraction(high))


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


_LARGE: Final = 2.0**500
_SMALL: Final = 2.0**-400
_SCALE: Final = 2.0**600
#: A component below this share of the other one changes less than a tenth of the last digit.
_FLAT: Final = 2.0**-28


@kernel
def hypot(x: float, y: float) -> float:
    """Return √(x² + y²); infinite if one is, whatever the other."""
    a, b = abs(x), abs(y)
    if a == math.inf or b == math.inf:
        return math.inf
    if x != x or y != y:
        return x + y
    if a < b:
        a, b = b, a
    if b <= _FLAT * a:
        return a
    if a > _LARGE:
        return _root(a / _SCALE, b / _SCALE) * _SCALE
    if b < _SMALL:
        return _root(a * _SCALE, b * _SCALE) / _SCALE
    return _root(a, b)


@kernel
def _root(a: float, b: float) -> float:
    """Return √(a² + b²), a ≥ b > 0, whose squares are neither too large nor too small."""
    first, first_error = product_of(a, a)
    second, second_error = product_of(b, b)
    square, error = ordered_sum(first, second)
    root = math.sqrt(square)
    again, again_error = product_of(root, root)
    rest = (square - again) - again_error + (error + first_error + second_error)
    return root + 0.5 * rest / root
