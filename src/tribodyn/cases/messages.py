"""What a user is told when keys are unknown or values do not go together, and of values that do."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from tribodyn.cases.entry import Entry, refused
from tribodyn.cases.keys import ANY_NAME, Key, shown
from tribodyn.cases.tables import ALLOWED_NAME, as_declared, impossible_name
from tribodyn.core.errors import MOST_HINTS, InputError
from tribodyn.core.quoting import closest
from tribodyn.core.synonyms import OF_DIAMETERS, meanings

_ALL_KEYS: Final = "`tribodyn show` lists all keys"
_LONGEST: Final = 200
"""Characters of a path that may be one that is misspelled."""
CROSS_CHECK: Final = "cross_check"
"""Type of what pydantic is told by a table whose own path nobody knew."""


def unknown(
    path: str, keys: Mapping[str, Key], declared: Mapping[str, Key], source: str, number: int
) -> InputError:
    """Return what says that there is no such key, and which one may have been meant.

    Parameters
    ----------
    path
        What was given.
    keys
        All that there are.
    declared
        Those of the kind of case, before users name tables.
    source
        Where it was given.
    number
        How many faults there were before.
    """
    searched = number < MOST_HINTS and len(path) <= _LONGEST
    reason = _unknown(path, keys, declared) if searched else f"unknown key; {_ALL_KEYS}"
    return InputError(reason, key=path, source=source)


def _unknown(path: str, keys: Mapping[str, Key], declared: Mapping[str, Key]) -> str:
    name = impossible_name(path, declared)
    if name is not None:
        return f"given {shown(name)}; allowed: {ALLOWED_NAME}"
    table = as_declared(path, declared)
    inside = [key.name for key in declared.values() if key.table == table]
    if inside:
        return f"this is a table, not a value; its keys: {', '.join(inside)}"
    below = sorted({_shown(key.table) for key in declared.values() if key.table.startswith(f"{table}.")})
    if below:
        return f"this holds only tables: {', '.join(below)}"
    value = declared.get(as_declared(path.rpartition(".")[0], declared))
    if value is not None:
        example = value.example if value.example.startswith("[") else f'"{value.example}"'
        return f"unknown key; {value.name} is a value, not a table; write {value.name} = {example}"
    absent = _absent(path, keys, declared)
    if absent:
        return f"the case has no {absent}; write a table [{absent}] into its file"
    return f"unknown key; {_nearest(path, {**declared, **keys}) or _ALL_KEYS}"


def _absent(path: str, keys: Mapping[str, Key], declared: Mapping[str, Key]) -> str:
    """Return the named table that a key needs, where the case has none of its kind; else empty."""
    known = as_declared(path, declared)
    if known not in declared:
        return ""
    parts, places = path.split("."), known.split(".")
    for k in (k for k, place in enumerate(places) if place == ANY_NAME):
        if not any(key.startswith(f"{'.'.join(parts[:k])}.") for key in keys):
            return ".".join(parts[: k + 1])
    return ""


def _shown(path: str) -> str:
    return path.replace(ANY_NAME, "NAME")


def _nearest(path: str, keys: Mapping[str, Key]) -> str:
    """Return what was probably meant: a key of the same table, a table by another word, the same name.

    Words of other programs come before words that look alike.
    """
    table, _, name = path.rpartition(".")
    siblings = {key.name: key.path for key in keys.values() if key.table == table}
    tables = {key.table for key in keys.values()}
    beside = {word: f"{table}.{word}" for word in meanings(name) if f"{table}.{word}" in tables}
    near = [word for word in meanings(name) if word in siblings or word in beside]
    near = near or difflib.get_close_matches(name[:80], list(siblings), n=1, cutoff=0.6)
    if near:
        half = ", half of this value" if name.casefold() in OF_DIAMETERS else ""
        return _nearest_valid((siblings | beside)[near[0]]) + half
    renamed = _renamed(path, keys)
    if renamed:
        return _nearest_valid(renamed)
    words = [name] if as_declared(table, keys) in tables else [name, table.rpartition(".")[2]]
    named = (word for given in words for word in meanings(given) if f"{word}.{ANY_NAME}" in tables)
    if (first := next(named, None)) is not None:
        return f"write a table [{first}.NAME]"
    named_so = ([key.path for key in keys.values() if key.name == word] for word in (name, *meanings(name)))
    elsewhere = next((paths for paths in named_so if paths), [])
    meant = closest(path, elsewhere or keys) or next(iter(elsewhere), None)
    return _nearest_valid(meant) if meant else ""


def _renamed(path: str, keys: Mapping[str, Key]) -> str:
    """Return the key with one of the tables of its path by our word for it; empty where there is none."""
    parts = path.split(".")
    others = (
        ".".join([*parts[:k], word, *parts[k + 1 :]])
        for k, part in enumerate(parts[:-1])
        for word in meanings(part)
    )
    return next((other for other in others if other in keys), "")


def _nearest_valid(path: str) -> str:
    return f"the nearest valid one is {_shown(path)}"


@dataclass(frozen=True)
class Remarks:
    """What a case says of itself, one sentence each: warnings, and what to know when its numbers are read."""

    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def __add__(self, other: Remarks) -> Remarks:
        """Return these and others."""
        return Remarks(self.warnings + other.warnings, self.notes + other.notes)


class Disagreement(InputError):
    """Values that are right by themselves do not go together."""


@dataclass(frozen=True)
class Asked:
    """What a case is built from.

    Attributes
    ----------
    keys
        All keys that there are.
    entries
        What was given, by dotted path.
    source
        Where the rest comes from.
    """

    keys: Mapping[str, Key]
    entries: Mapping[str, Entry]
    source: str


def problems(error: ValidationError, asked: Asked) -> list[InputError]:
    """Turn what pydantic found into what a user is told, one error each."""
    return [told for found in error.errors() for told in _problem(found, asked)]


def _problem(found: ErrorDetails, asked: Asked) -> Iterator[InputError]:
    path = ".".join(str(part) for part in found["loc"])
    if found["type"] == CROSS_CHECK:
        context = found["ctx"]
        table = f"{path}." if context["here"] else ""
        for fault in context["faults"]:
            yield located(InputError(fault.reason, key=f"{table}{fault.key or ''}"), asked)
    elif found["type"] == "missing":
        inside = (entry.source for given, entry in asked.entries.items() if given.startswith(_table(path)))
        where = next(inside, asked.source)
        reason = f"this key is missing; allowed: {asked.keys[path].allowed}"
        yield InputError(reason, key=path, source=where)
    else:
        key = asked.keys.get(path)
        entry = asked.entries.get(path)
        given = entry or Entry(found["input"], asked.source)
        yield InputError(refused(key, given) if key else found["msg"], key=path, source=given.source)


def _table(path: str) -> str:
    return path.rpartition(".")[0]


def located(error: InputError, asked: Asked) -> Disagreement:
    """Add to the message of a cross-check what was given, and where."""
    path = error.key or ""
    entry = asked.entries.get(path)
    default = asked.keys[path].default if path in asked.keys else None
    if entry is not None:
        return Disagreement(f"given {shown(entry.value)}; {error.reason}", key=path, source=entry.source)
    held = "" if default is None else f"by default {asked.keys[path].write(default)}; "
    return Disagreement(held + error.reason, key=error.key, source=asked.source)
