"""One value as a user wrote it, and how it is read."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from tribodyn.cases.keys import Key, Value, ValueProblem, shown
from tribodyn.core.errors import InputError


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


def closest(word: str, words: Iterable[str]) -> str | None:
    """Return the one of `words` that is spelled most like `word`, if any is near."""
    found = difflib.get_close_matches(word[:80], list(words), n=1, cutoff=0.5)
    return found[0] if found else None


def read_entry(key: Key, entry: Entry) -> Value:
    """Return the value of a key, or raise an error that says what it may hold."""
    try:
        return key.read(entry.value, text=entry.text)
    except ValueProblem as problem:
        raise InputError(refused(key, entry, str(problem)), key=key.path, source=entry.source) from None


def refused(key: Key, entry: Entry, why: str = "") -> str:
    """Say what was given, why it cannot be, and what can."""
    near = closest(entry.value, key.choices) if isinstance(entry.value, str) and key.choices else None
    reason = f": {why}" if why else ""
    hint = f'; did you mean "{near}"?' if near else ""
    return f"given {shown(entry.value)}{reason}; allowed: {key.allowed}{hint}"
