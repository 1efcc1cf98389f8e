"""Surfaces as plain text with commas: our own reader and writer, strict on purpose.

A map is a table of heights, a line of the file for each line of the scan; a profile is a single line, or
two columns, position and height, whatever the header above them calls them. What the numbers mean stands
above them::

    # unit: um                     x [mm],h [um]        Position (mm);Height (um)
    # spacing: 0.5 um, 0.4 um      0,0.12               0,000;0,12
    0.12,0.15,0.11                 0.001,0.15           0,001;0,15

``spacing`` is that of the points in a line, then that of the lines; one number serves for both.
Semicolons and tabs may stand for commas, which then are decimal commas. A missing height is an empty field or
``nan``. Lines of words above the header, and those that begin with ``#``, ``%`` or ``//``, are passed over.
"""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import BinaryIO, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.files import is_comment, named, separator_of
from tribodyn.core.quoting import as_given, brief
from tribodyn.surfaces.scan import Length, Scan, from_columns
from tribodyn.surfaces.table import Line, lines, table

#: Reads the numbers of a file, shape (lines, fields); called with the fields of a line if they are known.
Numbers: TypeAlias = Callable[[int | None], FloatArray]

_NOTE: Final = re.compile(r"#\s*(unit|spacing)\s*[:=]\s*(.+?)\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Scale:
    """Units and spacing of the numbers of a file, where the file does not give them.

    Parameters
    ----------
    unit
        Unit of the heights, such as ``um``.
    spacing
        Distance of the points, and of the lines if it differs, such as ``0.5 um, 0.4 um``.
    """

    unit: str | None = None
    spacing: str | None = None


def read_text(stream: BinaryIO, source: str, length: Length, given: Scale) -> Scan:
    """Return the surface in a text file.

    ``stream``: an open file; ``length``: reads a length with its unit; ``given``: unit and spacing; an error
    where the file gives them too. Raises InputError if anything is not as the module says; the message names
    the line.
    """
    every = lines(stream, source)
    notes, header, separator, first = _head(every, source)
    scale = _settled(notes, given, source)

    def late(line: Line) -> None:
        if _note(line):
            raise InputError(f"line {line.number}: unit and spacing stand above the heights", source=source)

    def numbers(width: int | None) -> FloatArray:
        return table(chain([first], every), separator, width, late, source)

    if header is not None:
        return _profile(_columns(header, separator, source), numbers, scale, length, source)
    if scale.spacing is None and first.text.count(separator) == 1:
        return _profile(_without_names(scale, source), numbers, scale, length, source)
    return _table(numbers, scale, length, source)


def write_text(scan: Scan, path: Path) -> None:
    """Write a surface so that :func:`read_text` returns the same heights.

    Parameters
    ----------
    scan
        Any surface.
    path
        File to write.

    Raises
    ------
    OSError
        The file cannot be written.
    """
    spacing = ", ".join(f"{step!r} m" for step in reversed(scan.spacing))
    heights = np.atleast_2d(scan.heights).tolist()
    rows = (",".join("" if math.isnan(one) else repr(one) for one in row) for row in heights)
    path.write_text("\n".join(["# unit: m", f"# spacing: {spacing}", *rows]) + "\n", encoding="utf-8")


def parse_spacing(text: str, dimensions: int, length: Length, key: str = "spacing") -> tuple[float, ...]:
    """Return the spacing [m] in the order of :class:`Scan` from the text ``dx`` or ``dx, dy``."""
    steps = [_length(part, length, key) for part in text.split(",")]
    if len(steps) > 2:
        raise InputError(f"{as_given(text)}; allowed: one length, or two with a comma between them", key=key)
    if not all(0.0 < step < math.inf for step in steps):
        raise InputError(f"{as_given(text)}; allowed: lengths above zero", key=key)
    return (steps[-1], steps[0]) if dimensions == 2 else (steps[0],)


def unit_size(unit: str, length: Length, key: str = "unit") -> float:
    """Return the size of a unit of length [m]."""
    size = _length(f"1 {unit}", length, key)
    if not size > 0.0:
        raise InputError(f"{as_given(unit)}; allowed: a unit of length, such as um", key=key)
    return size


def _length(text: str, length: Length, key: str) -> float:
    try:
        return length(text.strip())
    except ValueError as error:
        raise InputError(
            f'{as_given(text.strip())}: {error}; allowed: a length with its unit, such as "0.5 um"', key=key
        ) from None


def _head(every: Iterator[Line], source: str) -> tuple[dict[str, str], Line | None, str, Line]:
    """Return notes, the last line of words, separator, and the first line of numbers."""
    notes: dict[str, str] = {}
    header: Line | None = None
    for line in every:
        if is_comment(line.text):
            notes |= _note(line)
            continue
        separator = separator_of(line.text)
        if not _is_header(line.text.split(separator)):
            return notes, header, separator, line
        header = line
    raise InputError("there are no heights in this file", source=source)


def _note(line: Line) -> dict[str, str]:
    note = _NOTE.fullmatch(line.text.strip())
    return {} if note is None else {note[1].lower(): note[2]}


def _is_header(words: list[str]) -> bool:
    return any(word.strip()[:1].isalpha() and word.strip().lower() != "nan" for word in words)


def _settled(notes: dict[str, str], given: Scale, source: str) -> Scale:
    """Return unit and spacing from the file or the caller, never from both."""
    for name in ("unit", "spacing"):
        if name in notes and getattr(given, name) is not None:
            raise InputError("the file says it itself; leave it out", key=name, source=source)
    return Scale(notes.get("unit", given.unit), notes.get("spacing", given.spacing))


def _table(numbers: Numbers, scale: Scale, length: Length, source: str) -> Scan:
    """Return the map, or the profile if there is a single line or column."""
    if scale.unit is None:
        raise InputError(_lacking("unit", "um"), key="unit", source=source)
    if scale.spacing is None:
        raise InputError(_lacking("spacing", "0.5 um"), key="spacing", source=source)
    size, spacing = unit_size(scale.unit, length), parse_spacing(scale.spacing, 2, length)
    heights = numbers(None)
    heights = heights.ravel() if 1 in heights.shape else heights
    heights *= size
    return Scan(heights, spacing[-heights.ndim :], source)


def _profile(
    units: dict[str, str | None], numbers: Numbers, scale: Scale, length: Length, source: str
) -> Scan:
    """Return the profile in the columns x and h."""
    if scale.spacing is not None:
        raise InputError("the column x gives the spacing; leave it out", key="spacing", source=source)
    given = dict(zip(("x", "h"), _both(scale.unit), strict=True))
    sizes = {name: _size(name, unit or given[name], length, source) for name, unit in units.items()}
    columns = dict(zip(sizes, numbers(len(sizes)).T, strict=True))
    x, heights = (columns[name] * sizes[name] for name in ("x", "h"))
    return from_columns(x, heights, source)


def _size(name: str, unit: str | None, length: Length, source: str) -> float:
    if unit is None:
        raise InputError(f'the unit of {name} is missing; write "{name} [um]"', key=name, source=source)
    return unit_size(unit, length, name)


def _columns(header: Line, separator: str, source: str) -> dict[str, str | None]:
    """Return the unit of each column in their order: x, then h, unless they are named otherwise."""
    words = header.text.split(separator)
    found = [column for word in words if (column := named(word)) is not None]
    if len(found) != 2 or len(words) != 2:
        shown = brief(",".join(words).strip())
        raise InputError(
            f'line {header.number}: given the header "{shown}"; allowed: two columns, position and height, '
            'such as "x [mm],z [um]", and none for a table of heights',
            source=source,
        )
    swapped = [name.lower() for name, _ in found] == ["h", "x"]
    names = ("h", "x") if swapped else ("x", "h")
    return {name: unit for name, (_, unit) in zip(names, found, strict=True)}


def _without_names(scale: Scale, source: str) -> dict[str, str | None]:
    """Return the units of position and height in a file that does not name its columns."""
    if scale.unit is None:
        raise InputError(
            "two columns, position and height, without a header that says their units: give both, such as "
            '"mm, um"; for a map of two columns give the spacing instead',
            key="unit",
            source=source,
        )
    return {"x": None, "h": None}


def _both(unit: str | None) -> tuple[str | None, str | None]:
    """Return the units of position and height in one text with a comma, or one that serves for both."""
    first, comma, second = (unit or "").partition(",")
    return (first.strip() or None), (second.strip() if comma else first.strip()) or None


def _lacking(name: str, example: str) -> str:
    return f'the file does not say it; write "# {name}: {example}" in its first line, or give --{name}'
