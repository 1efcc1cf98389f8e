"""Tables of CSV files in a case: from the file that a key ``table`` names to the numbers that the case holds.

A file is read when the case is built, and its numbers take its place: what is simulated, stored and shown
never depends on the file again. Above the columns stand their names and units::

    time [ms], gas force [N], torque [N m]
    0, 0, 1.5
    1, 250, 1.4

Semicolons and tabs may stand for commas, which then are decimal commas; units may stand in round brackets.
Lines above the header, blank ones, and those that begin with ``#``, ``%`` or ``//`` are passed over. A row
that stands there twice is a kink: the slope may jump. In a map, which a key ``map`` names, the places across
stand for the names of columns::

    time [ms], 60 deg [N m], 90 deg [N m]
    0, 1.5, 1.2
    250, 1.4, 1.1
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Final

from tribodyn.cases.fields import Entry, read_entry
from tribodyn.cases.keys import Key, ValueProblem, shown
from tribodyn.cases.units import UnitProblem, dimension, si_unit, to_si
from tribodyn.core.errors import InputError
from tribodyn.core.files import is_comment, named, read_regular, separator_of, text_of, with_points
from tribodyn.core.quoting import LONGEST, brief

#: Name of a key that names a file; beside it stand those of :data:`KNOTS` and ``values``.
TABLE: Final = "table"
MAP: Final = "map"  #: Name of a key that names the file of a map.
CSV: Final = "csv"  #: Name of a key that names a file of which one column is needed.
COLUMN: Final = "column"
VALUES: Final = "values"
TIMES: Final = "times"
#: Quantities of the first column, by the key that takes it, with their units.
KNOTS: Final = {TIMES: "s", "angles": "rad", "positions": "m", "speeds": "rad/s", "velocities": "m/s"}
LARGEST: Final = 20_000_000
MOST_ROWS: Final = 10_000
MOST_OF_MAP: Final = 50_000  #: Numbers that a map holds, at most.


class TableProblem(ValueError):
    """A file holds no table that can be used; the message says why."""


def with_tables_read(entries: Mapping[str, Entry], keys: Mapping[str, Key]) -> dict[str, Entry]:
    """Return the given values with the numbers of CSV files in the place of their names.

    ``entries``: what was given, by dotted path; ``keys``: the keys of the case.
    """
    read = dict(entries)
    for path, entry in entries.items():
        before, _, name = path.rpartition(".")
        if name not in (TABLE, MAP, CSV) or f"{before}.{VALUES}" not in keys:
            continue
        of_column = read.pop(f"{before}.{COLUMN}", None)
        column = None if of_column is None else str(read_entry(keys[f"{before}.{COLUMN}"], of_column))
        file, unit = str(read_entry(keys[path], read.pop(path))), keys[f"{before}.{VALUES}"].unit
        try:
            text = _text((entry.folder or Path()) / file)
            if name == CSV:
                read[f"{before}.{VALUES}"] = replace(entry, value=_cells(text, column))
                continue
            found = _numbers(text, column, unit) if name == TABLE else _map(text, unit)
            _expected(found, [knots for knots in KNOTS if f"{before}.{knots}" in keys])
        except (TableProblem, UnitProblem, ValueProblem) as problem:
            raise InputError(f"given {shown(file)}: {problem}", key=path, source=entry.source) from None
        read |= {f"{before}.{key}": replace(entry, value=value) for key, value in found.items()}
    return read


def _cells(text: str, column: str | None) -> list[str]:
    """Return the cells of one column, each with the unit of the header."""
    header, *lines = [line for line in text.splitlines() if line.strip() and not is_comment(line)] or [""]
    separator = separator_of(header)
    columns = [named(cell) or ("", None) for cell in header.split(separator)]
    known = [name for name, _ in columns]
    place = 0 if column is None else known.index(column) if column in known else -1
    if place < 0:
        raise TableProblem(f"it has no column {shown(column)}; there are {', '.join(known)}")
    rows = [_row(line, separator, (place,), number)[0] for number, line in enumerate(lines, 2)]
    return [f"{cell} {columns[place][1] or ''}".strip() for cell in rows]


def _text(file: Path) -> str:
    try:
        return text_of(read_regular(file, LARGEST))
    except FileNotFoundError:
        raise TableProblem("there is no such file; its name is relative to the case file") from None
    except OSError as error:
        raise TableProblem(f"it cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise TableProblem(str(error)) from None


def _expected(found: Mapping[str, str], knots: Sequence[str]) -> None:
    """Refuse a table over what this key does not follow."""
    for key in found:
        if key in KNOTS and key not in knots:
            raise TableProblem(f"its first column holds {key}; here it is {' or '.join(knots)}")


def _lines(text: str) -> tuple[list[str], str]:
    """Return the lines of a file that count, the header first, and what separates its columns."""
    every = [line for line in text.splitlines() if line.strip() and not is_comment(line)]
    lines = every[next((place for place, line in enumerate(every) if _has_units(line)), 0) :]
    if len(lines) < 3:
        raise TableProblem("it needs a header, such as time [s], force [N], and two rows of numbers at least")
    if len(lines) > MOST_ROWS:
        raise TableProblem(f"it has more than {MOST_ROWS} rows")
    return lines, separator_of(lines[0])


def _numbers(text: str, column: str | None, unit: str) -> dict[str, str]:
    """Return knots and values as a case writes them, by their keys."""
    lines, separator = _lines(text)
    header = [_described(cell) for cell in lines[0].split(separator)]
    names = [name for name, _ in header]
    place = 1 if column is None else names.index(column) if column in names else 0
    if not 0 < place < len(header):
        raise TableProblem(
            f"it has no column {shown(column or 'of values')}; there are {', '.join(names[1:])}"
        )
    key = _knots(header[0][1])
    rows = [_row(line, separator, (0, place), number) for number, line in enumerate(lines[1:], 2)]
    knots = _in_si([row[0] for row in rows], header[0][1], KNOTS[key])
    values = _in_si([row[1] for row in rows], header[place][1], unit)
    check(knots, values)
    return {key: _written(knots, KNOTS[key]), VALUES: _written(values, si_unit(unit))}


def _map(text: str, unit: str) -> dict[str, str]:
    """Return places and values of a map as a case writes them, by their keys."""
    lines, separator = _lines(text)
    cells = lines[0].split(separator)
    first, header = _described(cells[0]), [_described(cell) for cell in cells[1:]]
    down = _knots(first[1])
    across = _kind(header[0][0], down)
    places = range(len(cells))
    rows = [_row(line, separator, places, number) for number, line in enumerate(lines[1:], 2)]
    knots = {
        down: _in_si([row[0] for row in rows], first[1], KNOTS[down]),
        across: [_place(name, KNOTS[across]) for name, _ in header],
    }
    columns = [_in_si([row[k] for row in rows], header[k - 1][1], unit) for k in places[1:]]
    first_of = sorted(knots, key=list(KNOTS).index)
    by_row = columns if down == first_of[1] else list(zip(*columns, strict=True))
    values = [number for row in by_row for number in row]
    check_map({key: knots[key] for key in first_of}, values)
    return {key: _written(of, KNOTS[key]) for key, of in knots.items()} | {
        VALUES: _written(values, si_unit(unit))
    }


def _place(name: str, unit: str) -> float:
    """Return the place that the name of a column of a map is."""
    try:
        return to_si(name, unit)
    except UnitProblem:
        example = "60 deg [N m]" if unit == "rad" else "0.5 s [N m]"
        raise TableProblem(f"the column {shown(name)} names no {dimension(unit)}, as in {example}") from None


def _kind(name: str, other: str) -> str:
    """Return the key of what the name of a column of a map is a place of."""
    for key, unit in KNOTS.items():
        try:
            to_si(name, unit)
        except UnitProblem:
            continue
        if key != other:
            return key
    kinds = " or ".join(dimension(unit) for key, unit in KNOTS.items() if key != other)
    raise TableProblem(f"the column {shown(name)} names no {kinds}, as in 60 deg [N m]")


def check_map(places: Mapping[str, Sequence[float]], values: Sequence[float]) -> None:
    """Refuse a map that no surface goes through.

    ``places``: what it stands over, by two of :data:`KNOTS`; ``values``: row by row of the first. Raises
    TableProblem, which says why, if there is none.
    """
    sizes = [len(of) for of in places.values()]
    if len(values) != sizes[0] * sizes[1]:
        counted = " and ".join(f"{len(of)} {name}" for name, of in places.items())
        raise TableProblem(f"there are {len(values)} values for {counted}")
    if len(values) > MOST_OF_MAP:
        raise TableProblem(f"it has more than {MOST_OF_MAP} values")
    for name, of in places.items():
        if len(of) < 2 or any(b <= a for a, b in pairwise(of)):
            raise TableProblem(f"a map needs two {name} at least, each greater than the one before it")


def check(knots: Sequence[float], values: Sequence[float]) -> None:
    """Refuse a table that no curve goes through: its knots grow, and a kink has one value.

    Raises TableProblem, which names the row, counted from 1 without the header, if there is none.
    """
    if len(knots) != len(values):
        raise TableProblem(f"there are {len(values)} values for {len(knots)} places")
    for i in range(1, len(knots)):
        if knots[i] < knots[i - 1]:
            raise TableProblem(f"row {i + 1} goes back: the first column must grow")
        if knots[i] == knots[i - 1] and values[i] != values[i - 1]:
            raise TableProblem(f"row {i + 1} jumps: a row that stands there twice has the same value twice")
        if i > 1 and knots[i] == knots[i - 2]:
            raise TableProblem(f"row {i + 1} stands there three times")
    if len(knots) < 2 or knots[0] == knots[1] or knots[-1] == knots[-2]:
        raise TableProblem("it begins and ends with a row that stands there once, and has two at least")


def _described(cell: str) -> tuple[str, str]:
    """Return name and unit of a column."""
    name, unit = named(cell) or ("", None)
    if unit is None:
        raise TableProblem(
            f"the header {shown(cell.strip())} names no unit; each column has one, as in time [s], force [N]"
        )
    return name, unit


def _has_units(line: str) -> bool:
    """Tell whether a line may be the header: some column has a unit."""
    columns = [named(cell) for cell in line.split(separator_of(line))]
    return any(column is not None and column[1] is not None for column in columns)


def _knots(unit: str) -> str:
    """Return the key of what the first column holds."""
    for key, wanted in KNOTS.items():
        try:
            to_si(f"1 {unit}", wanted)
        except UnitProblem:
            continue
        return key
    kinds = ", ".join(dimension(si) for si in KNOTS.values())
    raise TableProblem(f"the unit {shown(unit)} of the first column is none of {kinds}")


def _row(line: str, separator: str, places: Sequence[int], number: int) -> list[str]:
    cells = [cell.strip() for cell in with_points(line, separator).split(separator)]
    for place in places:
        try:
            finite = math.isfinite(float(cells[place]))
        except (ValueError, IndexError):
            finite = False
        if not finite:
            raise TableProblem(f"row {number - 1}, {shown(brief(line.strip(), LONGEST))}, lacks a number")
    return [cells[place] for place in places]


def _in_si(cells: list[str], unit: str, like: str) -> list[float]:
    return [to_si(f"{cell} {unit}", like) for cell in cells]


def _written(numbers: list[float], unit: str) -> str:
    return f"{', '.join(map(repr, numbers))} {unit}"
