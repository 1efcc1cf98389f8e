"""Scatter of wear: how far one of equal parts may be from the wear at a known rate.

Wear of equal parts in equal tests differs by factors, so that its logarithm is taken as normal. Of n repeats
with the standard deviation s of the logarithms one more part lies, with 95 % probability, within
t s √(1 + 1/n) of their mean, t being the quantile of Student's distribution with n − 1 degrees of freedom.
"""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

LEAST: Final = 1.5  #: Least factor up and down: two equal pin-on-disc tests of PPS with PTFE differ by 1.37.
_LEVEL: Final = 0.95


def of_repeats(repeats: Sequence[float]) -> tuple[float, float]:
    """Return the interval of the wear of one more equal part over the geometric mean of repeats [1].

    ``repeats``: wear of equal parts, two or more numbers above zero in any one unit.
    """
    from scipy.special import stdtrit

    n, deviation = len(repeats), float(np.std(np.log(repeats), ddof=1))
    quantile = float(stdtrit(n - 1, 0.5 + 0.5 * _LEVEL))
    factor = max(math.exp(quantile * deviation * math.sqrt(1.0 + 1.0 / n)), LEAST)
    return 1.0 / factor, factor
