"""Layouts of arguments: what a compiled function takes, and how a value is taken apart into words for it.

A word has 64 bits. A number is one, an array is ``ARRAY`` words and two for each dimension, a record is its
address. What does not fit a layout to the last field of a record raises TypeError: compiled code would read
other memory.
"""

from __future__ import annotations

import ctypes
import hashlib
import struct
import typing
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Final, TypeAlias

import numpy as np

#: Words of an array beside those of its dimensions: two owners, number and size of its entries, address.
ARRAY: Final = 5
#: Annotation of a named tuple whose arrays have one dimension more; records and numbers are arrays.
STACKED: Final = 1


@dataclass(frozen=True)
class Number:
    """A number: ``float``, ``int`` or ``bool``."""

    kind: type

    @property
    def size(self) -> int:
        """Number of words."""
        return 1

    def words(self, value: Any) -> tuple[int, ...]:
        """Return a value as words."""
        kind = type(value)
        if self.kind is float:
            if kind is not float and (kind is bool or not isinstance(value, int | np.integer | np.floating)):
                raise _misfit(value, self)
            return struct.unpack("<q", struct.pack("<d", value))
        allowed = bool | np.bool_ if self.kind is bool else int | np.integer
        if not isinstance(value, allowed) or (self.kind is int and kind is bool):
            raise _misfit(value, self)
        if not -(2**63) <= int(value) < 2**63:
            raise TypeError(f"{value} has more than 64 bits")
        return (int(value),)

    def __str__(self) -> str:
        return self.kind.__name__


@dataclass(frozen=True)
class Array:
    """An array whose entries lie one behind the other and may be written."""

    dtype: np.dtype[Any]
    ndim: int

    @property
    def size(self) -> int:
        """Number of words."""
        return ARRAY + 2 * self.ndim

    def words(self, value: Any) -> tuple[int, ...]:
        """Return a value as words."""
        if not isinstance(value, np.ndarray) or value.dtype != self.dtype or value.ndim != self.ndim:
            raise _misfit(value, self)
        if not value.flags.carray:
            raise TypeError("an array is not contiguous, not aligned or must not be written to")
        # The attribute ``ctypes`` takes three times as long; a buffer has an entry.
        address = ctypes.addressof(ctypes.c_char.from_buffer(value)) if value.size else value.ctypes.data  # type: ignore[arg-type]
        return (0, 0, value.size, value.itemsize, address, *value.shape, *value.strides)

    def __str__(self) -> str:
        return f"{_fields(self.dtype)}[{self.ndim}]"


@dataclass(frozen=True)
class One:
    """One record."""

    dtype: np.dtype[Any]

    @property
    def size(self) -> int:
        """Number of words."""
        return 1

    def words(self, value: Any) -> tuple[int, ...]:
        """Return a value as words."""
        if not isinstance(value, np.void) or value.dtype != self.dtype:
            raise _misfit(value, self)
        # Its own memory: the interface of a scalar is that of a copy.
        return (np.frombuffer(value, np.uint8).ctypes.data,)

    def __str__(self) -> str:
        return _fields(self.dtype)


@dataclass(frozen=True)
class Tuple:
    """A tuple, with or without names."""

    cls: type
    members: tuple[Layout, ...]

    @property
    def size(self) -> int:
        """Number of words."""
        return sum(member.size for member in self.members)

    def words(self, value: Any) -> tuple[int, ...]:
        """Return a value as words."""
        if type(value) is not self.cls or not isinstance(value, tuple) or len(value) != len(self.members):
            raise _misfit(value, self)
        found: list[int] = []
        for member, part in zip(self.members, value, strict=True):
            found += member.words(part)
        return tuple(found)

    def __str__(self) -> str:
        return f"{self.cls.__name__}({','.join(map(str, self.members))})"


@dataclass(frozen=True)
class Absent:
    """The value ``None``."""

    @property
    def size(self) -> int:
        """Number of words."""
        return 1

    def words(self, value: Any) -> tuple[int, ...]:
        """Return a value as words."""
        if value is not None:
            raise _misfit(value, self)
        return (0,)

    def __str__(self) -> str:
        return "None"


Layout: TypeAlias = Number | Array | One | Tuple | Absent
Layouts: TypeAlias = tuple[Layout, ...]


def _misfit(value: Any, layout: Layout) -> TypeError:
    wanted, found = str(layout), type(value).__name__
    if isinstance(value, np.ndarray | np.void):
        found = f"{found} {value.dtype} with {value.ndim} dimensions"
    return TypeError(f"compiled code takes {wanted[:80]}, not {found[:160]}")


@cache
def _fields(dtype: np.dtype[Any]) -> str:
    """Return names, places and types of all fields of a type."""
    if dtype.subdtype is not None:
        base, shape = dtype.subdtype
        return f"{_fields(base)}{list(shape)}"
    if dtype.names is None:
        return dtype.str
    parts = (f"{name}@{dtype.fields[name][1]}:{_fields(dtype.fields[name][0])}" for name in dtype.names)  # type: ignore[index]
    return f"{{{' '.join(parts)}}}{dtype.itemsize}"


def digest(layouts: Layouts, *more: str) -> str:
    """Return a hash of layouts of arguments, and of more."""
    return hashlib.sha256(";".join((*map(str, layouts), *more)).encode()).hexdigest()[:16]


def layout_of(value: Any) -> Layout:
    """Return the layout of a value.

    Raises TypeError if compiled code takes no such value.
    """
    if value is None:
        return Absent()
    if isinstance(value, tuple):
        return Tuple(type(value), tuple(map(layout_of, value)))
    if isinstance(value, np.ndarray):
        return Array(value.dtype, value.ndim)
    if isinstance(value, np.void):
        return One(value.dtype)
    for kind, types in ((bool, bool | np.bool_), (int, int | np.integer), (float, float | np.floating)):
        if isinstance(value, types):
            return Number(kind)
    raise TypeError(f"compiled code takes no {type(value).__name__}")


def annotated(function: Callable[..., Any]) -> Layouts:
    """Return the layouts that the annotations of a function say.

    An array has one dimension, or as many as ``Annotated[FloatArray, 2]`` says. ``Annotated[Record, FIELDS]``
    is a record, ``Annotated[Record, FIELDS, 1]`` an array of records with one dimension, and
    ``Annotated[FilmData, STACKED]`` a named tuple for several things, one behind the other.
    """
    hints = typing.get_type_hints(function, include_extras=True)
    return tuple(of_hint(hints[name]) for name in hints if name != "return")


def of_hint(hint: Any, more: int = 0) -> Layout:
    """Return the layout that an annotation says, see :func:`annotated`, with more dimensions."""
    said: tuple[Any, ...] = ()
    if typing.get_origin(hint) is Annotated:
        hint, *said = typing.get_args(hint)  # type: ignore[assignment]
    # A type alias, which later versions of NumPy have.
    while (value := getattr(typing.get_origin(hint) or hint, "__value__", None)) is not None:
        hint = value[typing.get_args(hint)] if typing.get_args(hint) else value
    if typing.get_origin(hint) is np.ndarray and not isinstance(next(iter(said), 1), np.dtype):
        dtype = np.dtype(typing.get_args(typing.get_args(hint)[1])[0])
        return Array(dtype, (said[0] if said else 1) + more)
    if said and isinstance(said[0], np.dtype):
        ndim = (said[1] if len(said) > 1 else 0) + more
        return Array(said[0], ndim) if ndim else One(said[0])
    if isinstance(hint, type) and issubclass(hint, tuple):
        deeper = more + sum(said)
        members = typing.get_type_hints(hint, include_extras=True)
        return Tuple(hint, tuple(of_hint(each, deeper) for each in members.values()))
    if hint in (float, int, bool):
        return Array(np.dtype(hint), more) if more else Number(hint)
    if hint is type(None):
        return Absent()
    raise TypeError(f"no layout follows from the annotation {hint}")
