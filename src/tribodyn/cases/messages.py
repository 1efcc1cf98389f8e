"""Messages on unknown keys, on values that contradict each other, and on doubtful values."""

import difflib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from tribodyn.cases.fields import Entry, refused
from tribodyn.cases.keys import ANY_NAME, VALUE, Key, shown
from tribodyn.cases.tables import ALLOWED_NAME, as_declared, impossible_name, plain_path
from tribodyn.core.errors import MOST_HINTS, InputError
from tribodyn.core.quoting import OF_DIAMETERS, closest, meanings

_ALL_KEYS: Final = "`tribodyn show` lists all keys"
_LONGEST: Final = 200  #: Characters of a path that may be one that is misspelled.
_MOST_NEAR: Final = 3
CROSS_CHECK: Final = "cross_check"  #: Type of what pydantic receives from a table whose own path nobody knew.


def unknown(
    path: str, keys: Mapping[str, Key], declared: Mapping[str, Key], source: str, number: int
) -> InputError:
    """Return the message that a key does not exist, with a suggestion.

    ``path``: what was given; ``keys``: all that there are; ``declared``: those of the kind of case, before
    users name tables; ``source``: where it was given; ``number``: how many faults there were before.
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
    if inside and VALUE not in inside:
        return f"this is a table, not a value; its keys: {', '.join(inside)}"
    below = sorted({_shown(key.table) for key in declared.values() if key.table.startswith(f"{table}.")})
    if below:
        return f"this holds only tables: {', '.join(below)}"
    value = declared.get(as_declared(path.rpartition(".")[0], declared))
    if value is not None:
        example = value.example if value.example.startswith("[") else f'"{value.example}"'
        return f"unknown key; {value.name} is a value, not a table; write {value.name} = {example}"
    absent = _absent(path, keys, declared)
    return absent or f"unknown key; {_nearest(path, {**declared, **keys}) or _ALL_KEYS}"


def _absent(path: str, keys: Mapping[str, Key], declared: Mapping[str, Key]) -> str:
    """Return that the case has no such named table, and which one may be meant; empty where it has it."""
    known = plain_path(as_declared(path, declared), declared)
    if known not in declared:
        return ""
    parts, places = path.split("."), known.split(".")
    for k in (k for k, place in enumerate(places) if place == ANY_NAME):
        absent, others = ".".join(parts[: k + 1]), _inside(".".join(parts[:k]), keys)
        if parts[k] in others:
            continue
        near = difflib.get_close_matches(parts[k], others, n=1, cutoff=0.6)
        if near:
            return f"unknown key; {_nearest_valid('.'.join([others[near[0]], *parts[k + 1 :]]))}"
        there = f"it has: {', '.join(others)}; " if others else ""
        table = f"{absent} =" if len(parts) == k + 1 else f"a table [{absent}]"
        return f"the case has no {absent}; {there}write {table} into its file"
    return ""


def _shown(path: str) -> str:
    return path.replace(ANY_NAME, "NAME")


def _nearest(path: str, keys: Mapping[str, Key]) -> str:
    """Return the key that was probably meant: of the same table, a table by another word, the same name.

    Words of other programs come before names with words in common, and these before names that look alike.
    """
    table, _, name = path.rpartition(".")
    inside = _inside(table, keys)
    near = _by_words(name, inside, of=table.partition(".")[0])
    near = near or difflib.get_close_matches(name[:80], list(inside), n=1, cutoff=0.6)
    if near:
        half = ", half of this value" if name.casefold() in OF_DIAMETERS else ""
        return _nearest_valid(*(inside[word] for word in near)) + half
    renamed = _renamed(path, keys)
    if renamed:
        return _nearest_valid(renamed)
    words = [name] if inside else [name, table.rpartition(".")[2]]
    tables = {key.table for key in keys.values()}
    named = (word for given in words for word in meanings(given) if f"{word}.{ANY_NAME}" in tables)
    if (first := next(named, None)) is not None:
        return f"write a table [{first}.NAME]"
    named_so = ([key.path for key in keys.values() if key.name == word] for word in (name, *meanings(name)))
    elsewhere = next((paths for paths in named_so if paths), [])
    elsewhere = _sharing_most([other for other in elsewhere if ANY_NAME not in other] or elsewhere, path)
    of_a_part = ANY_NAME in as_declared(table, keys)
    if "." in table and inside and (not elsewhere or (of_a_part and len(elsewhere) > 1)):
        return f"keys of {table}: {', '.join(inside)}"
    meant = closest(path, elsewhere or keys) or next(iter(elsewhere), None)
    if table and meant and "." not in meant.removesuffix(f".{VALUE}"):
        return f"{_nearest_valid(meant)}, which stands above the first [table]"
    return _nearest_valid(meant) if meant else ""


def _sharing_most(paths: list[str], path: str) -> list[str]:
    """Return those of some paths that have most names in common with a path."""
    shared = [len({*path.split(".")} & {*other.split(".")}) for other in paths]
    return [other for other, number in zip(paths, shared, strict=True) if number == max(shared)]


def _renamed(path: str, keys: Mapping[str, Key]) -> str:
    """Return the key with one of the tables of its path by our word for it; empty where there is none.

    A name that a user gives to a table, such as that of a body, may be new.
    """
    parts = path.split(".")
    others = [
        ".".join([*parts[:k], word, *parts[k + 1 :]])
        for k, part in enumerate(parts[:-1])
        for word in meanings(part)
    ]
    near = difflib.get_close_matches(parts[0][:80], list(_inside("", keys)), n=1, cutoff=0.6)
    others += [".".join([*near, *parts[1:]])] if len(parts) > 1 else []
    return next((other for other in others if other in keys or as_declared(other, keys) in keys), "")


def _inside(table: str, keys: Mapping[str, Key]) -> dict[str, str]:
    """Return the paths of the keys of a table and of the tables in it, by their names."""
    prefix = f"{table}." if table else ""
    below = [key.path for key in keys.values() if key.path.startswith(prefix)]
    names = dict.fromkeys(path[len(prefix) :].partition(".")[0] for path in below)
    return {name: prefix + name for name in names if name != ANY_NAME}


def _by_words(name: str, names: Iterable[str], of: str) -> list[str]:
    """Return names that mean the same, or else that have all words of this one, or only words of it.

    ``name``: what was given; ``names``: what is possible; ``of``: kind of the table: among several the names
    with its word come first.
    """
    same = [word for word in (name.casefold(), *meanings(name)) if word in names]
    if same:
        return same[:1]
    given = set(name.casefold().split("_"))
    longer = [word for word in names if given < set(word.split("_"))]
    found = longer or [word for word in names if set(word.split("_")) < given]
    own = [word for word in found if any(of.startswith(part) for part in word.split("_"))]
    return (own or found)[:_MOST_NEAR]


def _nearest_valid(*paths: str) -> str:
    shortest = [_shown(path.removesuffix(f".{VALUE}")) for path in paths]
    return f"the nearest valid one is {' or '.join(shortest)}"


@dataclass(frozen=True)
class Remarks:
    """Notes on a case, one sentence each: warnings, and remarks that help to read its numbers."""

    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def __add__(self, other: "Remarks") -> "Remarks":
        """Return these and others."""
        return Remarks(self.warnings + other.warnings, self.notes + other.notes)


class Disagreement(InputError):
    """Values that are right by themselves do not go together."""


@dataclass(frozen=True)
class Asked:
    """Values from which a case is built."""

    keys: Mapping[str, Key]  #: All keys that there are.
    entries: Mapping[str, Entry]  #: What was given, by dotted path.
    source: str  #: Where the rest comes from.


def problems(error: ValidationError, asked: Asked) -> list[InputError]:
    """Turn the errors of pydantic into errors for users, one each."""
    return [problem for found in error.errors() for problem in _problem(found, asked)]


def _problem(found: ErrorDetails, asked: Asked) -> Iterator[InputError]:
    path = ".".join(str(part) for part in found["loc"])
    if found["type"] == CROSS_CHECK:
        context = found["ctx"]
        table = f"{path}." if context["here"] and path else ""
        for fault in context["faults"]:
            yield located(InputError(fault.reason, key=f"{table}{fault.key or ''}"), asked)
    elif found["type"] == "missing":
        table = path.rpartition(".")[0]
        inside = (entry.source for given, entry in asked.entries.items() if given.startswith(table))
        where = next(inside, asked.source)
        reason = f"this key is missing; allowed: {asked.keys[path].allowed}"
        yield InputError(reason, key=path, source=where)
    else:
        key = asked.keys.get(path)
        entry = asked.entries.get(path)
        given = entry or Entry(found["input"], asked.source)
        yield InputError(refused(key, given) if key else found["msg"], key=path, source=given.source)


def located(error: InputError, asked: Asked) -> Disagreement:
    """Add to the message of a cross-check what was given, and where."""
    path = error.key or ""
    entry = asked.entries.get(path)
    default = asked.keys[path].default if path in asked.keys else None
    if entry is not None:
        return Disagreement(f"given {shown(entry.value)}; {error.reason}", key=path, source=entry.source)
    held = "" if default is None else f"by default {asked.keys[path].write(default)}; "
    return Disagreement(held + error.reason, key=error.key, source=asked.source)
