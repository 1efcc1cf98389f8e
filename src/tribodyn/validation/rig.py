"""A user's own measurements, judged by the rules of the validation sets; files to fill in.

The file has a row for each number, named as a key result of the case and in its unit::

    quantity,measured,half_width,accepted,null,source,explanation
    force_mean_N_wrist,1462,15,10 %,1450,"bench log, run 3",

``accepted`` is a share of the measured value (``10 %``), a difference (``0.5``), an interval (``10..20``) or
empty: then the number is reported only. It is to be written before the first run.

A row whose ``measured`` names a CSV file beside it compares a column of that file, a curve over time, by the
root mean square of its difference; ``half_width`` and ``accepted`` are in the unit of the column, or a share
of the range of the measured curve::

    acceleration.slider.x,run.csv,50,5 %,,"bench log, run 3",
"""

import csv
import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.cases.tables import value_at
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular, text_of
from tribodyn.core.quoting import as_given
from tribodyn.mechanisms.results import key_results_of_case
from tribodyn.simulation import simulate
from tribodyn.studies.calibration import VariedKey
from tribodyn.studies.measured import Measured, MeasuredCurve, MeasuredNumber, read
from tribodyn.validation.base import Band, Comparison, Curve, Kind, Outcome, Plot, Sides, rms
from tribodyn.validation.catalogue import ValidationSet, sides_of

LARGEST: Final = 1_000_000
MOST: Final = 1000  #: Rows of a file, at most.
NEEDED: Final = ("quantity", "measured", "half_width", "accepted")
TIGHTER: Final = 0.1  #: Factor on the tolerance of the integration for its share of the uncertainty.
LEAST_TOLERANCE: Final = 1e-12  #: The least tolerance that a case takes.


@dataclass(frozen=True)
class Rig(ValidationSet):
    """A user's own set."""

    #: The file of numbers, and the case that they belong to.
    path: Path
    case: Case
    assumed: tuple[VariedKey, ...]  #: Keys whose values are assumed, with their ranges.
    digest: str  #: SHA-256 of the file.
    numbers: tuple[Mapping[str, str], ...]  #: Its rows.
    table: Mapping[str, Any] = field(default_factory=dict)

    def explanation(self, row: str) -> str:
        """Return the text of the column ``explanation``."""
        return next((one.get("explanation", "") for one in self.numbers if one["quantity"] == row), "")

    def readme(self) -> str:
        """Return the README beside the file, empty without one."""
        path = self.path.with_name(README)
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    def run(self) -> Outcome:
        """Simulate the case, and again with tighter tolerance and at the ends of assumed inputs."""
        run = simulate(self.case)
        parts = [self._part(row, run) for row in self.numbers]
        data = Measured(tuple(parts), self.digest)
        try:
            values = data.computed(run)
        except InputError as error:
            raise InputError(error.reason, key="NAME") from None
        below, above = self._sides(data, values)
        rows, drawn = [], []
        for row, (part, of_row), (_, low), (_, high) in zip(
            self.numbers, *(data.of_parts(each) for each in (values, below, above)), strict=True
        ):
            if isinstance(part, MeasuredCurve):
                rows.append(self._of_curve(row, part, of_row, np.maximum(low, high)))
                drawn.append((part, of_row))
            else:
                rows.append(self._of_number(row, float(of_row[0]), (float(low[0]), float(high[0]))))
        return Outcome(tuple(rows), _plot(drawn) if drawn else None)

    def _part(self, row: Mapping[str, str], run: xr.Dataset) -> MeasuredCurve | MeasuredNumber:
        """Return the measured quantity of a row: a number, or a column of the file that it names."""
        if not _is_file(row["measured"]):
            return MeasuredNumber(row["quantity"], 0.0, math.nan)
        try:
            parts = read(self.path.with_name(row["measured"]), run).parts
        except InputError as error:
            raise InputError(f"{row['measured']}: {error.reason}", key="NAME") from None
        names = [part.name for part in parts]
        if row["quantity"] not in names:
            raise InputError(
                f"{row['measured']} has no such column: {as_given(row['quantity'])}; "
                f"allowed: {', '.join(names)}",
                key="NAME",
            )
        return parts[names.index(row["quantity"])]

    def _of_number(self, row: Mapping[str, str], value: float, sides: Sides) -> Comparison:
        known = key_results_of_case(self.case)
        return Comparison(
            row["quantity"],
            known[row["quantity"]].unit if row["quantity"] in known else "",
            computed=value,
            measured=_number(row, "measured"),
            u_computed=sides,
            u_measured=_number(row, "half_width"),
            null=_number(row, "null") if row.get("null") else None,
            band=self.bands.get(row["quantity"]),
            note=row.get("source", ""),
        )

    def _of_curve(
        self, row: Mapping[str, str], curve: MeasuredCurve, values: FloatArray, half_widths: FloatArray
    ) -> Comparison:
        """Return the root mean square of the difference; the null model is the mean of the measured curve."""
        band = self.bands.get(row["quantity"])
        return Comparison(
            row["quantity"],
            f"{curve.unit}, rms difference",
            computed=rms(values - curve.values) / curve.scale,
            measured=0.0,
            u_computed=rms(half_widths) / curve.scale,
            u_measured=_number(row, "half_width"),
            null=float(np.std(curve.values)) / curve.scale,
            band=None if band is None else _of_difference(band, float(np.ptp(curve.values)) / curve.scale),
            note=row.get("source", ""),
        )

    def _sides(self, data: Measured, values: FloatArray) -> FloatArray:
        """Return widths below and above computed values by tolerance and assumed inputs, shape (2, n).

        The change by the tolerance, whose sign is accidental, counts on both sides.
        """
        tolerance, *assumed = (
            np.array([data.computed(simulate(self.case.replace(change))) for change in variants])
            for variants in self._variants()
        )
        return sides_of(values, [np.vstack([tolerance, 2.0 * values - tolerance]), *assumed])

    def _variants(self) -> Iterator[list[dict[str, object]]]:
        """Yield changes of the case: the tolerance, then both ends of each assumed input."""
        yield [{"solver.rtol": max(TIGHTER * value_at(self.case, "solver.rtol"), LEAST_TOLERANCE)}]
        for one in self.assumed:
            yield [{one.key.path: one.text(end)} for end in (one.low, one.high)]


def rig(path: str | Path, case: Case, assumed: tuple[VariedKey, ...]) -> Rig:
    """Return a user's set from its file.

    Raises InputError if the file is no table of numbers, or a band cannot be understood.
    """
    try:
        content = read_regular(path, LARGEST)
        rows = list(csv.DictReader(text_of(content).splitlines(), skipinitialspace=True))
    except (OSError, ValueError, csv.Error) as error:
        raise InputError(f"{as_given(str(path))} cannot be read: {error}", key="NAME") from None
    if not rows or not set(NEEDED) <= rows[0].keys():
        raise InputError(f"{as_given(str(path))} needs the columns {', '.join(NEEDED)}", key="NAME")
    if len(rows) > MOST:
        raise InputError(f"{as_given(str(path))} has {len(rows)} rows; allowed: {MOST} at most", key="NAME")
    numbers = tuple({name: (cell or "").strip() for name, cell in row.items() if name} for row in rows)
    _check_names([row["quantity"] for row in numbers])
    digest = hashlib.sha256(content).hexdigest()
    bands = {row["quantity"]: _band(row["accepted"], Path(path).name) for row in numbers if row["accepted"]}
    for row in numbers:
        if not _is_file(row["measured"]):
            _number(row, "measured")
        elif Path(row["measured"]).name != row["measured"]:
            raise InputError(
                f"{row['quantity']}: measured is {as_given(row['measured'])}; "
                "allowed: a file in the same folder",
                key="NAME",
            )
        if _number(row, "half_width") < 0.0:
            raise InputError(
                f"{row['quantity']}: half_width is {as_given(row['half_width'])}; allowed: 0 or more",
                key="NAME",
            )
    table = {
        "kind": Kind.OWN,
        "title": f"{Path(path).name} against {case.title or case.kind()}",
        "compared": f"Numbers of {Path(path).name} (SHA-256 `{digest}`) against key results of the case.",
        "bands": bands,
        "inputs": {one.key.path: _assumed(case, one) for one in assumed},
    }
    return Rig(Path(path).stem, Path(path), case, assumed, digest, numbers, table)


def _check_names(names: Sequence[str]) -> None:
    """Refuse rows without a name, and two rows of one."""
    for name in names:
        if not name:
            raise InputError("a row has no quantity; name a key result of the case", key="NAME")
        if names.count(name) > 1:
            raise InputError(f"two rows have the quantity {as_given(name)}; leave out one", key="NAME")


def _is_file(text: str) -> bool:
    return text.lower().endswith(".csv")


def _of_difference(band: Band, size: float) -> Band:
    """Return the band of a root mean square difference from that of a row; ``size`` is the measured range."""
    if band.relative is not None:
        return replace(band, relative=None, at_most=band.relative * size)
    return replace(band, absolute=None, at_most=band.absolute) if band.absolute is not None else band


def _plot(drawn: Sequence[tuple[MeasuredCurve, FloatArray]]) -> Plot:
    """Return measured and computed curves over time; those in the unit of the first."""
    unit = drawn[0][0].unit
    curves = []
    for curve, values in drawn:
        if curve.unit == unit:
            times = curve.times
            measured, computed = (curve.values / curve.scale), (values / curve.scale)
            curves.append(Curve(f"{curve.name}, measured", "measured", times, measured))
            curves.append(Curve(f"{curve.name}, computed", "computed", times, computed))
    return Plot("time [s]", f"[{unit}]", tuple(curves))


def _number(row: Mapping[str, str], column: str) -> float:
    try:
        value = float(row[column])
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{row['quantity']}: {column} is {as_given(row[column])}, no number", key="NAME")
    return value


def _band(text: str, file: str) -> dict[str, Any]:
    """Return an acceptance band as the table of a set has it."""
    source = f"accepted = {text} in {file}"
    try:
        low, high = (float(end) for end in (text.split("..") if ".." in text else ("0", text.rstrip("% "))))
    except ValueError:
        low, high = 0.0, math.nan
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise InputError(
            f"accepted is {as_given(text)}; allowed: 10 %, 0.5, 10..20 (rising) or empty", key="NAME"
        )
    if ".." in text:
        return {"at_least": low, "at_most": high, "source": source}
    if text.endswith("%"):
        return {"relative": high / 100.0, "source": source}
    return {"absolute": high, "source": source}


def _assumed(case: Case, one: VariedKey) -> dict[str, Any]:
    texts = [one.text(end) for end in (float(value_at(case, one.key.path)), one.low, one.high)]
    return {"value": texts[0], "band": texts[1:], "assumed": "range given with --assume"}


README: Final = "README.md"


def write_template(folder: Path) -> None:
    """Write README and table of a new set into a folder; files that are there already are kept.

    Raises InputError if one of them is there already.
    """
    template = list(files("tribodyn.validation").joinpath("template").iterdir())
    there = sorted(file.name for file in template if (folder / file.name).exists())
    if there:
        raise InputError(f"{folder} already has {', '.join(there)}; choose another folder", key="--template")
    folder.mkdir(parents=True, exist_ok=True)
    for file in template:
        (folder / file.name).write_bytes(file.read_bytes())
