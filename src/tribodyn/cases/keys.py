"""Declaring the keys of a case file: default, meaning, source, bounds.

The helpers below make pydantic fields. What they record about a key is collected by
:func:`keys_of` into :class:`Key` objects, which read values, name what is allowed, and document
the key in ``tribodyn show`` and in the user guide.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, TypeAlias, Union, get_args, get_origin

from pydantic import BaseModel, Field
from pydantic.fields import FieldInfo

from tribodyn.cases.units import (
    MissingUnit,
    UnitProblem,
    dimension,
    from_si,
    likely_quantity,
    si_unit,
    to_si,
    unit_of,
)
from tribodyn.core.quoting import brief

Value: TypeAlias = float | int | bool | str
"""What a key can hold once read: numbers in SI units, switches, names."""

Bound: TypeAlias = str | float | None

ASSUMED = "assumed"
"""Source of a value that the paper does not give."""

_SIGNS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}
_LONGEST_SHOWN = 60
_LEAST = 1.0e-60
_LONGEST_FILE_NAME = 4096


class ValueProblem(ValueError):
    """A value cannot be read; the message says why."""


@dataclass(frozen=True)
class Key:
    """One key of a case file.

    Attributes
    ----------
    path
        Dotted path, such as ``joint.clearance``.
    kind
        ``quantity``, ``number``, ``count``, ``switch``, ``choice``, ``file`` or ``text``.
    description, source
        One line each; where the default comes from.
    default
        Default value (SI), or None where it depends on other keys.
    unit
        Unit in which the value is shown; empty for keys without one.
    example
        A value as a person writes it, without quotes.
    limits
        Bounds as a person writes them, such as ``> 0``.
    choices
        Allowed names; empty for other kinds.
    """

    path: str
    kind: str
    description: str
    source: str
    default: Value | None
    unit: str
    example: str
    limits: str
    choices: tuple[str, ...]

    @property
    def table(self) -> str:
        """Dotted path of the table that the key stands in; empty at the top."""
        return self.path.rpartition(".")[0]

    @property
    def name(self) -> str:
        """Name of the key inside its table."""
        return self.path.rpartition(".")[2]

    @property
    def allowed(self) -> str:
        """What the key may hold, in words."""
        if self.kind == "quantity":
            limits = f", {self.limits}" if self.limits else ""
            return f'a number with a unit of {dimension(self.unit)}{limits}, such as "{self.example}"'
        words = {
            "number": "a number",
            "count": "a whole number",
            "switch": "true or false",
            "choice": "one of " + ", ".join(self.choices),
            "file": "the name of a file",
            "text": "one line of text of at most 200 characters",
        }
        return words[self.kind] + (f", {self.limits}" if self.limits else "")

    def read(self, value: object, *, text: bool) -> Value:
        """Turn what a user wrote into the value that the model holds.

        Parameters
        ----------
        value
            As parsed from TOML, or given on the command line or from Python.
        text
            Whether numbers and switches may also be spelled as text (command line).
        """
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

    def _read_quantity(self, value: object) -> float:
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            raise ValueProblem(_without_unit(self, value) if _finite(value) else "the number must be finite")
        if not isinstance(value, str):
            raise ValueProblem("")
        try:
            return _not_tiny(to_si(value, self.unit))
        except MissingUnit:
            raise ValueProblem(_without_unit(self, value)) from None
        except UnitProblem as problem:
            raise ValueProblem(str(problem)) from None

    def write(self, value: Value) -> str:
        """Write a value as TOML that reads back exactly."""
        if self.kind == "quantity":
            return f'"{from_si(float(value), self.unit)}"'
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, str):
            return toml_string(value)
        return repr(value).removesuffix(".0") if abs(value) < 1e15 else repr(value)


def quantity(
    default: str | None,
    description: str,
    source: str,
    *,
    unit: str | None = None,
    gt: Bound = None,
    ge: Bound = None,
    lt: Bound = None,
    le: Bound = None,
    example: str | None = None,
) -> Any:
    """Declare a key that carries a unit; default and bounds are written with it."""
    shown = example or default or ""
    unit = unit or unit_of(shown)
    bounds = {"gt": gt, "ge": ge, "lt": lt, "le": le}
    numbers = {k: to_si(b, unit) if isinstance(b, str) else b for k, b in bounds.items()}
    return _field(
        None if default is None else to_si(default, unit),
        description,
        source,
        bounds,
        numbers,
        kind="quantity",
        unit=unit,
        example=shown,
    )


def number(
    default: float | None,
    description: str,
    source: str,
    *,
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
    example: str = "",
) -> Any:
    """Declare a dimensionless key; its values are bare numbers."""
    bounds: dict[str, Bound] = {"gt": gt, "ge": ge, "lt": lt, "le": le}
    return _field(default, description, source, bounds, bounds, kind="number", example=example)


def count(default: int, description: str, source: str, *, ge: int, le: int) -> Any:
    """Declare a key that takes a whole number."""
    bounds: dict[str, Bound] = {"ge": ge, "le": le}
    return _field(default, description, source, bounds, bounds, kind="count")


def switch(default: bool, description: str, source: str) -> Any:
    """Declare a key that is true or false."""
    return _field(default, description, source, {}, {}, kind="switch")


def choice(default: str | None, description: str, source: str, *, family: str = "", example: str = "") -> Any:
    """Declare a key that takes a name.

    Parameters
    ----------
    default, description, source
        As for the other kinds.
    family
        Where the allowed names are listed, as ``module:ATTRIBUTE`` (a mapping); ``module:ATTRIBUTE+none``
        also allows the name ``none``. It is imported only when a value is checked. Empty when the
        annotation is a ``Literal``, which lists them itself.
    """
    return _field(default, description, source, {}, {}, kind="choice", family=family, example=example)


def file(description: str, example: str) -> Any:
    """Declare a key that names a file, relative to the case file; what it holds takes its place."""
    return _field(None, description, "", {}, {}, kind="file", example=example)


def text(default: str, description: str) -> Any:
    """Declare a key that takes one line of free text."""
    return Field(
        default,
        description=description,
        max_length=200,
        pattern=r"^[^\x00-\x1f\x7f-\x9f\u2028\u2029]*$",
        json_schema_extra={"kind": "text", "source": ""},
    )


def _field(
    default: object,
    description: str,
    source: str,
    bounds: Mapping[str, Bound],
    numbers: Mapping[str, Any],
    *,
    kind: str,
    **extra: str,
) -> Any:
    limits = " and ".join(f"{_SIGNS[k]} {b}" for k, b in bounds.items() if b is not None)
    return Field(
        default,
        description=description,
        allow_inf_nan=False if kind in {"quantity", "number"} else None,
        json_schema_extra={"kind": kind, "source": source, "limits": limits, **extra},
        **{k: b for k, b in numbers.items() if b is not None},
    )


@cache
def family_names(family: str) -> tuple[str, ...]:
    """Return the member names of a family given as ``module:ATTRIBUTE``, and what follows a ``+``."""
    module, _, attribute = family.partition(":")
    attribute, *others = attribute.split("+")
    return (*getattr(importlib.import_module(module), attribute), *others)


@cache
def keys_of(model: type[BaseModel], prefix: str = "") -> dict[str, Key]:
    """Return every key below a model, by dotted path, in the order of declaration.

    Keys of a table come before its sub-tables, as TOML wants them.
    """
    own: dict[str, Key] = {}
    below: dict[str, Key] = {}
    for name, info in model.model_fields.items():
        group = info.annotation
        if isinstance(group, type) and issubclass(group, BaseModel):
            below |= keys_of(group, f"{prefix}{name}.")
        else:
            own[prefix + name] = _key(prefix + name, info)
    return own | below


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
        default=info.default,
        unit=notes.get("unit", ""),
        example=notes.get("example", ""),
        limits=notes.get("limits", ""),
        choices=family_names(family) if family else _literal_names(info.annotation),
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
    if isinstance(value, list):
        return "a list"
    if isinstance(value, int) and abs(value) > 10**_LONGEST_SHOWN:
        return "a number of too many digits"
    return brief(toml_string(value) if isinstance(value, str) else value, _LONGEST_SHOWN)


def toml_string(value: str) -> str:
    """Write a string as TOML; control characters are escaped, all others stand as they are."""
    escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    characters = (escapes.get(c, c if c.isprintable() else f"\\U{ord(c):08x}") for c in value)
    return '"' + "".join(characters) + '"'


def _without_unit(key: Key, value: object) -> str:
    """Show how a number given without a unit would be spelled with one."""
    likely = likely_quantity(str(value).strip(), key.example, key.unit)
    return f'the unit is missing, as in {key.name} = "{likely}"'


def _not_tiny(value: float) -> float:
    """Refuse what is so near to zero that quotients and powers of it are no numbers."""
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


__all__ = [
    "ASSUMED",
    "Key",
    "Value",
    "ValueProblem",
    "choice",
    "count",
    "family_names",
    "file",
    "keys_of",
    "number",
    "quantity",
    "shown",
    "si_unit",
    "switch",
    "text",
    "toml_string",
]
