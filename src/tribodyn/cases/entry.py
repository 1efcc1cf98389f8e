"""One value as a user wrote it, and how it is read."""

from dataclasses import dataclass
from pathlib import Path

from tribodyn.cases.keys import Key, Value, ValueProblem, shown
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import meant


@dataclass(frozen=True)
class Entry:
    """One value as the user wrote it."""

    value: object  #: As parsed from TOML or given in Python.
    source: str  #: File or option that holds it.
    text: bool = False  #: Whether numbers and switches may be spelled as text.
    folder: Path | None = None  #: Where the names of files begin; None is the current directory.
    built_in: bool = False  #: Whether a built-in case gives it, and no user.
    origin: str = ""  #: Where a value of a built-in case comes from, if it says so.


def read_entry(key: Key, entry: Entry) -> Value:
    """Return the value of a key, or raise an error that says what it may hold."""
    try:
        return key.read(entry.value, text=entry.text)
    except ValueProblem as problem:
        raise InputError(refused(key, entry, str(problem)), key=key.path, source=entry.source) from None


def refused(key: Key, entry: Entry, why: str = "") -> str:
    """Report the value, the reason of its refusal, and the allowed values."""
    reason = f": {why}" if why else ""
    hint = meant(entry.value, key.choices) if isinstance(entry.value, str) else ""
    return f"given {shown(entry.value)}{reason}; allowed: {key.allowed}{hint}"
