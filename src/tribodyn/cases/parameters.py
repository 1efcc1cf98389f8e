"""Parameters of a case: numbers with names of their own, which its other values may be computed from."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Final

from tribodyn.cases.dimensions import Dimensioned, ExpressionProblem, described, dimensions_of, fits, unit_for
from tribodyn.cases.expressions import CONSTANTS, FUNCTIONS, evaluate, is_unit, names_in
from tribodyn.cases.fields import Entry, read_entry
from tribodyn.cases.keys import Key, Value, shown
from tribodyn.cases.known_units import EVERYDAY
from tribodyn.cases.units import (
    AMPLITUDES,
    LISTS,
    UnitProblem,
    counts_from_zero,
    si_unit,
    unit_of,
    with_shared_unit,
)
from tribodyn.core.errors import Faults, InputError

TABLE: Final = "parameters"
MOST: Final = 1000  #: Parameters of a case, at most.
_NUMBERS: Final = frozenset({"quantity", "number", "count"})
_NOT_FINITE: Final = {"nan", "inf", "infinity"}
_RESERVED: Final = frozenset({"at", *AMPLITUDES, *FUNCTIONS, *CONSTANTS, *EVERYDAY})


@dataclass(frozen=True)
class Scope:
    """The parameters of a case."""

    quantities: Mapping[str, Dimensioned] = field(default_factory=dict)  #: Their values, by their names.
    units: Mapping[str, str] = field(default_factory=dict)  #: In which they are shown.
    refused: Collection[str] = ()  #: Names of those that have no value.


def path_of(name: str) -> str:
    """Return the path of the key that holds a parameter."""
    return f"{TABLE}.{name}.value"


def keys_with_units(keys: Mapping[str, Key], units: Mapping[str, str]) -> Mapping[str, Key]:
    """Return keys of which those of parameters have their units; none for a plain number."""
    if not units:
        return keys
    found = dict(keys)
    for name, unit in units.items():
        if path_of(name) in keys:
            key = keys[path_of(name)]
            found[path_of(name)] = replace(key, unit=unit, kind="quantity" if unit else "number")
    return found


def scope_of(entries: Mapping[str, Entry], faults: Faults) -> Scope:
    """Return the parameters that entries define; each may be an expression of others.

    ``entries``: what was given, by dotted path; ``faults``: what is wrong is added to them.
    """
    given = {path.split(".")[1]: entry for path, entry in entries.items() if path.startswith(f"{TABLE}.")}
    quantities: dict[str, Dimensioned] = {}
    waiting: list[str] = []

    def value_of(name: str) -> Dimensioned:
        if name in waiting:
            refused.update(waiting)
            circle = " -> ".join([*waiting[waiting.index(name) :], name])
            raise ExpressionProblem(f"parameters are defined by each other: {circle}")
        if name not in quantities:
            waiting.append(name)
            try:
                quantities[name] = _value(given[name], _Lazy(given, value_of))
            finally:
                waiting.pop()
        return quantities[name]

    if len(given) > MOST:
        raise InputError(f"there are {len(given)}; at most {MOST} are possible", key=TABLE)
    refused: set[str] = set()
    sound: dict[str, Dimensioned] = {}
    units: dict[str, str] = {}
    for name, entry in given.items():
        if name in refused or _mentions(entry.value, refused):
            refused.add(name)
            continue
        with faults.noted():
            _check_name(name, entry)
            refused.add(name)
            try:
                found = value_of(name)
                units[name] = _unit(entry.value, found)
            except (ExpressionProblem, RecursionError) as problem:
                why = "it is defined by too many others" if isinstance(problem, RecursionError) else problem
                raise InputError(
                    f"given {shown(entry.value)}: {why}", key=f"{TABLE}.{name}", source=entry.source
                ) from None
            sound[name] = found
            refused.remove(name)
    return Scope(sound, units, refused)


def _check_name(name: str, entry: Entry) -> None:
    """Refuse a name that an expression could not contain, or that means something else there."""
    words = "a parameter has a name of letters, digits and _ that begins with a letter"
    sound = name.isidentifier() and name.isascii() and not name.startswith("_")
    if sound and name in _RESERVED:
        sound, words = False, f"{name} is a unit or a function already; choose another name"
    if not sound:
        raise InputError(words, key=f"{TABLE}.{name}", source=entry.source)


class _Lazy(Mapping[str, Dimensioned]):
    """Parameters by their names, each computed when an expression needs it."""

    def __init__(self, names: Collection[str], value_of: Callable[[str], Dimensioned]) -> None:
        self._names, self._value_of = names, value_of

    def __getitem__(self, name: str) -> Dimensioned:
        return self._value_of(name)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def _value(entry: Entry, scope: Mapping[str, Dimensioned]) -> Dimensioned:
    """Return the value of a parameter."""
    value = entry.value
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Dimensioned(float(value))
    if not isinstance(value, str):
        raise ExpressionProblem('a parameter is a number, or text such as "50 mm" or "2 * crank"')
    return evaluate(value, scope)


def _unit(value: object, found: Dimensioned) -> str:
    """Return the unit in which a parameter is shown: the one it was given in, or the SI unit."""
    try:
        unit = unit_of(str(value))
        if dimensions_of(unit) == found.dimensions:
            si_unit(unit)
            return unit
    except UnitProblem:
        pass
    return unit_for(found)


def unused_parameters(entries: Mapping[str, Entry], names: Collection[str]) -> list[str]:
    """Return the parameters that no other entry of a case is an expression of."""
    return [
        name
        for name in names
        if not any(_mentions(entry.value, {name}) for path, entry in entries.items() if path != path_of(name))
    ]


def read_all(
    entries: Mapping[str, Entry], keys: Mapping[str, Key], scope: Scope, faults: Faults
) -> tuple[dict[str, Value], dict[str, object]]:
    """Return the values that can be read, and note the others; and the expressions that some come from.

    Values that follow from a parameter without one are left out: that parameter is noted already.
    """
    values: dict[str, Value] = {}
    linked: dict[str, object] = {}
    for path, entry in entries.items():
        if _mentions(entry.value, scope.refused):
            continue
        with faults.noted():
            values[path], is_expression = read(keys[path], entry, scope)
            if is_expression:
                linked[path] = entry.value
    return values, linked


def read(key: Key, entry: Entry, scope: Scope) -> tuple[Value, bool]:
    """Return the value of a key, and whether it is computed from an expression.

    Raises InputError if it can be neither; the message names the key and the source.
    """
    if key.path.startswith(f"{TABLE}."):
        name = key.path.split(".")[1]
        return scope.quantities[name].value if name in scope.quantities else 0.0, isinstance(entry.value, str)
    if _mentions(entry.value, scope.quantities):
        return read_entry(key, _evaluated(key, entry, scope)), True
    try:
        return read_entry(key, entry), False
    except InputError as plain:
        try:
            return read_entry(key, _evaluated(key, entry, scope)), True
        except InputError as problem:
            raise (problem if scope.quantities and _is_text(key, entry.value) else plain) from None


def _is_text(key: Key, value: object) -> bool:
    """Return whether a value may be meant as an expression: it has names that are no units."""
    texts = value if isinstance(value, list | tuple) else (value,)
    names = {name for text in texts if isinstance(text, str) for name in names_in(text)}
    return key.kind in {*_NUMBERS, *LISTS} and any(not is_unit(name) for name in names - _NOT_FINITE)


def _mentions(value: object, names: Collection[str]) -> bool:
    """Return whether a value is an expression with one of these names."""
    if not names:
        return False
    if isinstance(value, list | tuple):
        return any(_mentions(part, names) for part in value)
    return isinstance(value, str) and not names_in(value).isdisjoint(names)


def _evaluated(key: Key, entry: Entry, scope: Scope) -> Entry:
    """Return an entry with the value of its expressions in SI units."""
    value = entry.value
    try:
        if key.kind in _NUMBERS and isinstance(value, str):
            return replace(entry, value=_in_si(key, value, scope))
        if key.kind in ("vector", "series") and isinstance(value, str | list | tuple):
            parts = _parts(value, key.unit) if isinstance(value, str) else value
            return replace(
                entry, value=[_in_si(key, part, scope) if isinstance(part, str) else part for part in parts]
            )
    except ExpressionProblem as problem:
        raise InputError(f"given {shown(value)}: {problem}", key=key.path, source=entry.source) from None
    return entry


def _in_si(key: Key, text: str, scope: Scope) -> object:
    found = evaluate(text, scope.quantities)
    wanted = dimensions_of(key.unit)
    if not fits(found.dimensions, wanted, found.turns) and (found.dimensions or found.value):
        words = f"it is {described(found.dimensions)}, and {described(wanted)} is needed"
        turning = " (2*pi times turns in some time is an angular speed)" if found.turns > 0 else ""
        raise ExpressionProblem(words + turning)
    if found.is_difference and key.unit and counts_from_zero(key.unit):
        raise ExpressionProblem("it is a difference of temperatures, and a temperature is needed")
    return f"{found.value!r} {si_unit(key.unit)}" if key.unit else found.value


def _parts(text: str, unit: str) -> list[str]:
    """Return the elements of a text with commas, none inside parentheses."""
    plain, depth, parts = text.strip().removeprefix("[").removesuffix("]"), 0, [""]
    for character in plain:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    texts = [part.strip().strip("\"'") for part in parts]
    return with_shared_unit(texts) if unit else texts
