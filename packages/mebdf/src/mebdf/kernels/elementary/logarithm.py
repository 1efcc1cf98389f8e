"""Logarithm and powers.

With c near 1/m from a table, ln(2^k m) = k ln 2 − ln c + ln(1 + r), r = c m − 1 exactly, |r| ≤ 2⁻⁷: Tang
(1990), ACM Trans. Math. Softw. 16, 378. The sum is formed to twice the digits, which powers need.
"""

import math
from typing import Final

from mebdf.kernels.elementary.bits import BIAS, FRACTION, MANTISSA, ONE, bits_of, number_of
from mebdf.kernels.elementary.constants import INVERSES, LN2, LOGARITHM_BITS, LOGARITHMS, ROOT
from mebdf.kernels.elementary.doubled import ordered_sum, product_of, sum_of
from mebdf.kernels.elementary.exponential import LARGEST, SMALLEST, exponential, scaled
from mebdf.kernels.jit import kernel

_NORMAL: Final = 2.2250738585072014e-308  #: The smallest normal number.
_LIFT: Final = 54
_LIFTED: Final = 2.0**_LIFT
_UPPER_HALF: Final = ~((1 << 27) - 1)
_VAST: Final = 2.0**60  #: From here on 1 + x is x, and every number is whole and even.


@kernel
def logarithm(x: float, low: float) -> tuple[float, float]:
    """Return ln(x + low) as a sum of two numbers, to about 2⁻⁶⁶ of it; ``x`` is a positive normal number."""
    bits = bits_of(x)
    k, j = (bits >> MANTISSA) - BIAS, (bits >> (MANTISSA - LOGARITHM_BITS)) & ((1 << LOGARITHM_BITS) - 1)
    part = low * number_of((BIAS - k) << MANTISSA) if low != 0.0 else 0.0
    m = number_of((bits & FRACTION) | ONE)
    if j >= ROOT:
        m, part, k = 0.5 * m, 0.5 * part, k + 1
    upper = number_of(bits_of(m) & _UPPER_HALF)
    c = INVERSES[j]
    r, r_low = sum_of(upper * c - 1.0, (m - upper) * c)
    r, error = sum_of(r, part * c)
    r_low += error
    square, square_error = product_of(r, r)
    tail = 0.2 + r * (-1.0 / 6.0 + r * (1.0 / 7.0 + r * (-0.125 + r * (1.0 / 9.0))))
    series = r * square * (1.0 / 3.0 + r * (-0.25 + r * tail))
    near, near_error = ordered_sum(r, -0.5 * square)
    rest = near_error + (r_low - (r * r_low + 0.5 * square_error) + series)
    high, error = sum_of(k * LN2[0] + LOGARITHMS[j, 0], near)
    return ordered_sum(high, error + (rest + (k * LN2[1] + LOGARITHMS[j, 1])))


@kernel
def log(x: float) -> float:
    """Return the natural logarithm."""
    if not 0.0 < x < math.inf:
        if x == 0.0:
            return -math.inf
        return x if not x < 0.0 else math.nan
    return _of_positive(x)[0]


@kernel
def _of_positive(x: float) -> tuple[float, float]:
    if x >= _NORMAL:
        return logarithm(x, 0.0)
    high, low = logarithm(x * _LIFTED, 0.0)
    high, error = ordered_sum(-_LIFT * LN2[0], high)
    return ordered_sum(high, error + (low - _LIFT * LN2[1]))


@kernel
def log1p(x: float) -> float:
    """Return ln(1 + x)."""
    if not -1.0 < x < _VAST:
        return log(x) if x != -1.0 else -math.inf
    if abs(x) < 2.0e-17:
        return x
    total, error = sum_of(1.0, x)
    return logarithm(total, error)[0]


@kernel
def power(x: float, y: float) -> float:
    """Return x^y, with the special values of C99, annex F."""
    if y == 0.0 or x == 1.0:
        return 1.0
    if x != x or y != y:
        return x + y
    if not 0.0 < x < math.inf or abs(y) == math.inf:
        return _special_power(x, y)
    return _of_sizes(x, y)


@kernel
def _of_sizes(x: float, y: float) -> float:
    """Return x^y of a positive number: e^(y ln x)."""
    high, low = _of_positive(x)
    product = y * high
    if product > LARGEST:
        return math.inf
    if product < SMALLEST:
        return 0.0
    product, error = product_of(y, high)
    high, low, m = exponential(product, error + y * low)
    return scaled(high + low, m)


@kernel
def _special_power(x: float, y: float) -> float:
    """Return x^y where x is zero, infinite or negative, or y is infinite."""
    size = abs(x)
    if abs(y) == math.inf:
        if size == 1.0:
            return 1.0
        return math.inf if (size > 1.0) == (y > 0.0) else 0.0
    whole = abs(y) >= _VAST or y == float(int(y))
    odd = whole and abs(y) < _VAST and (int(y) & 1) == 1
    if size == 0.0 or size == math.inf:
        found = 0.0 if (size == 0.0) == (y > 0.0) else math.inf
    elif not whole:
        return math.nan
    else:
        found = _of_sizes(size, y) if size != 1.0 else 1.0
    return math.copysign(found, x) if odd else found
