"""Elementary functions of arrays, before and after a run: they take and return what those of NumPy do.

NumPy chooses its functions by the processor. One kernel holds all: loading one of them loads the others.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import doubled, exponential, trigonometric
from mebdf.kernels.jit import entry, kernel

_SIN, _COS, _TAN, _ASIN, _ACOS, _ATAN2, _EXP, _EXPM1, _LOG, _HYPOT, _POWER, _ERFC = range(12)


@entry
def _fill(number: int, x: FloatArray, y: FloatArray, out: FloatArray) -> None:
    for i in range(out.size):
        out[i] = _value(number, x[i], y[i])


@kernel
def _value(number: int, x: float, y: float) -> float:
    if number == _SIN:
        return trigonometric.sin(x)
    if number == _COS:
        return trigonometric.cos(x)
    if number == _TAN:
        return trigonometric.tan(x)
    if number == _ASIN:
        return trigonometric.asin(x)
    if number == _ACOS:
        return trigonometric.acos(x)
    if number == _ATAN2:
        return trigonometric.atan2(x, y)
    if number == _EXP:
        return exponential.exp(x)
    if number == _EXPM1:
        return exponential.expm1(x)
    if number == _LOG:
        return exponential.log(x)
    if number == _HYPOT:
        return doubled.hypot(x, y)
    if number == _POWER:
        return exponential.power(x, y)
    return exponential.erfc(x)


def _function(number: int) -> Callable[..., Any]:
    """Return a function of one or two arrays, or numbers, of any shapes that go together."""

    def function(x: Any, y: Any = 0.0) -> Any:
        first, second = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
        out = np.empty(first.size)
        _fill(number, np.array(first, order="C").ravel(), np.array(second, order="C").ravel(), out)
        return out.reshape(first.shape)[()]

    return function


sin: Final = _function(_SIN)
cos: Final = _function(_COS)
tan: Final = _function(_TAN)
asin: Final = _function(_ASIN)
acos: Final = _function(_ACOS)
atan2: Final = _function(_ATAN2)
exp: Final = _function(_EXP)
expm1: Final = _function(_EXPM1)
log: Final = _function(_LOG)
hypot: Final = _function(_HYPOT)
power: Final = _function(_POWER)
erfc: Final = _function(_ERFC)
