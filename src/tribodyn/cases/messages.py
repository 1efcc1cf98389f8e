"""What a user is told when keys are unknown or values do not go together."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from typing import Final

from pydantic import ValidationError

from tribodyn.cases.entry import Entry, closest, refused
from tribodyn.cases.keys import ANY_NAME, Key, shown
from tribodyn.cases.tables import ALLOWED_NAME, general, impossible_name
from tribodyn.core.errors import InputError

CROSS_CHECK: Final = "cross_check"
"""Type of what pydantic is told by a table whose own path nobody knew."""


def unknown(path: str, keys: Mapping[str, Key], declared: Mapping[str, Key]) -> str:
    """Say that there is no such key, and which one may have been meant.

    Parameters
    ----------
    path
        What was given.
    keys
        All that there are.
    declared
        Those of the kind of case, before users name tables.
    """
    name = impossible_name(path, declared)
    if name is not None:
        return f"given {shown(name)}; allowed: {ALLOWED_NAME}"
    table = general(path, declared)
    inside = [key.name for key in declared.values() if key.table == table]
    if inside:
        return f"this is a table, not a value; its keys: {', '.join(inside)}"
    below = sorted({_shown(key.table) for key in declared.values() if key.table.startswith(f"{table}.")})
    if below:
        return f"this holds only tables: {', '.join(below)}"
    near = _nearest_key(path, {**declared, **keys})
    return "unknown key" + (
        f"; the nearest valid one is {_shown(near)}" if near else "; `tribodyn show` lists all keys"
    )


def _shown(path: str) -> str:
    return path.replace(ANY_NAME, "NAME")


def _nearest_key(path: str, keys: Mapping[str, Key]) -> str | None:
    """Return the key that was probably meant: one of the same table first, then the same name."""
    table, _, name = path.rpartition(".")
    siblings = {key.name: key.path for key in keys.values() if key.table == table}
    near = difflib.get_close_matches(name[:80], list(siblings), n=1, cutoff=0.6)
    if near:
        return siblings[near[0]]
    elsewhere = [key.path for key in keys.values() if key.name == name]
    return closest(path, elsewhere or keys) or (elsewhere[0] if elsewhere else None)


def first_problem(
    error: ValidationError, keys: Mapping[str, Key], entries: Mapping[str, Entry], source: str
) -> InputError:
    """Turn pydantic's first finding into the message a user sees."""
    found = error.errors()[0]
    path = ".".join(str(part) for part in found["loc"])
    if found["type"] == CROSS_CHECK:
        path, reason = f"{path}.{found['ctx']['key']}", str(found["ctx"]["reason"])
        return located(InputError(reason, key=path), keys, entries, source)
    if found["type"] == "missing":
        where = next(
            (entry.source for given, entry in entries.items() if given.startswith(_table(path))), source
        )
        return InputError(f"this key is missing; allowed: {keys[path].allowed}", key=path, source=where)
    entry = entries.get(path) or Entry(keys[path].default, source)
    return InputError(refused(keys[path], entry), key=path, source=entry.source)


def _table(path: str) -> str:
    return path.rpartition(".")[0]


def located(
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
