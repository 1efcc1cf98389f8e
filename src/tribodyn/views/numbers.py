"""Numbers as a person reads them: digits, and units in steps of a thousand."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from tribodyn.results.summary import KeyResult

#: Units of length with their sizes [m], the finest first. Nothing is finer than a nanometre.
LENGTHS: Final = (("nm", 1e-9), ("µm", 1e-6), ("mm", 1e-3), ("m", 1.0))
#: Units of one quantity with their sizes, the finest first.
_STEPS: Final = (
    LENGTHS,
    (("mN", 1e-3), ("N", 1.0), ("kN", 1e3), ("MN", 1e6)),
    (("mN m", 1e-3), ("N m", 1.0), ("kN m", 1e3)),
    (("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)),
    (("mW", 1e-3), ("W", 1.0), ("kW", 1e3), ("MW", 1e6)),
    (("µJ", 1e-6), ("mJ", 1e-3), ("J", 1.0), ("kJ", 1e3)),
    (("cycles", 1.0), ("thousand cycles", 1e3), ("million cycles", 1e6)),
)
_FAMILY: Final = {unit: steps for steps in _STEPS for unit, _ in steps}

_UNIT: Final = re.compile(r"(?<![A-Za-z])(u(?=[mNs](?![A-Za-z]))|deg(?![A-Za-z]))")
_RAISED: Final = str.maketrans("+-0123456789", " ⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def rounded(value: float, digits: int) -> float:
    """Return a number with as many significant digits."""
    return float(f"{value:.{digits - 1}e}")


def fitting(unit: str, values: Iterable[object]) -> tuple[str, float]:
    """Return the unit in which the largest of some values has one to three digits before the point.

    With it comes the factor of a value in it over one in the given unit, which may be a rate with ``per``
    after it, and stays where nothing fits better. Values that are no numbers are passed over.

    Examples
    --------
    >>> fitting("nm", [31600.0])
    ('µm', 0.001)
    >>> fitting("nm per 1000 cycles", [0.2]), fitting("N", [12100.0])[0], fitting("°", [4000.0])
    (('nm per 1000 cycles', 1.0), 'kN', ('°', 1.0))
    """
    first, per, rest = unit.partition(" per ")
    steps = dict(_FAMILY.get(first, ()))
    largest = max((abs(v) for v in values if isinstance(v, float) and math.isfinite(v)), default=0.0)
    if not steps or largest == 0.0:
        return unit, 1.0
    size = steps[first]
    # A number is shown with four digits: what rounds to 1000 belongs to the next unit.
    reached = [name for name, step in steps.items() if largest * size >= 0.99995 * step]
    chosen = reached[-1] if reached else next(iter(steps))
    return f"{chosen}{per}{rest}", 1.0 if chosen == first else round(size / steps[chosen], 12)


def in_words(value: object, digits: int = 4) -> str:
    """Return a value for the page: no computer notation, counts in groups of three.

    ``value``: a number, or anything else, which is shown as its text; ``digits``: how many significant digits
    are shown, four at most.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")
    mantissa, _, power = f"{rounded(value, digits) + 0.0:.4g}".partition("e")
    text = mantissa.replace("-", "−")
    return f"{text} × 10{str(int(power)).translate(_RAISED)}" if power else text


def interval(summary: Mapping[str, Any], name: str, factor: float = 1.0) -> str:
    """Return the interval of a key result in words, times the factor of a unit; empty where it has none."""
    ends = summary.get("intervals", {}).get(name)
    return " to ".join(in_words(end * factor, 2) for end in ends) if ends else ""


@dataclass(frozen=True)
class Column:
    """Numbers of several parts, such as joints, in one unit."""

    #: Its heading.
    label: str
    unit: str
    factor: float  #: Of a number in this unit over one in that of the key results.
    members: Mapping[str, KeyResult]  #: Key results by their names in ``summary.json``.


def tables_of(key_results: Mapping[str, KeyResult]) -> dict[str | None, dict[str, KeyResult]]:
    """Return key results by tables of parts; "" are those of the whole before them, None those after them."""
    found: dict[str | None, dict[str, KeyResult]] = {}
    for name, one in key_results.items():
        found.setdefault(one.group if one.part else None if any(found) else "", {})[name] = one
    return found


def columns_of(key_results: Mapping[str, KeyResult], summary: Mapping[str, Any]) -> list[Column]:
    """Return the columns of a table that has a row for each part, each in the unit that fits its numbers."""
    groups: dict[tuple[str, str], dict[str, KeyResult]] = {}
    for name, one in key_results.items():
        groups.setdefault((one.column_in(summary), one.unit), {})[name] = one
    return [
        Column(label, *fitting(unit, [summary[name] for name in members]), members)
        for (label, unit), members in groups.items()
    ]


def as_read(unit: str) -> str:
    """Return a unit of a case file as it stands in print: µm, °."""
    return _UNIT.sub(lambda found: {"u": "µ", "deg": "°"}[found[1]], unit)
