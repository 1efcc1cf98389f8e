"""Trigonometric functions and their inverses, which are all the angle of a point.

Arguments are reduced to the nearest multiple of π/2: by parts of π/2 (Cody and Waite, Software Manual for the
Elementary Functions, 1980), large ones by the digits of 2/π that matter (Payne and Hanek (1983), SIGNUM
Newsletter 18(1), 19). What is left, |r| ≤ π/4 in two parts, goes into Taylor's series.

With c the multiple of 1/16 nearest to t = a/b, 0 ≤ a ≤ b, atan t = atan c + atan((a − c b)/(b + c a)). A
table holds the first to twice the digits, the second is a short series: Gal and Bachelis (1991), ACM Trans.
Math. Softw. 17, 26.
"""

import math
from typing import Final

from mebdf.kernels.elementary.constants import (
    ANGLES,
    DIGIT,
    DIGITS,
    HALF_PI,
    PI,
    QUARTER,
    QUARTERS_PER_UNIT,
    TANGENTS,
)
from mebdf.kernels.elementary.doubled import (
    BIAS,
    FRACTION,
    MANTISSA,
    bits_of,
    ordered_sum,
    product_of,
    quotient_of,
    sum_of,
)
from mebdf.kernels.elementary.exponential import ROUNDING
from mebdf.kernels.jit import kernel

_LEAST: Final = 2.0**-27  #: Below it sine and tangent are the argument.
_UNREDUCED: Final = 0.5 * HALF_PI[0]
_LARGE_ANGLE: Final = 1.0e6  #: Above it parts of π/2 are not enough.
_MASK: Final = (1 << DIGIT) - 1


@kernel
def _reduced(x: float) -> tuple[int, float, float]:
    """Return n and r + e with x = n π/2 + r + e, n up to multiples of four, |r| ≤ π/4."""
    if abs(x) <= _UNREDUCED:
        return 0, x, 0.0
    if not abs(x) < _LARGE_ANGLE:
        return _reduced_large(x)
    n = (x * QUARTERS_PER_UNIT + ROUNDING) - ROUNDING
    first, first_error = sum_of(x - n * QUARTER[0], -n * QUARTER[1])
    second, second_error = sum_of(first, -n * QUARTER[2])
    r, low = ordered_sum(second, first_error + second_error - n * QUARTER[3])
    return int(n), r, low


@kernel
def _reduced_large(x: float) -> tuple[int, float, float]:
    """Return the same of a large number: a whole one times the digits of 2/π that are not multiples of 4."""
    if not abs(x) < math.inf:
        return 0, math.nan, math.nan
    bits = bits_of(abs(x))
    # The first of two bits before the point, counted from the first digit of the table.
    place = (bits >> MANTISSA) - BIAS - MANTISSA - 2 + 3 * DIGIT
    start, shift = place // DIGIT, place % DIGIT
    whole = (bits & FRACTION) | (1 << MANTISSA)
    low, high = whole & _MASK, whole >> DIGIT
    a = (low << shift) & _MASK
    b = (low >> (DIGIT - shift)) | ((high << shift) & _MASK)
    rest = high >> (DIGIT - shift)
    c, d = rest & _MASK, rest >> DIGIT
    carry = 0
    first, second, third = 0, 0, 0
    for k in range(5, -1, -1):
        at = start + k
        total = carry + a * DIGITS[at] + b * DIGITS[at + 1] + c * DIGITS[at + 2] + d * DIGITS[at + 3]
        digit, carry = (total & _MASK) << (DIGIT if k % 2 == 0 else 0), total >> DIGIT
        if k >= 4:
            third += digit
        elif k >= 2:
            second += digit
        else:
            first += digit
    n = first >> (2 * DIGIT - 2)
    first &= (1 << (2 * DIGIT - 2)) - 1
    if first >> (2 * DIGIT - 3):
        n, first = n + 1, first - (1 << (2 * DIGIT - 2))
    part, error = sum_of(first * 2.0 ** (2 - 2 * DIGIT), second * 2.0 ** (2 - 4 * DIGIT))
    part, error = ordered_sum(part, error + third * 2.0 ** (2 - 6 * DIGIT))
    r, low_r = product_of(part, HALF_PI[0])
    r, low_r = ordered_sum(r, low_r + (part * HALF_PI[1] + error * HALF_PI[0]))
    return (-n, -r, -low_r) if x < 0.0 else (n, r, low_r)


@kernel
def _sine_tail(r: float, low: float) -> float:
    """Return sin(r + low) − r."""
    z = r * r
    tail = -1.0 / 39916800.0 + z * (1.0 / 6227020800.0 + z * (-1.0 / 1307674368000.0 + z / 355687428096000.0))
    tail = 1.0 / 120.0 + z * (-1.0 / 5040.0 + z * (1.0 / 362880.0 + z * tail))
    return r * z * (-1.0 / 6.0 + z * tail) + low * (1.0 - 0.5 * z)


@kernel
def _cosine_parts(r: float, low: float) -> tuple[float, float]:
    """Return cos(r + low) as a sum of two numbers."""
    z = r * r
    half = 0.5 * z
    tail = 1.0 / 479001600.0 + z * (-1.0 / 87178291200.0 + z / 20922789888000.0)
    tail = -1.0 / 720.0 + z * (1.0 / 40320.0 + z * (-1.0 / 3628800.0 + z * tail))
    high = 1.0 - half
    return high, ((1.0 - high) - half) + (z * z * (1.0 / 24.0 + z * tail) - r * low)


@kernel
def _signed(n: int, x: float) -> float:
    return -x if n & 2 else x


@kernel
def sin(x: float) -> float:
    """Return the sine [rad]."""
    if abs(x) < _LEAST:
        return x
    n, r, low = _reduced(x)
    if n & 1:
        high, rest = _cosine_parts(r, low)
        return _signed(n, high + rest)
    return _signed(n, r + _sine_tail(r, low))


@kernel
def cos(x: float) -> float:
    """Return the cosine [rad]."""
    n, r, low = _reduced(x)
    if n & 1:
        return _signed(n + 1, r + _sine_tail(r, low))
    high, rest = _cosine_parts(r, low)
    return _signed(n, high + rest)


@kernel
def tan(x: float) -> float:
    """Return the tangent [rad]: its series near zero, elsewhere sine over cosine to more digits."""
    if abs(x) <= 0.0625:
        z = x * x
        tail = 1382.0 / 155925.0 + z * (21844.0 / 6081075.0 + z * (929569.0 / 638512875.0))
        series = 1.0 / 3.0 + z * (2.0 / 15.0 + z * (17.0 / 315.0 + z * (62.0 / 2835.0 + z * tail)))
        return x + x * z * series if abs(x) >= _LEAST else x
    n, r, low = _reduced(x)
    sine, sine_low = ordered_sum(r, _sine_tail(r, low))
    cosine, cosine_low = _cosine_parts(r, low)
    _, square_error = product_of(r, r)
    cosine, cosine_low = ordered_sum(cosine, cosine_low - 0.5 * square_error)
    if n & 1:
        quotient, rest = quotient_of(-cosine, -cosine_low, sine, sine_low)
    else:
        quotient, rest = quotient_of(sine, sine_low, cosine, cosine_low)
    return quotient + rest


_LARGE: Final = 2.0**500
_SMALL: Final = 2.0**-400
_SCALE: Final = 2.0**600
#: Angles below it are their tangents, and change no other angle by more than a share of its last digit.
_FLAT: Final = 2.0**-60


@kernel
def _first_octant(a: float, a_low: float, b: float, b_low: float) -> tuple[float, float]:
    """Return the inverse tangent of (a + a_low)/(b + b_low) as a sum of two numbers, 0 ≤ a ≤ b."""
    number = (TANGENTS * (a / b) + ROUNDING) - ROUNDING
    j, c = int(number), number / TANGENTS
    product, error = product_of(c, b)
    above, above_error = sum_of(a, -product)
    across, across_error = product_of(c, a)
    below, below_error = ordered_sum(b, across)
    above, above_error = ordered_sum(above, above_error + (a_low - error - c * b_low))
    u, low = quotient_of(above, above_error, below, below_error + (across_error + b_low + c * a_low))
    z = u * u
    series = u * z * (-1.0 / 3.0 + z * (0.2 + z * (-1.0 / 7.0 + z * (1.0 / 9.0 - z * (1.0 / 11.0)))))
    high, error = ordered_sum(ANGLES[j, 0], u) if j > 0 else (u, 0.0)
    return ordered_sum(high, error + (ANGLES[j, 1] + low + series))


@kernel
def _angle(y: float, y_low: float, x: float, x_low: float, back: bool) -> float:
    """Return the angle of a point, 0 ≤ y, 0 ≤ x; ``back`` that of the point with −x."""
    if y <= x:
        high, low = _first_octant(y, y_low, x, x_low)
        if not back:
            return high + low
        base, sign, rest = PI[0], -1.0, PI[1]
    else:
        high, low = _first_octant(x, x_low, y, y_low)
        base, sign, rest = HALF_PI[0], 1.0 if back else -1.0, HALF_PI[1]
    total, error = ordered_sum(base, sign * high)
    return total + (error + (rest + sign * low))


@kernel
def atan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y) [rad], with the special values of C99, annex F."""
    if x != x or y != y:
        return x + y
    a, b = abs(y), abs(x)
    back = math.copysign(1.0, x) < 0.0
    if a == math.inf or b == math.inf:
        a, b = 1.0 if a == math.inf else 0.0, 1.0 if b == math.inf else 0.0
    if a <= _FLAT * b or (a == 0.0 and b == 0.0):
        angle = PI[0] if back else (a / b if b > 0.0 else 0.0)
        return math.copysign(angle, y)
    if b <= _FLAT * a:
        return math.copysign(HALF_PI[0], y)
    if max(a, b) > _LARGE:
        a, b = a / _SCALE, b / _SCALE
    elif min(a, b) < _SMALL:
        a, b = a * _SCALE, b * _SCALE
    return math.copysign(_angle(a, 0.0, b, 0.0, back), y)


@kernel
def atan(x: float) -> float:
    """Return the inverse tangent [rad]."""
    return atan2(x, 1.0)


@kernel
def _other_leg(x: float) -> tuple[float, float]:
    """Return √(1 − x²) as a sum of two numbers, |x| ≤ 1."""
    square, error = product_of(x, x)
    rest, rest_error = sum_of(1.0, -square)
    rest_error -= error
    root = math.sqrt(rest + rest_error)
    if root == 0.0:
        return 0.0, 0.0
    again, again_error = product_of(root, root)
    return root, (((rest - again) - again_error) + rest_error) / (2.0 * root)


@kernel
def asin(x: float) -> float:
    """Return the inverse sine [rad]."""
    size = abs(x)
    if not size <= 1.0:
        return math.nan
    if size < _FLAT:
        return x
    leg, leg_low = _other_leg(x)
    return math.copysign(_angle(size, 0.0, leg, leg_low, False), x)


@kernel
def acos(x: float) -> float:
    """Return the inverse cosine [rad]."""
    size = abs(x)
    if not size <= 1.0:
        return math.nan
    if size < _FLAT:
        return HALF_PI[0]
    leg, leg_low = _other_leg(x)
    return _angle(leg, leg_low, size, 0.0, x < 0.0)
