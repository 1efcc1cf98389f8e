"""Declaring the keys of a case file: default, meaning, source, bounds.

The helpers below make pydantic fields; :func:`tribodyn.cases.keys.keys_of` collects what they record.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from pydantic import Field

from tribodyn.cases.lists import elements
from tribodyn.cases.units import to_si, unit_of

Bound: TypeAlias = str | float | None
Vector: TypeAlias = tuple[float, float, float]
Numbers: TypeAlias = tuple[float, ...]

_SIGNS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}


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
    required: bool = False,
    profile: bool = False,
) -> Any:
    """Declare a key that carries a unit; default and bounds are written with it.

    A root mean square height of a ``profile`` may be given by another measure, as in ``Ra 0.8 um``.
    """
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
        required=required,
        unit=unit,
        example=shown,
        profile=profile,
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
    required: bool = False,
) -> Any:
    """Declare a dimensionless key; its values are bare numbers."""
    bounds: dict[str, Bound] = {"gt": gt, "ge": ge, "lt": lt, "le": le}
    return _field(
        default, description, source, bounds, bounds, kind="number", required=required, example=example
    )


def count(default: int | None, description: str, source: str, *, ge: int, le: int, example: str = "") -> Any:
    """Declare a key that takes a whole number."""
    bounds: dict[str, Bound] = {"ge": ge, "le": le}
    return _field(default, description, source, bounds, bounds, kind="count", example=example)


def switch(default: bool, description: str, source: str) -> Any:
    """Declare a key that is true or false."""
    return _field(default, description, source, {}, {}, kind="switch")


def vector(
    default: str | None,
    description: str,
    source: str,
    *,
    unit: str = "",
    example: str = "",
    required: bool = False,
) -> Any:
    """Declare a key that takes three numbers: with a unit each, or bare where `unit` is empty.

    Parameters
    ----------
    default
        Three numbers before the one unit, such as ``"0, 0, 0 m"``.
    description, source
        As for the other kinds.
    unit
        In which they are shown.
    example
        As it stands in a file, such as ``["0 mm", "0 mm", "170 mm"]``.
    required
        Whether it must be given.
    """
    held = None if default is None else _numbers(default, unit)
    return _field(
        held,
        description,
        source,
        {},
        {},
        kind="vector",
        required=required,
        unit=unit,
        example=example,
        length=3,
    )


def series(description: str, source: str, *, unit: str = "", example: str) -> Any:
    """Declare a key that takes any number of numbers, with a unit each, or bare; none by default."""
    return _field(None, description, source, {}, {}, kind="series", unit=unit, example=example)


def names(description: str, source: str, *, length: int, example: str) -> Any:
    """Declare a key that takes that many names, 0 for any number, and must be given."""
    return _field(
        None, description, source, {}, {}, kind="names", required=True, example=example, length=length
    )


def _numbers(texts: str, unit: str) -> tuple[float, ...]:
    found = elements(texts, unit) or []
    return tuple(to_si(str(text), unit) if unit else float(str(text)) for text in found)


def choice(
    default: str | None,
    description: str,
    source: str,
    *,
    family: str = "",
    example: str = "",
    required: bool = False,
) -> Any:
    """Declare a key that takes a name.

    Parameters
    ----------
    default, description, source
        As for the other kinds.
    family
        Where the allowed names are listed, as ``module:ATTRIBUTE`` (a mapping); ``module:ATTRIBUTE+none``
        also allows the name ``none``. It is imported only when a value is checked. Empty when the
        annotation is a ``Literal``, which lists them itself.
    required
        Whether it must be given.
    """
    extra = {"family": family, "example": example}
    return _field(default, description, source, {}, {}, kind="choice", required=required, **extra)


def name(default: str | None, description: str, source: str, *, example: str, required: bool = False) -> Any:
    """Declare a key that takes the name of a table that the user named."""
    return _field(default, description, source, {}, {}, kind="name", required=required, example=example)


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
    required: bool = False,
    **extra: str | int,
) -> Any:
    limits = " and ".join(f"{_SIGNS[k]} {b}" for k, b in bounds.items() if b is not None)
    return Field(
        ... if required else default,
        description=description,
        allow_inf_nan=False if kind in {"quantity", "number"} else None,
        json_schema_extra={"kind": kind, "source": source, "limits": limits, **extra},
        **{k: b for k, b in numbers.items() if b is not None},
    )


def tables(description: str) -> Any:
    """Declare tables that a user names, each of the group that the annotation ``Mapping[str, ...]`` says."""
    return Field(default_factory=dict, description=description)
