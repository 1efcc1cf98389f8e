"""From what a user wrote, key by key, to a validated case."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from tribodyn.cases import scans
from tribodyn.cases.base import Case
from tribodyn.cases.keys import Key, Value, ValueProblem, keys_of, shown
from tribodyn.core.errors import InputError

AnyCase = TypeVar("AnyCase", bound=Case)


@dataclass(frozen=True)
class Entry:
    """One value as the user wrote it.

    Attributes
    ----------
    value
        As parsed from TOML or given in Python.
    source
        File or option that holds it.
    text
        Whether numbers and switches may be spelled as text.
    folder
        Where the names of files begin; None is the current directory.
    """

    value: object
    source: str
    text: bool = False
    folder: Path | None = None


def build(model: type[AnyCase], entries: Mapping[str, Entry], source: str) -> AnyCase:
    """Return the validated case that `entries` describe.

    Parameters
    ----------
    model
        The kind of case.
    entries
        What was given, by dotted path.
    source
        Named in messages about values that were not given.
    """
    keys = keys_of(model)
    entries = {path: entry for path, entry in entries.items() if not _empty_table(path, entry, keys)}
    for path, entry in entries.items():
        if path not in keys:
            raise InputError(_unknown(path, keys), key=path, source=entry.source)
    _one_of_each(model, entries)
    named = scans.scan_entries(entries)
    entries = scans.with_scans_read(entries, keys)
    values = {path: read_entry(keys[path], entry) for path, entry in entries.items()}
    try:
        case = model.model_validate(_nested(model.resolve(values) | values))
    except ValidationError as error:
        raise _first_problem(error, keys, entries, source) from None
    except InputError as error:
        raise _located(error, keys, entries, source) from None
    case._given.update(entries)
    case._scans.update(named)
    return case


def changed(case: AnyCase, changes: Mapping[str, object], source: str) -> AnyCase:
    """Return a copy of `case` with `changes` made; see :meth:`Case.replace`."""
    new = {path: Entry(value, source, text=True) for path, value in changes.items()}
    kept = scans.entries_kept(case._given, case._scans, new)
    for pair in _alternatives(type(case)):
        if any(path in new for path in pair):
            for path in pair:
                kept.pop(path, None)
    result = build(type(case), kept | new, source)
    if not result._scans and not any(path in new for path in scans.FOLLOWING):
        result._scans.update(case._scans)
    return result


def closest(word: str, words: Iterable[str]) -> str | None:
    """Return the one of `words` that is spelled most like `word`, if any is near."""
    found = difflib.get_close_matches(word[:80], list(words), n=1, cutoff=0.5)
    return found[0] if found else None


def read_entry(key: Key, entry: Entry) -> Value:
    """Return the value of a key, or raise an error that says what it may hold."""
    try:
        return key.read(entry.value, text=entry.text)
    except ValueProblem as problem:
        raise InputError(_refused(key, entry, str(problem)), key=key.path, source=entry.source) from None


def _refused(key: Key, entry: Entry, why: str = "") -> str:
    """Say what was given, why it cannot be, and what can."""
    near = closest(entry.value, key.choices) if isinstance(entry.value, str) and key.choices else None
    reason = f": {why}" if why else ""
    hint = f'; did you mean "{near}"?' if near else ""
    return f"given {shown(entry.value)}{reason}; allowed: {key.allowed}{hint}"


def _unknown(path: str, keys: Mapping[str, Key]) -> str:
    """Say that there is no such key, and which one may have been meant."""
    inside = [key.name for key in keys.values() if key.table == path]
    if inside:
        return f"this is a table, not a value; its keys: {', '.join(inside)}"
    below = sorted({key.table for key in keys.values() if key.table.startswith(f"{path}.")})
    if below:
        return f"this holds only tables: {', '.join(below)}"
    near = _nearest_key(path, keys)
    return "unknown key" + (
        f"; the nearest valid one is {near}" if near else "; `tribodyn show` lists all keys"
    )


def _nearest_key(path: str, keys: Mapping[str, Key]) -> str | None:
    """Return the key that was probably meant: one of the same table first, then the same name."""
    table, _, name = path.rpartition(".")
    siblings = {key.name: key.path for key in keys.values() if key.table == table}
    near = difflib.get_close_matches(name[:80], list(siblings), n=1, cutoff=0.6)
    if near:
        return siblings[near[0]]
    elsewhere = [key.path for key in keys.values() if key.name == name]
    return closest(path, elsewhere or keys) or (elsewhere[0] if elsewhere else None)


def _empty_table(path: str, entry: Entry, keys: Mapping[str, Key]) -> bool:
    """Tell whether an entry is a table of the case that a file left empty."""
    return entry.value == {} and not entry.text and any(key.startswith(f"{path}.") for key in keys)


def _one_of_each(model: type[Case], entries: Mapping[str, Entry]) -> None:
    for first, second in _alternatives(model):
        if first in entries and second in entries:
            raise InputError(
                f"give either {first} or {second}, not both", key=second, source=entries[second].source
            )


def _alternatives(model: type[Case]) -> tuple[tuple[str, str], ...]:
    return (*model.ALTERNATIVES, *scans.ALTERNATIVES)


def _nested(values: Mapping[str, Value]) -> dict[str, Any]:
    """Turn dotted paths into nested tables."""
    tree: dict[str, Any] = {}
    for path, value in values.items():
        *tables, name = path.split(".")
        branch = tree
        for table in tables:
            branch = branch.setdefault(table, {})
        branch[name] = value
    return tree


def _first_problem(
    error: ValidationError, keys: Mapping[str, Key], entries: Mapping[str, Entry], source: str
) -> InputError:
    """Turn pydantic's first finding into the message a user sees."""
    path = ".".join(str(part) for part in error.errors()[0]["loc"])
    entry = entries.get(path) or Entry(keys[path].default, source)
    return InputError(_refused(keys[path], entry), key=path, source=entry.source)


def _located(
    error: InputError, keys: Mapping[str, Key], entries: Mapping[str, Entry], source: str
) -> InputError:
    """Add to the message of a cross-check what was given, and where."""
    path = error.key or ""
    entry = entries.get(path)
    default = keys[path].default if path in keys else None
    if entry is not None:
        return InputError(f"given {shown(entry.value)}; {error.reason}", key=path, source=entry.source)
    held = "" if default is None else f"by default {keys[path].write(default)}; "
    return InputError(held + error.reason, key=error.key, source=source)
