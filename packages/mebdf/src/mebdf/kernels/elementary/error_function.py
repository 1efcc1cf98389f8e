"""The complementary error function.

Below 1 it is 1 − erf(x), erf(x) = 2/√π e^(−x²) Σ 2ⁿ x^(2n+1)/(2n+1)!!: Abramowitz and Stegun 7.1.6. Elsewhere
it is the trapezoidal rule with its correction: Chiarella and Reichel (1968), Math. Comput. 22, 137.
"""

import math
from typing import Final

from mebdf.kernels.elementary.doubled import product_of
from mebdf.kernels.elementary.exponential import exp, expm1
from mebdf.kernels.jit import kernel

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
