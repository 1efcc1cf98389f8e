"""Measured data of a user: from a CSV file to values beside those of a run.

A file holds one of two tables. *Curves over time* have a column of times and columns named as variables of a
result, with labels of bodies, joints and axes after points, each with its unit in brackets::

    time [ms], acceleration.slider.x [m/s^2], joint_angle.main [deg]

*Numbers* have a row for each, named as the key results of a run and in their units; the half width is that of
a 95 % interval::

    quantity, value, half_width
    contact_force_mean_N, 18.3, 0.4
"""

import csv
import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Self

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases.units import UnitProblem, to_si
from tribodyn.core.errors import InputError
from tribodyn.core.files import is_comment, named, read_regular, separator_of, text_of, with_points
from tribodyn.core.quoting import as_given, meant
from tribodyn.mechanisms.results import summarise
from tribodyn.results.columns import unit_of, variable
from tribodyn.views.playback import impact_windows

OPTION: Final = "--data"
LARGEST: Final = 20_000_000
QUANTITY: Final = "quantity"
_PLAIN: Final = {"1": 1.0, "-": 1.0, "%": 0.01}  #: Units of plain numbers.


@dataclass(frozen=True)
class MeasuredCurve:
    """A measured curve over time."""

    name: str  #: Variable of a result, with labels after points.
    unit: str  #: Unit in the file.
    scale: float  #: SI value of that unit.
    #: SI units, shape (n,).
    times: FloatArray
    values: FloatArray

    def computed(self, run: xr.Dataset) -> FloatArray:
        """Return the values of a run at the times of the curve, SI units, shape (n,)."""
        series = variable(run, self.name, OPTION)
        time = run["time"].values
        if self.times[-1] > time[-1] * (1.0 + 1e-9):
            raise InputError(
                f"the data reach to {self.times[-1]:.6g} s, the run to {time[-1]:.6g} s; lengthen "
                "run.duration or run.cycles, or shorten the data",
                key=OPTION,
            )
        return np.interp(self.times, time, series)


@dataclass(frozen=True)
class MeasuredNumber:
    """A measured number: name and unit of a key result, value, half width (NaN if unknown)."""

    name: str
    value: float
    half_width: float

    def computed(self, run: xr.Dataset) -> FloatArray:
        """Return the number of a run, shape (1,)."""
        summary = summarise(run)
        found = summary.get(self.name)
        if not isinstance(found, int | float):
            numbers = [name for name, value in summary.items() if isinstance(value, int | float)]
            raise InputError(
                f"the run has no {as_given(self.name)}; allowed: {', '.join(numbers)}"
                f"{meant(self.name, numbers)}",
                key=OPTION,
            )
        return np.array([float(found)])


@dataclass(frozen=True)
class Measured:
    """All measured data of a file."""

    parts: tuple[MeasuredCurve | MeasuredNumber, ...]  #: Curves, or numbers.
    digest: str  #: SHA-256 of the file.

    @property
    def values(self) -> FloatArray:
        """All measured values one after the other, shape (n,)."""
        return np.concatenate([_values(part) for part in self.parts])

    def computed(self, run: xr.Dataset) -> FloatArray:
        """Return the values of a run, in the same order, shape (n,)."""
        return np.concatenate([part.computed(run) for part in self.parts])

    def noise(self, share: float) -> FloatArray:
        """Return the standard uncertainty of each value, shape (n,).

        ``share``: for curves, over their range, and for numbers without a half width, over their size [1].
        """
        return np.concatenate([_noise(part, share) for part in self.parts])

    def of_parts(self, values: FloatArray) -> list[tuple[MeasuredCurve | MeasuredNumber, FloatArray]]:
        """Return values in the order of all data, by part."""
        ends = np.cumsum([_values(part).size for part in self.parts])[:-1]
        return list(zip(self.parts, np.split(values, ends), strict=True))

    def outside_impacts(self, run: xr.Dataset) -> Self:
        """Return the data without times in the impacts of a run, which do not converge."""
        windows = impact_windows(run)
        return replace(self, parts=tuple(_outside(part, windows) for part in self.parts))


@dataclass(frozen=True)
class Experiment:
    """A file of data and the run that it belongs to."""

    file: str  #: Name of the file.
    #: Keys of the case in which this run differs from the others, with their values as in a case file.
    settings: Mapping[str, object]
    data: Measured  #: What was measured.


def read(path: str | Path, run: xr.Dataset) -> Measured:
    """Return the data of a file, checked against a run.

    ``run``: a run of the case that they belong to: it has the variables and their units. Raises InputError if
    the file is no table of curves or numbers, or the run has no such quantity.
    """
    try:
        content = read_regular(path, LARGEST)
        lines = [line for line in text_of(content).splitlines() if line.strip()]
    except (OSError, ValueError) as error:
        raise InputError(f"{as_given(str(path))} cannot be read: {error}", key=OPTION) from None
    lines = [line for line in lines if not is_comment(line)]
    if len(lines) < 2:
        raise InputError(f"{as_given(str(path))} needs a header and a row of numbers", key=OPTION)
    separator = separator_of(lines[0])
    try:
        rows = list(csv.reader((with_points(line, separator) for line in lines), delimiter=separator))
    except csv.Error as error:
        raise InputError(f"{as_given(str(path))} is no table of numbers: {error}", key=OPTION) from None
    header, rows = [cell.strip() for cell in rows[0]], rows[1:]
    parts = _numbers(header, rows) if header[0] == QUANTITY else _curves(header, rows, run)
    for part in parts:
        part.computed(run)
    return Measured(tuple(parts), hashlib.sha256(content).hexdigest())


def _curves(header: Sequence[str], rows: Sequence[Sequence[str]], run: xr.Dataset) -> list[MeasuredCurve]:
    columns = [_described(cell) for cell in header]
    if columns[0][0] != "time":
        allowed = f"time [s], or {QUANTITY} for numbers"
        raise InputError(f"the first column is {as_given(header[0])}; allowed: {allowed}", key=OPTION)
    if len(columns) < 2:
        words = "the file has one column; beside the times it needs a column such as drive_moment.main [N m]"
        raise InputError(words, key=OPTION)
    times = _column(rows, 0, columns[0][1], "s")
    if not np.all(np.diff(times) > 0.0):
        raise InputError("the times must rise from row to row", key=OPTION)
    curves = []
    for k, (name, unit) in enumerate(columns[1:], 1):
        variable(run, name, OPTION)
        like = unit_of(run, name)
        values, (zero, one) = _column(rows, k, unit, like), _zero_and_one(k, unit, like)
        curves.append(MeasuredCurve(name, unit, one - zero, times, values))
    return curves


def _described(cell: str) -> tuple[str, str]:
    """Return name and unit of a column."""
    column = named(cell)
    if column is None or column[1] is None:
        raise InputError(f"column {as_given(cell)} needs a unit in brackets", key=OPTION)
    return column[0], column[1]


def _numbers(header: Sequence[str], rows: Sequence[Sequence[str]]) -> list[MeasuredNumber]:
    if "value" not in header:
        raise InputError(f"a table of numbers needs the columns {QUANTITY}, value", key=OPTION)
    tables = [dict(zip(header, (cell.strip() for cell in row), strict=False)) for row in rows]
    for number, row in enumerate(tables, 1):
        if "value" not in row:
            raise InputError(f"row {number} has no value: {as_given(row[QUANTITY])}", key=OPTION)
    return [
        MeasuredNumber(row[QUANTITY], _float(row["value"]), _float(row.get("half_width") or "nan"))
        for row in tables
    ]


def _column(rows: Sequence[Sequence[str]], k: int, unit: str, like: str) -> FloatArray:
    """Return a column in SI units, shape (n,)."""
    values = np.array([_float(row[k]) if k < len(row) else math.nan for row in rows])
    if not np.isfinite(values).all():
        raise InputError(f"column {k + 1} has a cell without a finite number", key=OPTION)
    zero, one = _zero_and_one(k, unit, like)
    return zero + (one - zero) * values


def _zero_and_one(k: int, unit: str, like: str) -> tuple[float, float]:
    """Return 0 and 1 in the unit of a column, in SI units."""
    if like == "":
        if unit not in _PLAIN:
            allowed = ", ".join(_PLAIN)
            raise InputError(
                f"column {k + 1} is a plain number, {as_given(unit)}; allowed: {allowed}", key=OPTION
            )
        return 0.0, _PLAIN[unit]
    try:
        return to_si(f"0 {unit}", like), to_si(f"1 {unit}", like)
    except UnitProblem as problem:
        raise InputError(f"column {k + 1}: {problem}", key=OPTION) from None


def _float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InputError(f"{as_given(text)} is no number", key=OPTION) from None


def _values(part: MeasuredCurve | MeasuredNumber) -> FloatArray:
    return part.values if isinstance(part, MeasuredCurve) else np.array([part.value])


def _noise(part: MeasuredCurve | MeasuredNumber, share: float) -> FloatArray:
    if isinstance(part, MeasuredCurve):
        return np.full(part.values.size, share * float(np.ptp(part.values)) or 1.0)
    known = math.isfinite(part.half_width) and part.half_width > 0.0
    return np.array([0.5 * part.half_width if known else share * abs(part.value) or 1.0])


def _outside(part: MeasuredCurve | MeasuredNumber, windows: FloatArray) -> MeasuredCurve | MeasuredNumber:
    if isinstance(part, MeasuredNumber):
        return part
    kept = np.ones(part.times.size, dtype=bool)
    for begin, end in windows:
        kept &= (part.times < begin) | (part.times > end)
    if not kept.any():
        raise InputError(f"every time of {part.name} lies in an impact", key=OPTION)
    return replace(part, times=part.times[kept], values=part.values[kept])
