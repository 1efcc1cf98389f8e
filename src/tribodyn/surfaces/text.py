"""Surfaces as plain text with commas: our own reader and writer, strict on purpose.

A map is a table of heights, a line of the file for each line of the scan; a profile is a single line, or
the columns ``x`` and ``h`` under a header that names them. What the numbers mean stands above them::

    # unit: um                     x [mm],h [um]
    # spacing: 0.5 um, 0.4 um      0,0.12
    0.12,0.15,0.11                 0.001,0.15

``spacing`` is that of the points in a line, then that of the lines; one number serves for both.
Semicolons and tabs may stand for commas. A missing height is an empty field or ``nan``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, brief
from tribodyn.surfaces.scan import MOST_POINTS, Length, Scan, from_columns

_SEPARATORS: Final = (";", "\t", ",")
_BEGINNING: Final = 65_536
_MISSING: Final = ("", "nan")
_COLUMN: Final = re.compile(r"\s*([xh])\s*(?:\[\s*([^\]]+?)\s*\])?\s*", re.IGNORECASE)
_NOTE: Final = re.compile(r"#\s*(unit|spacing)\s*[:=]\s*(.+?)\s*", re.IGNORECASE)
_NUMBER: Final = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?", re.ASCII)
_DECIMAL_COMMA: Final = re.compile(r"[+-]?\d+,\d+", re.ASCII)


@dataclass(frozen=True)
class Scale:
    """What the numbers of a file mean, where the file does not say it.

    Parameters
    ----------
    unit
        Unit of the heights, such as ``um``.
    spacing
        Distance of the points, and of the lines if it differs, such as ``0.5 um, 0.4 um``.
    """

    unit: str | None = None
    spacing: str | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the file: its place, its text, and what stands between its fields."""

    number: int
    text: str
    separator: str

    @property
    def fields(self) -> list[str]:
        """Its fields; made when asked for, since they take twenty times the room of the text."""
        return self.text.split(self.separator)


def read_text(stream: BinaryIO, source: str, length: Length, given: Scale) -> Scan:
    """Return the surface in a text file.

    Parameters
    ----------
    stream
        An open file.
    source
        Its name.
    length
        Reads a length with its unit.
    given
        Unit and spacing; an error where the file gives them too.

    Raises
    ------
    InputError
        Anything is not as the module says; the message names the line.
    """
    notes, header, lines = _sorted_out(_lines(_decoded(stream, source)), source)
    scale = _settled(notes, given, source)
    if header is not None:
        return _profile(header, lines, scale, length, source)
    return _table(lines, scale, length, source)


def write_text(scan: Scan, path: Path) -> None:
    """Write a surface so that :func:`read_text` returns the same heights.

    Parameters
    ----------
    scan
        Any surface.
    path
        File to write.
    """
    spacing = ", ".join(f"{step!r} m" for step in reversed(scan.spacing))
    rows = (",".join(_written(value) for value in row) for row in np.atleast_2d(scan.heights))
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
            f'{as_given(text.strip())}: {error}; allowed: a length with its unit, such as "0.5 um"',
            key=key,
        ) from None


def _lines(text: str) -> Iterator[Line]:
    """Give the lines that are not empty, with the separator of the first line of data."""
    separator = None
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        if separator is None and not _is_note(line):
            separator = next((mark for mark in _SEPARATORS if mark in line), ",")
        yield Line(number, line, separator or ",")


def _is_note(line: str) -> bool:
    return line.lstrip().startswith("#")


def _decoded(stream: BinaryIO, source: str) -> str:
    """Return the text of a file; what shows at its beginning that it is none is not read to the end."""
    content = stream.read(_BEGINNING)
    if not content:
        raise InputError("the file is empty", source=source)
    if b"\0" not in content:
        content += stream.read()
    if b"\0" in content:
        raise InputError("this is a binary file, not text with commas", source=source)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"the file is not UTF-8 text (byte {error.start})", source=source) from None


def _sorted_out(lines: Iterator[Line], source: str) -> tuple[dict[str, str], Line | None, list[Line]]:
    """Tell notes, header and numbers apart."""
    notes: dict[str, str] = {}
    header: Line | None = None
    data: list[Line] = []
    for line in lines:
        if _is_note(line.text):
            note = _NOTE.fullmatch(line.text.strip())
            if note is not None:
                notes[note[1].lower()] = note[2]
        elif not data and header is None and _is_header(line):
            header = line
        else:
            data.append(line)
    if not data:
        raise InputError("there are no heights in this file", source=source)
    return notes, header, data


def _is_header(line: Line) -> bool:
    return any(word.strip()[:1].isalpha() and word.strip().lower() != "nan" for word in line.fields)


def _settled(notes: dict[str, str], given: Scale, source: str) -> Scale:
    """Return unit and spacing from the file or the caller, never from both."""
    for name in ("unit", "spacing"):
        if name in notes and getattr(given, name) is not None:
            raise InputError("the file says it itself; leave it out", key=name, source=source)
    return Scale(notes.get("unit", given.unit), notes.get("spacing", given.spacing))


def _table(lines: list[Line], scale: Scale, length: Length, source: str) -> Scan:
    """Return the map, or the profile if there is a single line or column."""
    if scale.unit is None:
        raise InputError(_lacking("unit", "um"), key="unit", source=source)
    if scale.spacing is None:
        raise InputError(_lacking("spacing", "0.5 um"), key="spacing", source=source)
    heights = _numbers(lines, source)
    heights = heights.ravel() if 1 in heights.shape else heights
    size = unit_size(scale.unit, length)
    return Scan(heights * size, parse_spacing(scale.spacing, heights.ndim, length), source)


def _profile(header: Line, lines: list[Line], scale: Scale, length: Length, source: str) -> Scan:
    """Return the profile in the columns x and h."""
    units = _columns(header, source)
    if scale.spacing is not None:
        raise InputError("the column x gives the spacing; leave it out", key="spacing", source=source)
    columns = {}
    for (name, unit), values in zip(units.items(), _numbers(lines, source, len(units)).T, strict=True):
        unit = unit or scale.unit
        if unit is None:
            raise InputError(f'the unit of {name} is missing; write "{name} [um]"', key=name, source=source)
        columns[name] = values * unit_size(unit, length, name)
    return from_columns(columns["x"], columns["h"], source)


def _columns(header: Line, source: str) -> dict[str, str | None]:
    """Return the unit of each column by its name."""
    found = [_COLUMN.fullmatch(word) for word in header.fields]
    units = {match[1].lower(): match[2] for match in found if match is not None}
    if len(found) != 2 or set(units) != {"x", "h"}:
        shown = brief(",".join(header.fields).strip())
        raise InputError(
            f'line {header.number}: given the header "{shown}"; allowed: "x [um],h [um]" for a profile, and '
            "none for a table of heights",
            source=source,
        )
    return units


def _lacking(name: str, example: str) -> str:
    return f'the file does not say it; write "# {name}: {example}" in its first line, or give --{name}'


def _numbers(lines: list[Line], source: str, width: int | None = None) -> FloatArray:
    """Return the heights as they stand, shape (lines, fields)."""
    width = len(lines[0].fields) if width is None else width
    if len(lines) * width > MOST_POINTS:
        raise InputError(f"more than {MOST_POINTS} heights; cut out a part of the scan", source=source)
    values = np.empty((len(lines), width))
    for row, line in zip(values, lines, strict=True):
        fields = line.fields
        if len(fields) != width:
            raise InputError(
                f"line {line.number} has {len(fields)} fields where {width} are needed; is the file cut off?",
                source=source,
            )
        row[:] = [_number(word.strip(), line.number, source) for word in fields]
    return values


def _number(word: str, line: int, source: str) -> float:
    if word.lower() in _MISSING:
        return math.nan
    if _NUMBER.fullmatch(word) is None:
        hint = "; write a decimal point, not a comma" if _DECIMAL_COMMA.fullmatch(word) else ""
        raise InputError(
            f"line {line}: {as_given(word)}; allowed: a number, or nothing or nan if it is missing{hint}",
            source=source,
        )
    return float(word)


def _written(value: float) -> str:
    return "" if math.isnan(value) else repr(float(value))
