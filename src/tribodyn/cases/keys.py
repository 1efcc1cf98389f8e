"""The keys of a case file: what each may hold, how it is read and written, what it means.

They are collected from the models, whose fields :mod:`tribodyn.cases.fields` declares, and document
themselves in ``tribodyn show`` and in the user guide.
"""

import importlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from types import NoneType, UnionType
from typing import Literal, Self, TypeAlias, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribodyn.cases.units import (
    LISTS,
    MissingUnit,
    UnitProblem,
    dimension,
    elements,
    from_si,
    likely_quantity,
    likely_unit,
    rms_roughness,
    si_unit,
    to_si,
)
from tribodyn.core.quoting import brief

#: Value of a key once read: a number in SI units, a switch or a name; one or several.
Value: TypeAlias = float | int | bool | str | tuple[float, ...] | tuple[str, ...]

ASSUMED = "assumed"  #: Source of a value that the paper does not give.

ANY_NAME = "*"  #: Stands in the path of a key for the name that a user gives a table.

#: Key of a table that may be given as that value alone: ``speed = "5000 rpm"`` is ``speed.value``.
VALUE = "value"
_BOUNDS = ("gt", "ge", "lt", "le")
_LONGEST_SHOWN = 60
_MOST_ELEMENTS = 20
_LEAST = 1.0e-60
_LONGEST_FILE_NAME = 4096


class ValueProblem(ValueError):
    """A value cannot be read; the message says why."""


@dataclass(frozen=True)
class Key:
    """One key of a case file."""

    path: str  #: Dotted path, such as ``joint.clearance``.
    #: ``quantity``, ``number``, ``count``, ``switch``, ``choice``, ``name``, ``file`` or ``text``; where it
    #: holds several values ``vector``, ``series`` or ``names``.
    kind: str
    #: One line each; where the default comes from.
    description: str
    source: str
    default: Value | None  #: Default value (SI), or None where it depends on other keys.
    unit: str  #: Unit in which the value is shown; empty for keys without one.
    example: str  #: A value as a person writes it, without quotes.
    limits: str  #: Bounds as a person writes them, such as ``> 0``.
    choices: tuple[str, ...]  #: Allowed names; empty for other kinds.
    length: int = 0  #: How many values it holds; 0 for one, or for any number.
    required: bool = False  #: Whether it must be given.
    #: Whether it is a root mean square height, for which other measures are understood.
    profile: bool = False
    #: The limits as numbers (SI), each after its name: ``gt``, ``ge``, ``lt`` or ``le``.
    bounds: tuple[tuple[str, float], ...] = ()

    def at(self, path: str) -> Self:
        """Return the same key at another dotted path; large cases have some ten thousand keys."""
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__, path=path)
        for of_path in ("table", "name"):
            made.__dict__.pop(of_path, None)
        return made

    @cached_property
    def table(self) -> str:
        """Dotted path of the table that the key stands in; empty at the top."""
        return self.path.rpartition(".")[0]

    @cached_property
    def name(self) -> str:
        """Name of the key inside its table."""
        return self.path.rpartition(".")[2]

    @property
    def allowed(self) -> str:
        """Allowed values of the key, in words."""
        if self.kind in ("vector", "series") and self.unit:
            many = "three numbers" if self.length else "a list of numbers"
            return f"{many} with units of {dimension(self.unit)}, such as {self.example}"
        if self.kind == "quantity":
            limits = f", {self.limits}" if self.limits else ""
            return f'a number with a unit of {dimension(self.unit)}{limits}, such as "{self.example}"'
        words = {
            "vector": f"three numbers, such as {self.example}",
            "series": f"a list of numbers, such as {self.example}",
            "names": f"a list of {self.length or 'some'} names, such as {self.example}",
            "name": f'a name, such as "{self.example}"',
            "number": "a number",
            "count": "a whole number",
            "switch": "true or false",
            "choice": "one of " + ", ".join(self.choices),
            "file": "the name of a file",
            "text": "one line of text of at most 200 characters",
        }
        return words[self.kind] + (f", {self.limits}" if self.limits else "")

    def read(self, value: object, *, text: bool) -> Value:
        """Turn a user's value into the value that the model holds.

        Parameters
        ----------
        value
            As parsed from TOML, or given on the command line or from Python.
        text
            Whether numbers and switches may also be spelled as text (command line).
        """
        if self.kind in LISTS:
            return _read_text(self, value) if isinstance(value, str) else self._read_list(value)
        if self.kind == "quantity":
            return self._read_quantity(value)
        if text and isinstance(value, str):
            value = _from_text(value, self.kind)
        if self.kind in {"number", "count"}:
            return _read_number(value, self.kind)
        expected = bool if self.kind == "switch" else str
        if not isinstance(value, expected):
            raise ValueProblem("")
        if self.kind == "text" and any("\ud800" <= c <= "\udfff" for c in str(value)):
            raise ValueProblem("these bytes are no text in UTF-8, nor in the encoding of the terminal")
        if self.kind == "file" and ("\0" in str(value) or not 0 < len(str(value)) <= _LONGEST_FILE_NAME):
            raise ValueProblem("")
        return value

    def _read_list(self, value: object) -> tuple[float, ...] | tuple[str, ...]:
        found = elements(value, self.unit)
        if found is None or (self.length and len(found) != self.length):
            count = "" if found is None else f"{len(found)} value{'' if len(found) == 1 else 's'}"
            raise ValueProblem(count)
        if self.kind == "names":
            if not all(isinstance(name, str) for name in found):
                raise ValueProblem("")
            return tuple(str(name) for name in found)
        if self.unit:
            if found and all(_is_bare(element) for element in found):
                raise ValueProblem(_list_without_unit(self, found))
            return tuple(self._read_quantity(element) for element in found)
        return tuple(
            float(_read_number(_from_text(str(n), "number") if isinstance(n, str) else n, "number"))
            for n in found
        )

    def _read_quantity(self, value: object) -> float:
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            raise ValueProblem(_without_unit(self, value) if _finite(value) else "the number must be finite")
        if not isinstance(value, str):
            raise ValueProblem("this is one quantity" if isinstance(value, list | tuple) else "")
        try:
            return _not_tiny(rms_roughness(value) if self.profile else to_si(value, self.unit))
        except MissingUnit:
            raise ValueProblem(_without_unit(self, value)) from None
        except UnitProblem as problem:
            raise ValueProblem(str(problem)) from None

    def write(self, value: Value) -> str:
        """Write a value as TOML that reads back exactly."""
        if isinstance(value, tuple):
            return self._write_list(value)
        if self.kind == "quantity":
            return f'"{from_si(float(value), self.unit)}"'
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, str):
            return toml_string(value)
        return repr(value).removesuffix(".0") if abs(value) < 1e15 else repr(value)

    def _write_list(self, values: tuple[float, ...] | tuple[str, ...]) -> str:
        """Write several values: a few as a list, many as one text in SI units."""
        if self.kind == "series" and self.unit:
            return f'"{", ".join(map(repr, values))} {si_unit(self.unit)}"'
        if self.unit:
            texts = [f'"{from_si(float(value), self.unit)}"' for value in values]
        else:
            texts = [toml_string(v) if isinstance(v, str) else repr(v).removesuffix(".0") for v in values]
        return f"[{', '.join(texts)}]"


# Cases of a sweep have the same tables of numbers.
@lru_cache(maxsize=256)
def _read_text(key: Key, text: str) -> tuple[float, ...] | tuple[str, ...]:
    return key._read_list(text)


@cache
def family_names(family: str) -> tuple[str, ...]:
    """Return the member names of a family given as ``module:ATTRIBUTE``, and what follows a ``+``."""
    module, _, attribute = family.partition(":")
    attribute, *others = attribute.split("+")
    return (*getattr(importlib.import_module(module), attribute), *others)


@cache
def keys_of(model: type[BaseModel], prefix: str = "") -> dict[str, Key]:
    """Return every key below a model, by dotted path, in the order of declaration.

    Keys of a table come before its sub-tables, as TOML wants them. In tables that a user names,
    :data:`ANY_NAME` stands for the name; see :mod:`tribodyn.cases.tables`.
    """
    tables = dict(groups_of(model))
    fields = {
        name: info
        for name, info in model.model_fields.items()
        if not {name, f"{name}.{ANY_NAME}"} & {*tables}
    }
    own = {prefix + name: _key(prefix + name, info) for name, info in fields.items()}
    for path, group in tables.items():
        own |= keys_of(group, f"{prefix}{path}.")
    return own


def groups_of(model: type[BaseModel]) -> Iterator[tuple[str, type[BaseModel]]]:
    """Yield the tables of a model with their models, as declared; users name those of ``springs.*``."""
    for name, info in model.model_fields.items():
        if get_origin(info.annotation) is Mapping:
            yield f"{name}.{ANY_NAME}", get_args(info.annotation)[1]
        elif (group := _group(info.annotation)) is not None:
            yield name, group


def _group(annotation: object) -> type[BaseModel] | None:
    """Return the model of a table, optional or not; nothing for a value."""
    for part in (annotation, *get_args(annotation)) if get_origin(annotation) is UnionType else (annotation,):
        if isinstance(part, type) and issubclass(part, BaseModel):
            return part
    return None


def _key(path: str, info: FieldInfo) -> Key:
    extra = info.json_schema_extra
    assert isinstance(extra, dict)
    notes = {name: str(value) for name, value in extra.items()}
    family = notes.get("family", "")
    return Key(
        path=path,
        kind=notes["kind"],
        description=info.description or "",
        source=notes["source"],
        default=None if info.is_required() else info.default,
        unit=notes.get("unit", ""),
        example=notes.get("example", ""),
        limits=notes.get("limits", ""),
        choices=family_names(family) if family else _literal_names(info.annotation),
        length=int(notes.get("length", "0")),
        required=info.is_required(),
        profile=bool(extra.get("profile")),
        bounds=tuple(
            (name, float(getattr(limit, name)))
            for limit in info.metadata
            for name in _BOUNDS
            if hasattr(limit, name)
        ),
    )


def _literal_names(annotation: object) -> tuple[str, ...]:
    """Return the names of a ``Literal``, optional or not; empty for other annotations."""
    if get_origin(annotation) in {Union, UnionType}:
        annotation = next(part for part in get_args(annotation) if part is not NoneType)
    return get_args(annotation) if get_origin(annotation) is Literal else ()


def shown(value: object) -> str:
    """Return a value as messages quote it: as TOML would have it, short, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list | tuple):
        inside = ("a list" if isinstance(v, list) else shown(v) for v in value[:_MOST_ELEMENTS])
        return brief(f"[{', '.join(inside)}]", _LONGEST_SHOWN)
    if isinstance(value, int) and abs(value) > 10**_LONGEST_SHOWN:
        return "a number of too many digits"
    return brief(toml_string(value) if isinstance(value, str) else value, _LONGEST_SHOWN)


def toml_string(value: str) -> str:
    """Write a string as TOML; control characters are escaped, all others stand as they are."""
    escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    characters = (escapes.get(c, c if c.isprintable() else f"\\U{ord(c):08x}") for c in value)
    return '"' + "".join(characters) + '"'


def _without_unit(key: Key, value: object) -> str:
    """Return a number given without a unit as spelled with one, guessed from its size."""
    likely = likely_quantity(str(value).strip(), key.example, key.unit)
    return f'the unit is missing, probably {_as_written(key)} = "{likely}"'


def _list_without_unit(key: Key, numbers: Sequence[object]) -> str:
    """Return numbers given without a unit as spelled with one, guessed from the largest."""
    example = [str(part) for part in elements(key.example, key.unit) or [""]]
    typical = max(example, key=lambda text: abs(to_si(text, key.unit)))
    largest = max((str(number).strip() for number in numbers), key=lambda text: abs(float(text)))
    given = ", ".join(str(number).strip() for number in numbers)
    unit = likely_unit(largest, typical, key.unit)
    return f'the unit is missing, probably {_as_written(key)} = "{brief(given)} {unit}"'


def _as_written(key: Key) -> str:
    """Return the name of a key as a user writes it: ``speed`` for ``speed.value``."""
    return key.table.rpartition(".")[2] if key.name == VALUE else key.name


def _is_bare(value: object) -> bool:
    """Tell whether a value is a finite number without a unit, also as text."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        return False
    try:
        return math.isfinite(float(value))
    except (ValueError, OverflowError):
        return False


def _not_tiny(value: float) -> float:
    """Refuse a value so near to zero that quotients and powers of it are no numbers."""
    if 0.0 < abs(value) < _LEAST:
        raise ValueProblem(f"the number is too small to compute with; the least is {_LEAST:g} in SI units")
    return value


def _finite(value: float) -> bool:
    """Tell whether a number fits into a finite float."""
    try:
        return math.isfinite(float(value))
    except OverflowError:
        return False


def _read_number(value: object, kind: str) -> float | int:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueProblem("this key takes a bare number" if isinstance(value, str) else "")
    if not _finite(value):
        raise ValueProblem("the number must be finite")
    if kind == "number":
        return _not_tiny(float(value))
    if value != int(value):
        raise ValueProblem("")
    return int(value)


def _from_text(value: str, kind: str) -> object:
    """Read a number or a switch that was typed as text; leave the rest alone."""
    word = value.strip()
    if kind == "switch":
        return {"true": True, "false": False}.get(word.lower(), value)
    if kind in {"number", "count"} and len(word) <= _LONGEST_SHOWN and "_" not in word:
        try:
            return float(word)
        except ValueError:
            return value
    return value
