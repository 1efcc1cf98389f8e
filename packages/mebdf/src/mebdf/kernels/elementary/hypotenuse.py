"""Length of a vector of two components: Borges (2021), ACM Trans. Math. Softw. 47, 9, by exact products."""

import math
from typing import Final

from mebdf.kernels.elementary.doubled import ordered_sum, product_of
from mebdf.kernels.jit import kernel

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
