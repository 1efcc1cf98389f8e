"""Quantities by name: the same table makes the record that kernels fill and says what its entries mean."""

import itertools
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

#: One record of such a type; its entries are attributes, in compiled code and out of it.
Record: TypeAlias = Any
RecordType: TypeAlias = np.dtype[np.void]

TIME: Final = ("time",)


class Quantity(NamedTuple):
    """One number or vector that kernels fill in by its name."""

    name: str  #: Its name, everywhere.
    unit: str  #: SI unit as a UDUNITS string, ``"1"`` for a ratio.
    meaning: str  #: Plain words, used as axis label and in the documentation.
    dimensions: tuple[str, ...] = TIME  #: Dimensions of the array that a result holds of it.
    size: int = 1  #: Number of components.


Table: TypeAlias = Sequence[Quantity]


def by_axes(name: str, unit: str, meaning: str, axes: str = "XYZ") -> tuple[Quantity, ...]:
    """Return the components of a vector along or about some axes."""
    return tuple(Quantity(name + axis.lower(), unit, f"{meaning} {axis}") for axis in axes)


def names(table: Table) -> tuple[str, ...]:
    """Return the names of a table in their order."""
    return tuple(quantity.name for quantity in table)


def record_type(*fields: Any) -> RecordType:
    """Return the type of a record of given fields, as ``numpy.dtype`` takes them."""
    return np.dtype((np.record, list(fields)))


@cache
def slices(table: Table) -> Mapping[str, slice]:
    """Return the place of each quantity among the numbers of a record that :func:`of_table` makes."""
    ends = itertools.accumulate(quantity.size for quantity in table)
    return {quantity.name: slice(end - quantity.size, end) for quantity, end in zip(table, ends, strict=True)}


def of_table(table: Table) -> RecordType:
    """Return the type of a record with a number, or an array of them, for each quantity."""
    return record_type(*((q.name, "f8") if q.size == 1 else (q.name, "f8", (q.size,)) for q in table))


def of_tables(tables: Mapping[str, Table]) -> RecordType:
    """Return the type of a record of such records, by their names."""
    return record_type(*((name, of_table(table)) for name, table in tables.items()))


def together(tables: Mapping[str, Table]) -> tuple[Quantity, ...]:
    """Return all quantities of some tables, in the order of the record that :func:`of_tables` makes."""
    return tuple(quantity for table in tables.values() for quantity in table)
