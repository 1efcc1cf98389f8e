"""Exponential function, hyperbolic tangent, logarithm, powers, and the complementary error function.

With n the whole number nearest to 64 x/ln 2, e^x = 2^(n/64) e^r, |r| ≤ ln 2/128. A table holds 2^(j/64) to
twice the digits: Tang (1989), ACM Trans. Math. Softw. 15, 144.

With c near 1/m from a table, ln(2^k m) = k ln 2 − ln c + ln(1 + r), r = c m − 1 exactly, |r| ≤ 2⁻⁷: Tang
(1990), ACM Trans. Math. Softw. 16, 378. The sum is formed to twice the digits, which powers need.

Below 1 it is 1 − erf(x), erf(x) = 2/√π e^(−x²) Σ 2ⁿ x^(2n+1)/(2n+1)!!: Abramowitz and Stegun 7.1.6. Elsewhere
it is the trapezoidal rule with its correction: Chiarella and Reichel (1968), Math. Comput. 22, 137.
"""

import math
from typing import Final

from mebdf.kernels.elementary.constants import (
    INVERSES,
    LN2,
    LOGARITHM_BITS,
    LOGARITHMS,
    POWERS,
    ROOT,
    STEP,
    STEPS,
    STEPS_PER_UNIT,
)
from mebdf.kernels.elementary.doubled import (
    BIAS,
    FRACTION,
    MANTISSA,
    ONE,
    bits_of,
    number_of,
    ordered_sum,
    product_of,
    quotient_of,
    sum_of,
)
from mebdf.kernels.jit import kernel

LARGEST: Final = 710.0  #: e^710 overflows.
SMALLEST: Final = -746.0  #: e^−746 is zero.
#: 1.5 · 2⁵²: added and subtracted it rounds to the nearest whole number.
ROUNDING: Final = 6755399441055744.0
_WITHIN: Final = 1021  #: Exponents that a factor between ½ and 2 does not take out of the range of numbers.


@kernel
def exponential(x: float, low: float) -> tuple[float, float, int]:
    """Return a + b and the whole number m with e^(x + low) = 2^m (a + b), to 2⁻⁵⁹ of it, ½ < a + b < 2.

    −746 < x < 710; ``low`` is below the last digit of ``x``.
    """
    n = (x * STEPS_PER_UNIT + ROUNDING) - ROUNDING
    r = ((x - n * STEP[0]) - n * STEP[1]) + low
    series = r * r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0)))))
    number = int(n)
    j = number & (STEPS - 1)
    power = POWERS[j, 0]
    return power, POWERS[j, 1] + power * (r + series), number >> 6


@kernel
def scaled(x: float, m: int) -> float:
    """Return 2^m x, ½ < x < 2, rounded once."""
    if -_WITHIN <= m <= _WITHIN:
        return x * number_of((m + BIAS) << MANTISSA)
    part = m >> 1
    return x * number_of((part + BIAS) << MANTISSA) * number_of((m - part + BIAS) << MANTISSA)


@kernel
def exp(x: float) -> float:
    """Return e^x."""
    if not x < LARGEST:
        return x * math.inf
    if x <= SMALLEST:
        return 0.0
    high, low, m = exponential(x, 0.0)
    return scaled(high + low, m)


@kernel
def expm1(x: float) -> float:
    """Return e^x − 1."""
    if x == 0.0:
        return x
    if abs(x) < 0.125:
        tail = 1.0 / 5040.0 + x * (
            1.0 / 40320.0 + x * (1.0 / 362880.0 + x * (1.0 / 3628800.0 + x / 39916800.0))
        )
        tail = 1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x * tail)))
        return x + x * x * (0.5 + x * tail)
    if not x < LARGEST:
        return x * math.inf
    if x < -40.0:
        return -1.0
    high, low, m = exponential(x, 0.0)
    if m > 60:
        return scaled(high + low, m)
    factor = number_of((m + BIAS) << MANTISSA)
    high, error = sum_of(high * factor, -1.0)
    return high + (error + low * factor)


@kernel
def tanh(x: float) -> float:
    """Return the hyperbolic tangent: its series near zero, elsewhere (e^2|x| − 1)/(e^2|x| + 1)."""
    size = abs(x)
    if size == 0.0:
        return x
    if size <= 0.0625:
        z = x * x
        tail = -1382.0 / 155925.0 + z * (21844.0 / 6081075.0 - z * (929569.0 / 638512875.0))
        return x - x * z * (
            1.0 / 3.0 - z * (2.0 / 15.0 + z * (-17.0 / 315.0 + z * (62.0 / 2835.0 + z * tail)))
        )
    if size > 22.0:
        return math.copysign(1.0, x)
    high, low, m = exponential(2.0 * size, 0.0)
    factor = number_of((m + BIAS) << MANTISSA)
    high, low = ordered_sum(high * factor, low * factor)
    above, above_error = sum_of(high, 1.0)
    below, below_error = sum_of(high, -1.0)
    quotient, rest = quotient_of(below, below_error + low, above, above_error + low)
    return math.copysign(quotient + rest, x)


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


_TERMS: Final = 24
_STEP: Final = 0.5
_LONGEST: Final = 14  #: Terms of the trapezoidal rule: e^(−49) is left out.


@kernel
def erfc(x: float) -> float:
    """Return 2/√π ∫_x^∞ e^(−s²) ds, to 3 · 10⁻¹⁵ of it."""
    if x < 0.0:
        return 2.0 - _of_size(-x)
    return _of_size(x)


@kernel
def _of_size(x: float) -> float:
    """Return the same of a number that is not negative."""
    if x != x:
        return x
    if x > 27.3:
        return 0.0
    square, error = product_of(x, x)
    density = exp(-square) * (1.0 - error)
    if x < 1.0:
        total = 1.0
        for n in range(_TERMS, 0, -1):
            total = 1.0 + total * 2.0 * square / (2 * n + 1)
        return 1.0 - 2.0 / math.sqrt(math.pi) * density * x * total
    total = 0.0
    for n in range(_LONGEST, 0, -1):
        step = (_STEP * n) * (_STEP * n)
        total += exp(-step) / (step + square)
    rule = 2.0 * _STEP * x / math.pi * density * (0.5 / square + total)
    return rule - 2.0 / expm1(2.0 * math.pi / _STEP * x) if x < math.pi / _STEP else rule
