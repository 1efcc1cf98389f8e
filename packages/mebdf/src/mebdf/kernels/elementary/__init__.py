"""Elementary functions that return the same bits on every processor, to less than one unit in the last place.

The C library chooses its functions by the processor, and they differ from version to version. These are
compiled from operations that IEEE 754 defines to the bit: + − × ÷ and square root of double precision.
"""

from mebdf.kernels.elementary.doubled import hypot
from mebdf.kernels.elementary.exponential import erfc, exp, expm1, log, log1p, power, tanh
from mebdf.kernels.elementary.trigonometric import acos, asin, atan, atan2, cos, sin, tan

__all__ = [
    "acos",
    "asin",
    "atan",
    "atan2",
    "cos",
    "erfc",
    "exp",
    "expm1",
    "hypot",
    "log",
    "log1p",
    "power",
    "sin",
    "tan",
    "tanh",
]
