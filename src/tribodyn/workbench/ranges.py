"""Range of a slider: both ends and the steps, all of them round numbers."""

import math
from dataclasses import dataclass
from decimal import Decimal
from typing import Final

from tribodyn.cases.keys import Key
from tribodyn.cases.units import number_in, to_si

_MOST_STEPS: Final = 10
"""Steps from zero to the value of the case, at least."""
_BEYOND: Final = 2.5
"""Least ratio of the slider's upper end to the value of the case."""
_ROUND: Final = (Decimal(1), Decimal(2), Decimal(5), Decimal(10))


@dataclass(frozen=True)
class Track:
    """Range of a slider, in the unit in which the key is shown.

    Attributes
    ----------
    least, greatest
        Its ends; no value between them breaks a limit of the key alone.
    step
        All values that it gives are multiples of this.
    """

    least: float
    greatest: float
    step: float


def track(key: Key, value: float | None, lowest: float | None = None) -> Track | None:
    """Return the track of a number; None for what is no number, and where nothing says how large it may be.

    Parameters
    ----------
    key
        What the number is of.
    value
        Its value (SI); None where none is given, and the example of the key says how large it may be.
    lowest
        Value (SI) below which a run makes no sense; a slider begins at the next step above it, or at the
        value itself where that is less.
    """
    if key.kind not in ("quantity", "number", "count"):
        return None
    number = Decimal(repr(_shown(key, value)))
    if number == 0:
        return None
    step = Decimal(10) ** math.floor((abs(number) / _MOST_STEPS).log10())
    if key.kind == "count":
        step = max(step, Decimal(1))
    limits = {name: _in_unit(key, bound) for name, bound in key.bounds}
    greatest = min(_round(abs(number)), _inside(limits, "lt", "le", step))
    least = max(-greatest, -_inside({name: -bound for name, bound in limits.items()}, "gt", "ge", step))
    if lowest is not None:
        sensible = math.ceil(Decimal(repr(_in_unit(key, lowest))) / step) * step
        least = max(least, min(sensible, math.floor(number / step) * step))
    return Track(float(least), float(greatest), float(step)) if least < greatest else None


def _shown(key: Key, value: float | None) -> float:
    """Return a value in the unit of its key, to the digits that a person would write.

    None stands for the example of the key, and zero for what makes the slider reach the greatest value.
    """
    if value is None:
        return _example(key)
    if value == 0.0:
        return next((_in_unit(key, bound) / _BEYOND for name, bound in key.bounds if name == "le"), 0.0)
    return float(f"{_in_unit(key, value):.12g}")


def _example(key: Key) -> float:
    if not key.example:
        return 0.0
    return number_in(to_si(key.example, key.unit), key.unit) if key.unit else float(key.example)


def _in_unit(key: Key, value: float) -> float:
    return number_in(value, key.unit) if key.kind == "quantity" else float(value)


def _round(size: Decimal) -> Decimal:
    """Return the least of 1, 2, 5 times a power of ten that lies far enough beyond a number."""
    far = size * Decimal(_BEYOND)
    power = Decimal(10) ** math.floor(far.log10())
    return next(factor * power for factor in _ROUND if factor * power >= far)


def _inside(limits: dict[str, float], open_: str, closed: str, step: Decimal) -> Decimal:
    """Return the last multiple of a step below an upper limit; infinity where there is none."""
    if open_ in limits:
        bound = Decimal(repr(limits[open_]))
        return (math.ceil(bound / step) - 1) * step
    if closed in limits:
        return math.floor(Decimal(repr(limits[closed])) / step) * step
    return Decimal("Infinity")
