"""Models edited on a page: a template or the case of the workbench, with tables added and removed."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Final

from tribodyn.cases.case import Case, with_entries
from tribodyn.cases.keys import ANY_NAME, VALUE, Key, keys_of
from tribodyn.cases.tables import keys_at, plain_path
from tribodyn.core.errors import Faults, InputError
from tribodyn.mechanisms.catalogue import MECHANISMS, parse_case, template
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.workbench.controls import FILE, matches
from tribodyn.workbench.messages import Edit, Values
from tribodyn.workbench.variant import NO_FILES, Origin

#: Keys that name a part, with the table of that part.
_NAMED: Final = {"between": "bodies", "body": "bodies", "joint": "joints"}


def edited(origin: Origin, edit: Edit) -> Origin:
    """Return the case that a page has edited, as where its runs come from.

    ``origin``: the case of the workbench; ``edit``: what differs. Raises InputError if there is no such
    template or table, a key names a file, or the model is invalid.
    """
    if edit == Edit():
        return origin
    start = origin
    if edit.template:
        text = template(edit.template)
        start = Origin(parse_case(text, edit.template), edit.template)
    if not edit.removed and not edit.added:
        return replace(start, edited=True)
    _check_removed(start.case, edit.removed)
    _check_added(start.case, edit.added)
    case = with_entries(start.case, edit.added, "", without=edit.removed)
    return Origin(case, start.name, edited=True)


def _check_removed(case: Case, removed: tuple[str, ...]) -> None:
    """Refuse tables that every case of this kind has; one that is not there need not be removed."""
    for table in removed:
        if not _is_removable(case, table):
            known = ", ".join(pattern.replace(ANY_NAME, "NAME") for pattern in _tables(case))
            raise InputError(f"this cannot be removed; allowed: {known or 'nothing'}", key=table)


def _check_added(case: Case, added: Values) -> None:
    """Refuse keys that name files; all others are checked with the case."""
    keys = keys_at(type(case), added)
    faults = Faults()
    for path in added:
        key = keys.get(plain_path(path, keys))
        with faults.noted():
            if key is not None and key.kind == FILE:
                raise InputError(NO_FILES, key=path)
    faults.raise_any()


def removable(case: Case) -> tuple[str, ...]:
    """Return the dotted paths of the tables of a case that a page can remove, each before those inside it."""
    tables = dict.fromkeys(table for path in case.given_paths for table in _above(path))
    return tuple(table for table in tables if _is_removable(case, table))


def _is_removable(case: Case, table: str) -> bool:
    return any(matches(table, pattern) for pattern in _tables(case))


def _above(path: str) -> Iterator[str]:
    """Yield the tables that a path stands in, the outermost first, and the path itself."""
    steps = path.split(".")
    for length in range(1, len(steps) + 1):
        yield ".".join(steps[:length])


def _tables(case: Case) -> Iterator[str]:
    """Yield the patterns of the tables that a page can remove: those that it adds, and all named ones."""
    named = (path.partition(ANY_NAME)[0] for path in keys_of(type(case)) if ANY_NAME in path)
    yield from dict.fromkeys((*MECHANISMS[case.kind()].parts, *(f"{table}{ANY_NAME}" for table in named)))


def addable(case: Case, mechanism: MechanismDescriptor) -> list[dict[str, Any]]:
    """Return the tables that a page can add to a case, each with the fields of its form."""
    keys = keys_of(type(case))
    names = {table: list(getattr(case, table, ())) for table in set(_NAMED.values())}
    return [
        {
            "table": pattern,
            "parents": _parents(case, pattern),
            "fields": [_field(keys[f"{pattern}.{name}"], name, names) for name in shown],
        }
        for pattern, shown in mechanism.parts.items()
    ]


def _parents(case: Case, pattern: str) -> list[str] | None:
    """Return the names of the parts that can have such a table and have none; None of a part of its own."""
    table, _, inside = pattern.partition(f".{ANY_NAME}")
    if not inside:
        return None
    return [name for name in getattr(case, table) if case.at(f"{table}.{name}{inside}") is None]


def _field(key: Key, name: str, names: Mapping[str, list[str]]) -> dict[str, Any]:
    """Return a key as a form asks for it.

    ``known`` are the names that it can hold, and ``many`` is how many of them it holds.
    """
    table = _NAMED.get(name, "")
    return {
        "name": name,
        "label": name.removesuffix(f".{VALUE}").replace("_", " "),
        "meaning": key.description,
        "choices": list(key.choices),
        "known": (["ground"] if name == "between" else []) + names.get(table, []),
        "many": key.length or 1,
        "example": key.example,
    }
