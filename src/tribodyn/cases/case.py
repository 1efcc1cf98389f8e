"""What every case has in common: frozen groups of keys, building from what a user wrote, changed copies."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Self, TypeVar

from pydantic import (
    BaseModel,
    ConfigDict,
    ModelWrapValidatorHandler,
    PrivateAttr,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from tribodyn.cases import scans
from tribodyn.cases.columns import with_tables_read
from tribodyn.cases.entry import Entry, read_entry
from tribodyn.cases.fields import text
from tribodyn.cases.keys import Key, Value, family_names, keys_of
from tribodyn.cases.messages import CROSS_CHECK, first_problem, located, unknown
from tribodyn.cases.tables import (
    Tables,
    alternatives,
    expanded,
    keys_in,
    of_components,
    plain_path,
    value_at,
    with_components,
)
from tribodyn.cases.write import to_toml
from tribodyn.core.errors import InputError

_T = TypeVar("_T")
AnyCase = TypeVar("AnyCase", bound="Case")


class Group(BaseModel):
    """A table of a case file: frozen, and closed to keys it does not declare."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Pairs of its keys of which only one may be given."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=False)

    @field_validator("*", mode="after")
    @classmethod
    def _in_family(cls, value: _T, info: ValidationInfo) -> _T:
        extra = cls.model_fields[str(info.field_name)].json_schema_extra
        family = extra.get("family") if isinstance(extra, dict) else None
        if family and value not in family_names(str(family)):
            raise ValueError("not a member of the family")
        return value

    @field_validator("*", mode="after")
    @classmethod
    def _freeze(cls, value: Any) -> Any:
        return Tables(value) if isinstance(value, dict) else value


class NamedGroup(Group):
    """A table that a user names; keys in its :func:`demand` begin at the table itself."""

    @model_validator(mode="wrap")
    @classmethod
    def _locate(cls, values: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        """Let pydantic, which knows the name, say where a cross-check failed."""
        try:
            return handler(values)
        except InputError as error:
            context = {"reason": error.reason, "key": error.key or ""}
            raise PydanticCustomError(CROSS_CHECK, "{reason}", context) from None


class Case(Group):
    """A complete, validated description of one simulation; SI units throughout.

    Attribute paths are the paths of the case file: ``case.joint.clearance`` is ``clearance`` of
    the table ``[joint]``. Make one with :func:`tribodyn.load_case`, change it with :meth:`replace`.
    """

    case: str
    title: str = text("", "heading of figures and report")

    _given: dict[str, Any] = PrivateAttr(default_factory=dict)
    _scans: dict[str, Any] = PrivateAttr(default_factory=dict)

    @classmethod
    def kind(cls) -> str:
        """Return the name that stands under ``case =`` in a file."""
        return str(cls.model_fields["case"].default)

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that depend on what was given; by default there are none."""
        return {}

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        raise NotImplementedError

    @property
    def campaign_cycles(self) -> int:
        """Drive cycles of a wear campaign; 0 where the case asks for none."""
        return 0

    def at(self, path: str) -> Value | None:
        """Return the value at a dotted path, such as ``joint.clearance``."""
        found: Value | None = value_at(self, path)
        return found

    def replace(self, changes: Mapping[str, object], *, source: str = "replace") -> Self:
        """Return a copy with some keys changed; defaults that depend on them follow.

        Parameters
        ----------
        changes
            New values by dotted path, written as in a case file: ``{"joint.clearance": "30 um"}``. Tables
            with names of their own must be there.
        source
            Where the changes come from, for messages.
        """
        return _changed(self, changes, source)

    def to_toml(self, *, comments: bool = False) -> str:
        """Return the case as TOML that reads back to an equal case.

        Parameters
        ----------
        comments
            Whether each key is followed by what it means, where it comes from and what it may hold.
        """
        return to_toml(self, self.kind(), comments=comments)

    def __eq__(self, other: object) -> bool:
        """Cases are equal when all their values are, however they were spelled."""
        return isinstance(other, Case) and self.model_dump() == other.model_dump()

    def __hash__(self) -> int:
        """Hash of all values."""
        return hash(json.dumps(self.model_dump(), sort_keys=True))


def demand(condition: bool, key: str, message: str) -> None:
    """Raise an :class:`InputError` about `key` unless `condition` holds."""
    if not condition:
        raise InputError(message, key=key)


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
    declared = keys_of(model)
    keys = expanded(declared, list(entries))
    entries = {
        path if entry.value == {} else plain_path(path, keys): entry for path, entry in entries.items()
    }
    given = {path: entry for path, entry in entries.items() if not _is_empty_table(path, entry, declared)}
    entries = {path: entry for path, entry in given.items() if not _is_empty_table(path, entry, keys)}
    for path, entry in entries.items():
        if path not in keys:
            raise InputError(unknown(path, keys, declared), key=path, source=entry.source)
    _one_of_each(model, entries, keys)
    scanned = scans.scan_entries(entries)
    entries = with_tables_read(scans.with_scans_read(entries, keys), keys)
    values = {path: read_entry(keys[path], entry) for path, entry in entries.items()}
    named = [path.rpartition(".")[0] if path in keys else path for path in given if path not in declared]
    try:
        case = model.model_validate(_nested(model.resolve(values) | values, named))
    except ValidationError as error:
        raise first_problem(error, keys, entries, source) from None
    except InputError as error:
        raise located(error, keys, entries, source) from None
    in_order = {p: e for p, e in given.items() if p in entries or _is_empty_table(p, e, keys)}
    case._given.update(in_order | entries)
    case._scans.update(scanned)
    return case


def _changed(case: AnyCase, changes: Mapping[str, object], source: str) -> AnyCase:
    """Return a copy of `case` with `changes` made; see :meth:`Case.replace`."""
    keys = keys_in(case)
    known = with_components(keys)
    new: dict[str, Entry] = {}
    for path, value in changes.items():
        plain = plain_path(path, keys)
        if plain not in known:
            raise InputError(unknown(path, keys, keys_of(type(case))), key=path, source=source)
        if plain not in keys:
            plain, value = _vector(case, plain, value, known, new, source)
        new[plain] = Entry(value, source, text=True)
    kept = scans.entries_kept(case._given, case._scans, new)
    for pair in _alternatives(type(case), keys):
        if any(path in new for path in pair):
            for path in pair:
                kept.pop(path, None)
    result = build(type(case), kept | new, source)
    if not result._scans and not any(path in new for path in scans.FOLLOWING):
        result._scans.update(case._scans)
    return result


def _vector(
    case: Case, path: str, value: object, keys: Mapping[str, Key], new: Mapping[str, Entry], source: str
) -> tuple[str, object]:
    """Return path and value of the vector of which one component is changed."""
    read_entry(keys[path], Entry(value, source, text=True))
    whole, key = path[:-2], keys[path[:-2]]
    held = read_entry(key, new[whole]) if whole in new else case.at(whole)
    if not isinstance(held, tuple):
        raise InputError(f"{whole} is not given; give all three components", key=path, source=source)
    return whole, of_components(path, str(value), key, [float(number) for number in held])


def _is_empty_table(path: str, entry: Entry, keys: Mapping[str, Key]) -> bool:
    """Tell whether an entry is a table of the case that a file left empty."""
    return entry.value == {} and not entry.text and any(key.startswith(f"{path}.") for key in keys)


def _one_of_each(model: type[Case], entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> None:
    for first, second in _alternatives(model, keys):
        if first in entries and second in entries:
            raise InputError(
                f"give either {first} or {second}, not both", key=second, source=entries[second].source
            )


def _alternatives(model: type[Case], keys: Mapping[str, Key]) -> tuple[tuple[str, str], ...]:
    return (*alternatives(model, keys), *scans.ALTERNATIVES)


def _nested(values: Mapping[str, Value], tables: Iterable[str]) -> dict[str, Any]:
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
