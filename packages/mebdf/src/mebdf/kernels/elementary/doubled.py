"""Numbers as unevaluated sums of two: exact sums and products, and constants to twice the digits.

Sums: Knuth, The Art of Computer Programming 2, section 4.2.2; products: Dekker (1971), Numer. Math. 18, 224.
No fused multiply-add is used, which not every processor has.
"""

from fractions import Fraction
from typing import Final

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
