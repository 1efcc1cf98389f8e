"""Constants and tables of the elementary functions, computed by whole numbers to more bits than they keep."""

from fractions import Fraction
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary.doubled import two_parts

_BITS: Final = 320  #: Constants kept as one or two numbers of 53 bits.
_BITS_OF_PI: Final = 1280  #: Those of 2/π that the largest arguments need, see :data:`DIGITS`.


def _of_series(x: Fraction, sign: int, bits: int = _BITS) -> Fraction:
    """Return Σ signᵏ x^(2k+1)/(2k+1), 0 ≤ x < 1: inverse tangent (−1), or inverse hyperbolic tangent (1)."""
    power, square = (x.numerator << bits) // x.denominator, x * x
    total, k = 0, 0
    while power:
        total += sign**k * (power // (2 * k + 1))
        power, k = power * square.numerator // square.denominator, k + 1
    return Fraction(total, 1 << bits)


def _exponential(x: Fraction) -> Fraction:
    """Return e^x, 0 ≤ x < 1."""
    term, total, k = 1 << _BITS, 0, 0
    while term:
        total, k = total + term, k + 1
        term = term * x.numerator // (x.denominator * k)
    return Fraction(total, 1 << _BITS)


def _logarithm(x: Fraction) -> Fraction:
    """Return ln x of a number near 1."""
    return 2 * _of_series((x - 1) / (x + 1), 1) if x >= 1 else -_logarithm(1 / x)


def _table(values: list[Fraction], bits: int = 0) -> FloatArray:
    return np.array([two_parts(value, bits) for value in values])


_LN2: Final = _logarithm(Fraction(2))
#: Machin's formula.
_PI: Final = 4 * (
    4 * _of_series(Fraction(1, 5), -1, _BITS_OF_PI) - _of_series(Fraction(1, 239), -1, _BITS_OF_PI)
)

STEPS: Final = 64  #: Intervals of a factor of two in :data:`POWERS`.
STEPS_PER_UNIT: Final = float(STEPS / _LN2)
STEP: Final = two_parts(_LN2 / STEPS, 42)  #: ln 2/64; the first part has 36 bits.
POWERS: Final = _table([_exponential(_LN2 * j / STEPS) for j in range(STEPS)])  #: 2^(j/64), shape (64, 2).

LOGARITHM_BITS: Final = 7  #: Bits of the fraction by which an entry of :data:`INVERSES` is found.
ROOT: Final = 53  #: The first of these entries above √2: numbers from there on are halved.


def _inverse(j: int) -> Fraction:
    """Return about 1/x in the middle of an interval, in steps of 1/256 or 1/128; 1 next to 1."""
    intervals = 1 << LOGARITHM_BITS
    middle = 1 + (j + Fraction(1, 2)) / intervals
    if j >= ROOT:
        return Fraction(round(2 * intervals / middle), intervals) if j < intervals - 1 else Fraction(1)
    return Fraction(round(2 * intervals / middle), 2 * intervals) if j else Fraction(1)


_INVERSES: Final = [_inverse(j) for j in range(1 << LOGARITHM_BITS)]
#: Factors of a mantissa of eight bits, so that the product is near 1, shape (128,).
INVERSES: Final = np.array([float(c) for c in _INVERSES])
#: −ln of these, shape (128, 2); the first parts are multiples of 2⁻⁴².
LOGARITHMS: Final = _table([-_logarithm(c) for c in _INVERSES], 42)
LN2: Final = two_parts(_LN2, 42)  #: ln 2; the first part is a multiple of 2⁻⁴².

PI: Final = two_parts(_PI)
HALF_PI: Final = two_parts(_PI / 2)
QUARTERS_PER_UNIT: Final = float(2 / _PI)
_FIRST: Final = two_parts(_PI / 2, 32)[0]
_SECOND: Final = two_parts(_PI / 2 - Fraction(_FIRST), 65)[0]
_THIRD: Final = two_parts(_PI / 2 - Fraction(_FIRST) - Fraction(_SECOND), 98)[0]
#: π/2 in four parts, of which the first three have 33 bits: times a whole number below 2²⁰ they are exact.
QUARTER: Final = (
    _FIRST,
    _SECOND,
    _THIRD,
    float(_PI / 2 - Fraction(_FIRST) - Fraction(_SECOND) - Fraction(_THIRD)),
)
DIGIT: Final = 24  #: Bits of an entry of :data:`DIGITS`.
#: 2/π after three digits that are zero, shape (52,).
DIGITS: Final = np.array([int(2 / _PI * Fraction(1 << DIGIT) ** (k - 2)) % (1 << DIGIT) for k in range(52)])

TANGENTS: Final = 16  #: Intervals of [0, 1] in :data:`ANGLES`.
#: Inverse tangents of j/16, shape (17, 2).
ANGLES: Final = _table([_of_series(Fraction(j, TANGENTS), -1) for j in range(TANGENTS)] + [_PI / 4])
