"""Inverse trigonometric functions: all by the angle of a point, to more digits than a number has.

With c the multiple of 1/16 nearest to t = a/b, 0 ≤ a ≤ b, atan t = atan c + atan((a − c b)/(b + c a)). A
table holds the first to twice the digits, the second is a short series: Gal and Bachelis (1991), ACM Trans.
Math. Softw. 17, 26.
"""

import math
from typing import Final

from mebdf.kernels.elementary.constants import ANGLES, HALF_PI, PI, TANGENTS
from mebdf.kernels.elementary.doubled import ordered_sum, product_of, quotient_of, sum_of
from mebdf.kernels.elementary.exponential import ROUNDING
from mebdf.kernels.jit import kernel

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
