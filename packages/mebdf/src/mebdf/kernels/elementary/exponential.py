"""Exponential function, e^x − 1 and hyperbolic tangent.

With n the whole number nearest to 64 x/ln 2, e^x = 2^(n/64) e^r, |r| ≤ ln 2/128. A table holds 2^(j/64) to
twice the digits: Tang (1989), ACM Trans. Math. Softw. 15, 144.
"""

import math
from typing import Final

from mebdf.kernels.elementary.bits import BIAS, MANTISSA, number_of
from mebdf.kernels.elementary.constants import POWERS, STEP, STEPS, STEPS_PER_UNIT
from mebdf.kernels.elementary.doubled import ordered_sum, quotient_of, sum_of
from mebdf.kernels.jit import kernel

LARGEST: Final = 710.0  #: e^710 overflows.
SMALLEST: Final = -746.0  #: e^−746 is zero.
#: 1.5 · 2⁵²: added and subtracted it rounds to the nearest whole number.
ROUNDING: Final = 6755399441055744.0
_NORMAL: Final = 1021  #: Exponents that a factor between ½ and 2 does not take out of the range of numbers.


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
    if -_NORMAL <= m <= _NORMAL:
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
