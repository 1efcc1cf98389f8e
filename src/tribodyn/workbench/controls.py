"""Controls of a case: one a key, the most important ones first, with round ends of their sliders."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from decimal import Decimal
from fnmatch import fnmatchcase
from typing import Any, Final

from tribodyn.cases.case import Case
from tribodyn.cases.keys import VALUE, Key, Value
from tribodyn.cases.tables import Tables, keys_in, with_components
from tribodyn.cases.units import LISTS, number_in, to_si
from tribodyn.mechanisms.self_checks import ROUGH_LIMIT
from tribodyn.studies.variation import written

_MOST_STEPS: Final = 10  #: Steps from zero to the value of the case, at least.
_BEYOND: Final = 2.5  #: Least ratio of the slider's upper end to the value of the case.
_ROUND: Final = (Decimal(1), Decimal(2), Decimal(5), Decimal(10))


@dataclass(frozen=True)
class Track:
    """Range of a slider, in the unit in which the key is shown."""

    #: Its ends; no value between them breaks a limit of the key alone.
    least: float
    greatest: float
    step: float  #: All values that it gives are multiples of this.


def track(key: Key, value: float | None, lowest: float | None = None) -> Track | None:
    """Return the track of a number; None for what is no number, and where nothing says how large it may be.

    ``key``: what the number is of; ``value``: its value (SI); None where none is given, and the example of
    the key says how large it may be; ``lowest``: value (SI) below which a run makes no sense; a slider begins
    at the next step above it, or at the value itself where that is less.
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


FIRST: Final = 8  #: Controls that a page shows without being asked.
FILE: Final = "file"  #: Kind of the keys that name files: no page may turn them.
#: Lowest value of a parameter that is positive (SI): its slider begins at its first step.
_ABOVE_ZERO: Final = 1.0e-300
_NO_TRACK: Final = {"least": None, "greatest": None, "step": None}


def turnable(case: Case) -> dict[str, Key]:
    """Return the keys of a case that a page may turn, by dotted path."""
    keys = with_components(keys_in(case))
    return {path: key for path, key in keys.items() if key.kind != FILE and path != "case"}


def controls(case: Case, patterns: Sequence[str]) -> list[dict[str, Any]]:
    """Return the controls of a case, first those that match patterns, in the order of these."""
    without_effect = case.without_effect()
    keys = {
        path: key
        for path, key in turnable(case).items()
        if _stands(case, path) and not any(f"{path}.".startswith(f"{one}.") for one in without_effect)
    }
    first = list(dict.fromkeys(_matching(case, keys, patterns)))[:FIRST]
    others = [path for path in keys if path not in first]
    lowest = {path: ROUGH_LIMIT * roughness for path, roughness in case.rough_clearances().items()}
    # A length that is swept through zero turns a mechanism over.
    lengths = (path for path in keys if path.startswith("parameters."))
    lowest |= {path: _ABOVE_ZERO for path in lengths if (_number(case.at(path)) or 0.0) > 0.0}
    return [_control(case, keys[path], path in first, lowest.get(path)) for path in (*first, *others)]


def _stands(case: Case, path: str) -> bool:
    """Tell whether the table that a key stands in is there; components of a vector stand in the vector."""
    table = path.rpartition(".")[0]
    return not table or case.at(table) is not None


def _matching(case: Case, keys: Mapping[str, Key], patterns: Sequence[str]) -> Iterator[str]:
    """Yield the paths that match each pattern and have a value that a page can turn."""
    for pattern in patterns:
        for path, key in keys.items():
            value = case.at(path) if matches(path, pattern) else None
            listed = bool(key.choices) or key.kind == "switch"
            if value is not None and (listed or track(key, _number(value)) is not None):
                yield path


def matches(path: str, pattern: str) -> bool:
    """Tell whether a path has as many parts as a pattern, and each fits."""
    return path.count(".") == pattern.count(".") and fnmatchcase(path, pattern)


def text(key: Key, value: Value | None) -> str:
    """Return a value as a person writes it, empty where there is none."""
    return "" if value is None else written(key, value)


def shown_number(key: Key, value: Value | None) -> float | None:
    """Return a value as a number in the unit of its key; None for what is no number."""
    number = _number(value)
    if number is None or not key.unit:
        return number
    return float(f"{number_in(number, key.unit):.15g}")


def _number(value: Value | None) -> float | None:
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if plain else None  # type: ignore[arg-type]


#: Beginning of a meaning that continues from the name of its key.
_GOES_ON: Final = re.compile(r"(at|between|by|for|from|in|its|linear|of|over|where|which|with)\b")


def label(case: Case, key: Key) -> str:
    """Return a short label of a key.

    In a table that the user has named its path says more than its meaning, which all such tables share.
    """
    parts = key.path.split(".")
    for place in range(1, len(parts) - 1):
        if isinstance(case.at(".".join(parts[:place])), Tables):
            words = [part.replace("_", " ") for part in parts[place + 1 :] if part != VALUE]
            return f"{parts[place]}: {', '.join(words)}" if words else parts[place]
    meaning = re.split("[;:]", key.description)[0]
    return f"{parts[-1].replace('_', ' ')}, {meaning}" if _GOES_ON.match(meaning) else meaning


def _control(case: Case, key: Key, first: bool, lowest: float | None) -> dict[str, Any]:
    value = case.at(key.path)
    found = track(key, _number(value), lowest)
    return {
        "key": key.path,
        "label": label(case, key),
        "meaning": key.description,
        "kind": "list" if key.kind in LISTS else key.kind,
        "unit": key.unit,
        "text": text(key, value),
        "number": shown_number(key, value),
        **(_NO_TRACK if found is None else asdict(found)),
        "limits": key.limits,
        "allowed": key.allowed,
        "example": key.example,
        "source": key.source,
        "choices": list(key.choices),
        "first": first,
    }
