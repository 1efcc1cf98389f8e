"""Tables that a user names, as ``[joints.crankpin]``: their keys, once the names are known.

Such a field is declared with :func:`tribodyn.cases.fields.tables`. Its keys are known as
``joints.*.clearance`` before there is a case, and as ``joints.crankpin.clearance`` in one.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache, lru_cache
from itertools import groupby
from types import MappingProxyType
from typing import Any, Final, NoReturn

from pydantic import BaseModel

from tribodyn.cases.fields import Entry
from tribodyn.cases.keys import ANY_NAME, VALUE, Key, Value, groups_of, keys_of
from tribodyn.cases.parameters import keys_with_units
from tribodyn.cases.units import AXES, from_si

#: Message for an attempt to change a case.
FROZEN: Final = 'a case is frozen; replace({"joint.clearance": "30 um"}) returns a changed copy'
LONGEST_NAME: Final = 40
ALLOWED_NAME: Final = f"a name of letters without accents, digits, - and _, at most {LONGEST_NAME} of them"
_QUOTED: Final = re.compile(r'"((?:[^"\\]|\\.)*)"')
#: Names that users choose, with the numbers of a copy of a pattern and of a node of an elastic body.
_PLAIN: Final = re.compile(r"[A-Za-z0-9_-]+(\[\d+\])?(:\d+)?")
_NAME: Final = re.compile(rf"(?=[A-Za-z0-9_-]{{1,{LONGEST_NAME}}}(\[|:|$)){_PLAIN.pattern}")


def is_name(text: str) -> bool:
    """Tell whether a text may be a name, however long, that needs no quotes in dotted paths."""
    return _PLAIN.fullmatch(text) is not None


class Tables(dict[str, Any]):
    """Tables by their names; frozen, as all of a case is."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError(FROZEN)

    __setitem__ = __delitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy as a whole: filling is refused."""
        return type(self), (dict(self),)


def expanded(declared: Mapping[str, Key], paths: Iterable[str]) -> dict[str, Key]:
    """Return the keys that there are, given the names of tables in some dotted paths.

    ``declared``: from :func:`tribodyn.cases.keys.keys_of`; ``paths``: of keys and tables; names that none can
    have are passed over.
    """
    found: dict[str, Key] = {}
    for before, group in groupby(declared.values(), key=lambda key: _before_name(key.path)):
        keys = {key.path: key for key in group}
        if before is None:
            found |= keys
            continue
        below = [path for path in paths if path.startswith(before)]
        for name in dict.fromkeys(path[len(before) :].partition(".")[0] for path in below):
            if _NAME.fullmatch(name):
                named = (key.at(key.path.replace(ANY_NAME, name, 1)) for key in keys.values())
                found |= expanded({key.path: key for key in named}, below)
    return found


def keys_in(case: BaseModel) -> Mapping[str, Key]:
    """Return every key of a case, by dotted path, with those of the tables that it names or was given."""
    declared = keys_of(type(case))
    if not any(ANY_NAME in path for path in declared):
        return declared
    there = keys_at(type(case), [*_paths(case), *(getattr(case, "_written", None) or {})])
    return keys_with_units(there, getattr(case, "_units", None) or {})


def keys_at(model: type[BaseModel], paths: Iterable[str]) -> Mapping[str, Key]:
    """Return the keys of a case of a kind with values or tables at some dotted paths."""
    return _keys_at(model, tuple(paths))


# Large cases are asked for them many times, and those of a sweep have the same paths.
@lru_cache(maxsize=8)
def _keys_at(model: type[BaseModel], paths: tuple[str, ...]) -> Mapping[str, Key]:
    return MappingProxyType(expanded(keys_of(model), paths))


def value_at(case: BaseModel, path: str) -> Any:
    """Return the value of a case at a dotted path; None in a table that is not there."""
    value: Any = case
    for name in path.split("."):
        if value is None:
            return None
        if isinstance(value, tuple):
            value = value[AXES.index(name)]
        else:
            # By what mappings are made of: to ask for their protocol takes ten times as long.
            value = value.get(name) if isinstance(value, dict | MappingProxyType) else getattr(value, name)
    return value


def with_components(keys: Mapping[str, Key]) -> dict[str, Key]:
    """Return keys with those of the components of vectors: ``point.x``."""
    components = {
        f"{path}.{axis}": replace(
            key,
            path=f"{path}.{axis}",
            kind="quantity" if key.unit else "number",
            example=f"0 {key.unit}".strip(),
            length=0,
            required=False,
        )
        for path, key in keys.items()
        if key.kind == "vector"
        for axis in AXES
    }
    return {**keys, **components}


def plain_path(path: str, keys: Mapping[str, Key]) -> str:
    """Return the path of the key that a path means: a table that has a key ``value`` stands for it."""
    return f"{path}.{VALUE}" if path not in keys and f"{path}.{VALUE}" in keys else path


def plain_entries(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return entries by the paths of the keys that their paths mean; empty tables keep their paths."""
    return {path if entry.value == {} else plain_path(path, keys): entry for path, entry in entries.items()}


def of_components(path: str, text: str, key: Key, value: Sequence[float]) -> list[str]:
    """Return a vector as a user writes it, of which one component is replaced.

    ``path``: of the component; ``text``: what it is to be.
    """
    place = AXES.index(path[-1])
    numbers = [from_si(number, key.unit) if key.unit else repr(number) for number in value]
    return [text if i == place else number for i, number in enumerate(numbers)]


def impossible_name(path: str, declared: Mapping[str, Key]) -> str | None:
    """Return the first name in a dotted path that no table can have."""
    steps = path.split(".")
    for key in declared.values():
        pattern = key.path.split(".")
        for place, step in enumerate(pattern[: len(steps)]):
            if step == ANY_NAME and not _NAME.fullmatch(steps[place]):
                rest = ".".join(steps[place:])
                quoted = _QUOTED.match(rest)
                return quoted[1] if quoted else rest
            if step not in (ANY_NAME, steps[place]):
                break
    return None


def alternatives(model: type[BaseModel], keys: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """Return the pairs of some keys of which only one may be given, as the groups of a case declare them."""
    tables = dict.fromkeys(path.rpartition(".")[0] for path in keys)
    return tuple(
        (f"{prefix}{first}", f"{prefix}{second}")
        for pattern, pairs in _declared_pairs(model)
        for table in tables
        if re.fullmatch(pattern, table)
        for prefix in [f"{table}." if table else ""]
        for first, second in pairs
    )


@cache
def _declared_pairs(
    model: type[BaseModel], pattern: str = ""
) -> tuple[tuple[str, tuple[tuple[str, str], ...]], ...]:
    """Return the pairs that each table declares, by a pattern of its dotted path."""
    own = getattr(model, "ALTERNATIVES", ())
    below = [
        entry
        for path, group in groups_of(model)
        for part in [re.escape(path).replace(re.escape(ANY_NAME), "[^.]+")]
        for entry in _declared_pairs(group, f"{pattern}{re.escape('.') if pattern else ''}{part}")
    ]
    return (((pattern, own), *below)) if own else tuple(below)


def as_declared(path: str, declared: Mapping[str, Key]) -> str:
    """Return the dotted path of a key or table as it is declared: without the names that a user chose."""
    steps = path.split(".")
    for key in declared.values():
        pattern = key.path.split(".")[: len(steps)]
        if len(pattern) == len(steps) and all(
            place in (ANY_NAME, step) for place, step in zip(pattern, steps, strict=True)
        ):
            return ".".join(pattern)
    return path


def _before_name(path: str) -> str | None:
    """Return the path before the first name that a user chooses; None if there is none."""
    before, name, _ = path.partition(ANY_NAME)
    return before if name else None


def _paths(values: BaseModel | Mapping[str, Any], prefix: str = "") -> list[str]:
    """Return the dotted paths of all values."""
    found: list[str] = []
    for name in type(values).model_fields if isinstance(values, BaseModel) else values:
        value = values[name] if isinstance(values, dict) else getattr(values, name)
        inside = isinstance(value, BaseModel | dict)
        found += _paths(value, f"{prefix}{name}.") if inside else [prefix + name]
    return found


def empty_tables(entries: Mapping[str, Entry], keys: Iterable[str]) -> set[str]:
    """Return the paths of the entries that are tables of some keys and that a file left empty."""
    found = {path for path, entry in entries.items() if entry.value == {} and not entry.text}
    return found and found & {path[: dot.start()] for path in keys for dot in re.finditer(r"\.", path)}


def nested(values: Mapping[str, Value], tables: Iterable[str]) -> dict[str, Any]:
    """Turn dotted paths into nested tables, of which some are there even without a value."""
    tree: dict[str, Any] = {}
    for path in tables:
        _branch(tree, path.split("."))
    for path, value in values.items():
        *above, name = path.split(".")
        _branch(tree, above)[name] = value
    return tree


def _branch(tree: dict[str, Any], tables: Iterable[str]) -> dict[str, Any]:
    for table in tables:
        tree = tree.setdefault(table, {})
    return tree
