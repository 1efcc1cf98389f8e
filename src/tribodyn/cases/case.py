"""Common parts of all cases: frozen groups of keys, building from a user's values, changed copies.

One file because groups, building and changed copies are one protocol that calls itself in a circle.
"""

import json
import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any, ClassVar, NoReturn, Self, TypeVar

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
from tribodyn.cases.fields import Entry, Vector, quantity, read_entry, tables, text
from tribodyn.cases.keys import Key, Value, family_names, keys_of
from tribodyn.cases.messages import CROSS_CHECK, Asked, Disagreement, Remarks, located, problems, unknown
from tribodyn.cases.parameters import keys_with_units, read_all, scope_of, unused_parameters
from tribodyn.cases.scans import with_meshes_read
from tribodyn.cases.tables import (
    FROZEN,
    Tables,
    alternatives,
    empty_tables,
    keys_at,
    keys_in,
    nested,
    of_components,
    plain_entries,
    plain_path,
    value_at,
    with_components,
)
from tribodyn.cases.write import to_html, to_toml
from tribodyn.core.errors import Faults, InputError, below, together
from tribodyn.core.quoting import meant

_T = TypeVar("_T")
AnyCase = TypeVar("AnyCase", bound="Case")


class Group(BaseModel):
    """A table of a case file: frozen, and closed to keys it does not declare."""

    #: Pairs of its keys of which only one may be given.
    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = ()

    model_config = ConfigDict(frozen=True, extra="forbid", strict=False, defer_build=True)

    #: Whether the keys in its :func:`demand` are those of the table, and not of the whole case.
    KEYS_BEGIN_HERE: ClassVar[bool] = False

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

    @model_validator(mode="wrap")
    @classmethod
    def _locate(cls, values: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo) -> Self:
        """Let pydantic gather the cross-checks that fail in several tables, whose names it knows."""
        try:
            return handler(values)
        except InputError as error:
            if info.context is None and not cls.KEYS_BEGIN_HERE:
                raise
            context = {"faults": error.faults, "here": cls.KEYS_BEGIN_HERE}
            raise PydanticCustomError(CROSS_CHECK, "cross-check", context) from None

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            self._refuse_change()
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        self._refuse_change()

    def _refuse_change(self) -> NoReturn:
        raise TypeError(FROZEN)


class NamedGroup(Group):
    """A table that a user names; keys in its :func:`demand` begin at the table itself."""

    KEYS_BEGIN_HERE: ClassVar[bool] = True


AnyGroup = TypeVar("AnyGroup", bound=NamedGroup)


def group_at(kind: type[AnyGroup], table: str, values: Mapping[str, Value]) -> AnyGroup:
    """Return the checked table at a dotted path from the values of a case by theirs."""
    own = {
        path.removeprefix(f"{table}."): value
        for path, value in values.items()
        if path.startswith(f"{table}.")
    }
    with below(table):
        try:
            return kind.model_validate(nested(own, ()))
        except ValidationError as error:
            raise together(problems(error, Asked(keys_of(kind), {}, ""))) from None


class ParameterKeys(NamedGroup):
    """A number with a name of its own."""

    value: float = quantity(
        None, "its value, or an expression of other parameters", unit="mm", example="50 mm", required=True
    )


class Case(Group):
    """A complete, validated description of one simulation; SI units throughout.

    Attribute paths are the paths of the case file: ``case.joint.clearance`` is ``clearance`` of
    the table ``[joint]``. Make one with :func:`tribodyn.load_case`, change it with :meth:`replace`.
    """

    case: str
    title: str = text("", "heading of figures and report")
    parameters: Mapping[str, ParameterKeys] = tables("numbers that other values are computed from")

    _units: dict[str, str] = PrivateAttr(default_factory=dict)
    _linked: dict[str, Any] = PrivateAttr(default_factory=dict)
    _given: dict[str, Any] = PrivateAttr(default_factory=dict)
    _scans: dict[str, Any] = PrivateAttr(default_factory=dict)
    #: Values as given, by dotted path, where others stand for some of them.
    _written: dict[str, Value] = PrivateAttr(default_factory=dict)

    @model_validator(mode="wrap")
    @classmethod
    def _in_words(cls, values: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo) -> Self:
        """Report errors as a user sees them, also where Python calls the class."""
        asked = info.context or Asked(keys_of(cls), {}, cls.__name__)
        try:
            return handler(values)
        except ValidationError as error:
            faults = problems(error, asked)
        raise together(faults)

    @classmethod
    def kind(cls) -> str:
        """Return the name that stands under ``case =`` in a file."""
        return str(cls.model_fields["case"].default)

    @classmethod
    def expanded(cls, values: dict[str, Value], tables: list[str]) -> tuple[dict[str, Value], list[str]]:
        """Return the values and tables of a case that some of its tables stand for; by default the same."""
        return values, tables

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that depend on what was given; by default there are none."""
        return {}

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the cross-checks of keys; each raises an :class:`InputError`."""
        return ()

    def model_post_init(self, context: object, /) -> None:
        """Make the checks that involve several keys."""
        super().model_post_init(context)
        check_all(*self.checks())

    @property
    def duration(self) -> float:
        """Simulated time of the whole run [s]."""
        raise NotImplementedError

    @property
    def wear_limits(self) -> dict[str, float]:
        """Limits of the motion that end a wear campaign, by what its history calls them."""
        return {}

    @property
    def campaign_cycles(self) -> int:
        """Drive cycles of a wear campaign; 0 where the case asks for none."""
        return 0

    def yielding(self) -> Self | None:
        """Return the case with elastic bodies under all asperities of which it says nothing, if any."""
        return None

    def remarks(self) -> Remarks:
        """Return remarks on values that do not contradict each other."""
        unused = unused_parameters(self._given, self.parameters)
        words = "parameters.{} is used by no value of the case: use it in an expression, or remove it."
        return Remarks(tuple(words.format(name) for name in unused))

    def assumed_wear(self) -> tuple[str, ...]:
        """Return the joints, as in names of numbers, whose wear rate nobody chose; an empty name for all."""
        return ()

    def wear_scatter(self) -> dict[str, tuple[float, float]]:
        """Return the interval of the wear of equal joints over that at the rate, by joint, ``""`` for all."""
        return {}

    def rigid(self) -> Self | None:
        """Return the case with rigid bodies; None where no body is elastic."""
        return None

    def idle(self) -> tuple[str, ...]:
        """Return the paths of keys that others override; by default there are none."""
        return ()

    def without_effect(self) -> tuple[str, ...]:
        """Return the tables and keys that no part of the case uses; by default there are none."""
        return ()

    def rough_clearances(self) -> dict[str, float]:
        """Return by the path of each clearance the combined rms roughness σ of its surfaces [m]."""
        return {}

    def derived(self) -> dict[str, str]:
        """Return from what the values of some keys follow, by their paths; by default there are none."""
        return {}

    def at(self, path: str) -> Value | None:
        """Return the value at a dotted path, such as ``joint.clearance``."""
        found: Value | None = value_at(self, path)
        return self._written.get(path) if found is None else found

    def given(self, path: str) -> object:
        """Return the given text of a key; None where none was given."""
        return self._given[path].value if path in self._given else None

    @property
    def written(self) -> Mapping[str, Value]:
        """Values as given, by dotted path, where others stand for some of them; else none."""
        return self._written

    @property
    def given_paths(self) -> tuple[str, ...]:
        """Dotted paths of the keys and empty tables that were written, in a built-in case or by a user."""
        return tuple(self._given)

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
        given = {path: entry.origin for path, entry in self._given.items() if entry.origin}
        origins = {path: why for path, why in self.derived().items() if path not in self._given} | given
        return to_toml(
            self, self.kind(), self._own(), self.idle(), origins, linked=self._linked, comments=comments
        )

    def _own(self) -> set[str]:
        """Return the paths of what a user gave."""
        return {path for path, entry in self._given.items() if not entry.built_in}

    def _repr_html_(self) -> str:
        """Return the case as a notebook shows it."""
        return to_html(self, self.title or self.kind(), self._own())

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


def check_all(*checks: Callable[[], object]) -> None:
    """Make checks that do not depend on each other, and raise at the end what they found."""
    faults = Faults()
    for check in checks:
        with faults.noted():
            check()
    faults.raise_any()


def build(
    model: type[AnyCase], entries: Mapping[str, Entry], source: str, found: Iterable[InputError] = ()
) -> AnyCase:
    """Return the validated case that `entries` describe.

    ``model``: the kind of case; ``entries``: what was given, by dotted path; ``source``: named in messages
    about values that were not given; ``found``: what is known to be wrong; raised with the rest.
    """
    declared = keys_of(model)
    keys = keys_at(model, entries)
    entries = plain_entries(entries, keys)
    left_out, empty = empty_tables(entries, declared), empty_tables(entries, keys)
    given = {path: entry for path, entry in entries.items() if path not in left_out}
    entries = {path: entry for path, entry in given.items() if path not in empty}
    faults = Faults(found)
    entries = _known(entries, keys, declared, faults)
    with faults.noted():
        _one_of_each(model, entries, keys)
    scanned = scans.scan_entries(entries)
    with faults.noted():
        entries = with_tables_read(scans.with_scans_read(entries, keys), keys)
        entries = with_meshes_read(entries, keys)
    scope = scope_of(entries, faults)
    keys = keys_with_units(keys, scope.units)
    values, linked = read_all(entries, keys, scope, faults)
    if scope.refused:
        faults.raise_any()
    there = [path for path in given if path not in declared and (path in keys or path in empty)]
    named = [path.rpartition(".")[0] if path in keys else path for path in there]
    asked = Asked(keys, entries, source)
    try:
        written, (values, named) = values, model.expanded(values, named)
    except InputError as error:
        raise together([*faults.found, *(located(fault, asked) for fault in error.faults)]) from None
    if values is not written:
        asked = replace(asked, keys=keys_at(model, [*values, *named]))
    case = _validated(model, values, named, asked, faults)
    in_order = {path: entry for path, entry in given.items() if path in empty or path in entries}
    case._given.update(in_order | entries)
    case._units.update(scope.units)
    case._linked.update(linked)
    if values is not written:
        case._written.update(written)
    case._scans.update(scanned)
    return case


def _known(
    entries: Mapping[str, Entry], keys: Mapping[str, Key], declared: Mapping[str, Key], faults: Faults
) -> dict[str, Entry]:
    """Return the entries whose keys exist, and note the others."""
    for path, entry in entries.items():
        if path not in keys:
            with faults.noted():
                raise unknown(path, keys, declared, entry.source, len(faults.found))
    return {path: entry for path, entry in entries.items() if path in keys}


def _validated(
    model: type[AnyCase], values: Mapping[str, Value], named: Iterable[str], asked: Asked, faults: Faults
) -> AnyCase:
    """Return the case, or raise all that is wrong."""
    sound = not faults.found
    try:
        tree = nested({**_defaults(model, values, asked), **values}, named)
        case = model.model_validate(tree, context=asked)
    except InputError as error:
        # What does not go together may only follow from what is wrong by itself, and what is missing from
        # what could not be read.
        known_faults = {fault.key for fault in faults.found}
        found = [fault for fault in error.faults if sound or not isinstance(fault, Disagreement)]
        found = [fault for fault in found if fault.key not in known_faults]
        raise together([*faults.found, *found]) from None
    faults.raise_any()
    return case


def _defaults(model: type[Case], values: Mapping[str, Value], asked: Asked) -> dict[str, Value]:
    """Return the defaults that depend on what was given."""
    try:
        return model.resolve(values)
    except InputError as error:
        raise located(error, asked) from None


def _changed(case: AnyCase, changes: Mapping[str, object], source: str) -> AnyCase:
    """Return a copy of `case` with `changes` made; see :meth:`Case.replace`."""
    keys = keys_in(case)
    new: dict[str, Entry] = {}
    faults = Faults()
    for path, value in changes.items():
        plain = plain_path(path, keys)
        with faults.noted():
            if plain not in keys:
                known = with_components({whole: keys[whole]} if (whole := plain[:-2]) in keys else {})
                if plain not in known:
                    raise unknown(path, keys, keys_of(type(case)), source, len(faults.found))
                plain, value = _vector(case, plain, value, known, new, source)
            new[plain] = Entry(value, source, text=True)
    return _rebuilt(case, new, source, faults.found)


def with_entries(
    case: AnyCase, values: Mapping[str, object], source: str, without: Iterable[str] = ()
) -> AnyCase:
    """Return a copy of `case` with some values by dotted path, in tables that may be new.

    ``values``: values by dotted path, written as in a case file; ``source``: where they come from, for
    messages; ``without``: dotted paths of tables that are left out. Raises InputError if the values are
    invalid, or what remains of the case is.
    """
    new = {path: Entry(value, source, text=True) for path, value in values.items()}
    return _rebuilt(case, new, source, without=without)


def _rebuilt(
    case: AnyCase,
    new: Mapping[str, Entry],
    source: str,
    found: Iterable[InputError] = (),
    without: Iterable[str] = (),
) -> AnyCase:
    """Return a copy of `case` with other entries; ``found`` as for :func:`build`."""
    left_out = tuple(f"{table}." for table in without)
    given = {path: entry for path, entry in case._given.items() if not f"{path}.".startswith(left_out)}
    kept = scans.entries_kept(given, case._scans, new)
    result = build(type(case), beside(type(case), kept, new), source, found)
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


def beside(model: type[Case], kept: Mapping[str, Entry], new: Mapping[str, Entry]) -> dict[str, Entry]:
    """Return entries with new ones, which take the place of their alternatives too."""
    keys = keys_at(model, [*kept, *new])
    kept, new = plain_entries(kept, keys), plain_entries(new, keys)
    pairs = _alternatives(model, keys)
    taken = {path for pair in pairs if pair[0] in new or pair[1] in new for path in pair}
    return {path: entry for path, entry in kept.items() if path not in taken} | dict(new)


def _one_of_each(model: type[Case], entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> None:
    for first, second in _alternatives(model, keys):
        if first in entries and second in entries:
            raise InputError(
                f"give either {first} or {second}, not both", key=second, source=entries[second].source
            )


def _alternatives(model: type[Case], keys: Iterable[str]) -> tuple[tuple[str, str], ...]:
    return _alternatives_of(model, tuple(keys))


# Cases of a sweep have the same keys.
@lru_cache(maxsize=8)
def _alternatives_of(model: type[Case], keys: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    of_scans = (
        (f"{table}{first}", f"{table}{second}")
        for table in scans.tables_of_surfaces(keys)
        for first, second in scans.ALTERNATIVES
    )
    return (*alternatives(model, keys), *of_scans)


def demand_known(given: str, names: Collection[str], key: str, what: str) -> None:
    """Refuse a name that no table has."""
    if given in names:
        return
    there = f"known: {', '.join(names)}" if names else "there is none"
    demand(False, key, f'"{given}" is no {what}; {there}{meant(given, names)}')


def unit(direction: Vector, key: str) -> Vector:
    """Return a direction as a unit vector; one of no length is refused."""
    length = math.hypot(*direction)
    demand(length > 0.0, key, "a direction has a length above zero")
    x, y, z = direction
    return x / length, y / length, z / length


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))
