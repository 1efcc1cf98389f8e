"""Declaration of the keys of a case file, and a value of one as a user wrote it.

The helpers below make pydantic fields; :func:`tribodyn.cases.keys.keys_of` collects what they record.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias, TypedDict, Unpack

from pydantic import Field

from tribodyn.cases.keys import Key, Value, ValueProblem, shown
from tribodyn.cases.units import elements, to_si, unit_of
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import meant

Bound: TypeAlias = str | float | None
Vector: TypeAlias = tuple[float, float, float]
Numbers: TypeAlias = tuple[float, ...]

_SIGNS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}


class Bounds(TypedDict, total=False):
    """Bounds of a number: above, at least, below, at most; with a unit where the key has one."""

    gt: Bound
    ge: Bound
    lt: Bound
    le: Bound


def quantity(
    default: str | None,
    description: str,
    source: str = "",
    *,
    unit: str | None = None,
    example: str | None = None,
    required: bool = False,
    profile: bool = False,
    **bounds: Unpack[Bounds],
) -> Any:
    """Declare a key that carries a unit; default and bounds are written with it.

    A root mean square height of a ``profile`` may be given by another measure, as in ``Ra 0.8 um``.
    """
    shown = example or default or ""
    unit = unit or unit_of(shown)
    held = None if default is None else to_si(default, unit)
    more: dict[str, Any] = {"unit": unit, "example": shown, "profile": profile}
    return _field(held, description, source, bounds, kind="quantity", required=required, **more)


def number(
    default: float | None,
    description: str,
    source: str = "",
    *,
    example: str = "",
    required: bool = False,
    **bounds: Unpack[Bounds],
) -> Any:
    """Declare a dimensionless key; its values are bare numbers."""
    return _field(default, description, source, bounds, kind="number", required=required, example=example)


def count(
    default: int | None, description: str, source: str = "", *, ge: int, le: int, example: str = ""
) -> Any:
    """Declare a key that takes a whole number."""
    return _field(default, description, source, {"ge": ge, "le": le}, kind="count", example=example)


def switch(default: bool | None, description: str, source: str = "", *, example: str = "") -> Any:
    """Declare a key that is true or false."""
    return _field(default, description, source, kind="switch", example=example)


def vector(
    default: str | None,
    description: str,
    source: str = "",
    *,
    unit: str = "",
    example: str = "",
    required: bool = False,
) -> Any:
    """Declare a key that takes three numbers: with a unit each, or bare where `unit` is empty.

    ``default``: three numbers before the one unit, such as ``"0, 0, 0 m"``; ``description``, ``source``: as
    for the other kinds; ``unit``: in which they are shown; ``example``: as it stands in a file, such as ``["0
    mm", "0 mm", "170 mm"]``; ``required``: whether it must be given.
    """
    held = None if default is None else _numbers(default, unit)
    return _field(
        held, description, source, kind="vector", required=required, unit=unit, example=example, length=3
    )


def series(description: str, source: str = "", *, unit: str = "", example: str) -> Any:
    """Declare a key that takes any number of numbers, with a unit each, or bare; none by default."""
    return _field(None, description, source, kind="series", unit=unit, example=example)


def names(description: str, source: str = "", *, length: int, example: str, required: bool = True) -> Any:
    """Declare a key that takes that many names, 0 for any number; without them it is empty."""
    more: dict[str, Any] = {"example": example, "length": length}
    return _field(None, description, source, kind="names", required=required, **more)


def _numbers(texts: str, unit: str) -> tuple[float, ...]:
    found = elements(texts, unit) or []
    return tuple(to_si(str(text), unit) if unit else float(str(text)) for text in found)


def choice(
    default: str | None,
    description: str,
    source: str = "",
    *,
    family: str = "",
    example: str = "",
    required: bool = False,
) -> Any:
    """Declare a key that takes a name.

    ``default``, ``description``, ``source``: as for the other kinds. ``family``: where the allowed names are
    listed, as ``module:ATTRIBUTE`` (a mapping); ``module:ATTRIBUTE+none`` also allows the name ``none``. It
    is imported only when a value is checked. Empty when the annotation is a ``Literal``, which lists them
    itself. ``required``: whether it must be given.
    """
    return _field(
        default, description, source, kind="choice", required=required, family=family, example=example
    )


def name(
    default: str | None, description: str, source: str = "", *, example: str, required: bool = False
) -> Any:
    """Declare a key that takes the name of a table that the user named."""
    return _field(default, description, source, kind="name", required=required, example=example)


def file(description: str, example: str) -> Any:
    """Declare a key that names a file, relative to the case file; what it holds takes its place."""
    return _field(None, description, "", kind="file", example=example)


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
    bounds: Bounds | None = None,
    *,
    kind: str,
    required: bool = False,
    **extra: str | int,
) -> Any:
    written: dict[str, Any] = dict(bounds or {})
    given = {k: written[k] for k in _SIGNS if written.get(k) is not None}
    limits = " and ".join(f"{_SIGNS[k]} {b}" for k, b in given.items())
    numbers: dict[str, Any] = {
        k: to_si(b, str(extra["unit"])) if isinstance(b, str) else b for k, b in given.items()
    }
    return Field(
        ... if required else default,
        description=description,
        allow_inf_nan=False if kind in {"quantity", "number"} else None,
        json_schema_extra={"kind": kind, "source": source, "limits": limits, **extra},
        **numbers,
    )


def tables(description: str, default: Callable[[], dict[str, Any]] = dict) -> Any:
    """Declare tables that a user names, each of the group that the annotation ``Mapping[str, ...]`` says.

    ``description``: what they are; ``default``: returns those that there are by default.
    """
    return Field(default_factory=default, description=description)


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
