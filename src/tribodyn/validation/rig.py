"""A user's own measurements, judged by the rules of the validation sets.

The file has a row for each number, named as a key result of the case and in its unit::

    quantity,measured,half_width,accepted,null,source,explanation
    force_mean_N_wrist,1462,15,10 %,1450,"bench log, run 3",

``accepted`` is a share of the measured value (``10 %``), a difference (``0.5``), an interval (``10..20``) or
empty: then the number is reported only. It is to be written before the first run.
"""

from __future__ import annotations

import csv
import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from tribodyn.cases.case import Case
from tribodyn.cases.tables import value_at
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.quoting import as_given
from tribodyn.mechanisms.results import headlines_of_case
from tribodyn.simulation import simulate
from tribodyn.studies.calibration import VariedKey
from tribodyn.studies.measured import MeasuredNumber
from tribodyn.validation.base import Comparison, Outcome
from tribodyn.validation.catalogue import ValidationSet

LARGEST: Final = 1_000_000
NEEDED: Final = ("quantity", "measured", "half_width", "accepted")
README: Final = "README.md"
NUMBERS: Final = "numbers.csv"
TIGHTER: Final = 0.1
"""Factor on the tolerance of the integration for its share of the uncertainty."""
LEAST_TOLERANCE: Final = 1e-12
"""The least tolerance that a case takes."""
TEMPLATE: Final = {
    README: """# Title: quantity, machine, conditions

**Measured.** What was measured, over which range, how often.

**Apparatus.** Machine, dimensions, materials, lubricant, sensors, temperature. What is not known.

**Uncertainty.** Half widths of 95 % intervals: of the reading, from run to run, from unit to unit.

**Source and licence.** Who measured it, when, where it is recorded, who may use it.

**Inputs.** Which keys of the case are known, and which are assumed, with their ranges (given with --assume).

**Known problems.** What may be wrong with the data.

**Use.** Which numbers are judged, with which band and why. Write the bands before the first run.
Never widen them.
""",
    NUMBERS: """quantity,measured,half_width,accepted,null,source,explanation
force_mean_N_wrist,1460,20,10 %,,example: mean force of the case slider-crank,
power_mean_W,226,5,,,example without a band: reported only,
""",
}
"""Files of a new set, by name."""


@dataclass(frozen=True)
class Rig(ValidationSet):
    """A user's own set.

    Attributes
    ----------
    path, case
        The file of numbers, and the case that they belong to.
    assumed
        Keys whose values are assumed, with their ranges.
    digest
        SHA-256 of the file.
    numbers
        Its rows.
    """

    path: Path
    case: Case
    assumed: tuple[VariedKey, ...]
    digest: str
    numbers: tuple[Mapping[str, str], ...]
    table: Mapping[str, Any] = field(default_factory=dict)

    def explanation(self, row: str) -> str:
        """Return the text of the column ``explanation``."""
        return next((one.get("explanation", "") for one in self.numbers if one["quantity"] == row), "")

    def readme(self) -> str:
        """Return the README beside the file, empty without one."""
        path = self.path.with_name(README)
        return path.read_text(encoding="utf-8") if path.is_file() else ""

    def run(self) -> Outcome:
        """Simulate the case, and again with tighter tolerance and at the ends of assumed inputs."""
        values, half_widths = self._computed()
        known = headlines_of_case(self.case)
        return Outcome(
            tuple(
                Comparison(
                    row["quantity"],
                    known[row["quantity"]].unit if row["quantity"] in known else "",
                    computed=float(values[k]),
                    measured=_number(row, "measured"),
                    u_computed=float(half_widths[k]),
                    u_measured=_number(row, "half_width"),
                    null=_number(row, "null") if row.get("null") else None,
                    band=self.bands.get(row["quantity"]),
                    note=row.get("source", ""),
                )
                for k, row in enumerate(self.numbers)
            )
        )

    def _computed(self) -> tuple[FloatArray, FloatArray]:
        """Return computed numbers and their half widths, shapes (n,)."""
        values = self._numbers_of(self.case)
        changes = []
        for variants in self._variants():
            found = np.array([self._numbers_of(self.case.replace(change)) for change in variants])
            changes.append(np.abs(found - values).max(axis=0))
        return values, np.asarray(np.sqrt(np.sum(np.square(changes), axis=0)))

    def _variants(self) -> Iterator[list[dict[str, object]]]:
        """Yield changes of the case: the tolerance, then both ends of each assumed input."""
        yield [{"solver.rtol": max(TIGHTER * value_at(self.case, "solver.rtol"), LEAST_TOLERANCE)}]
        for one in self.assumed:
            yield [{one.key.path: one.text(end)} for end in (one.low, one.high)]

    def _numbers_of(self, case: Case) -> FloatArray:
        run = simulate(case)
        numbers = (MeasuredNumber(row["quantity"], 0.0, math.nan) for row in self.numbers)
        return np.concatenate([number.computed(run) for number in numbers])


def rig(path: str | Path, case: Case, assumed: tuple[VariedKey, ...]) -> Rig:
    """Return a user's set from its file.

    Raises
    ------
    InputError
        The file is no table of numbers, or a band cannot be understood.
    """
    try:
        content = read_regular(path, LARGEST)
        rows = list(csv.DictReader(content.decode("utf-8-sig").splitlines(), skipinitialspace=True))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{as_given(str(path))} cannot be read: {error}", key="NAME") from None
    if not rows or not set(NEEDED) <= rows[0].keys():
        raise InputError(f"{as_given(str(path))} needs the columns {', '.join(NEEDED)}", key="NAME")
    numbers = tuple({name: (cell or "").strip() for name, cell in row.items() if name} for row in rows)
    digest = hashlib.sha256(content).hexdigest()
    bands = {row["quantity"]: _band(row["accepted"], Path(path).name) for row in numbers if row["accepted"]}
    for row in numbers:
        _number(row, "measured")
        _number(row, "half_width")
    table = {
        "title": f"{Path(path).name} against {case.title or case.kind()}",
        "compared": f"Numbers of {Path(path).name} (SHA-256 `{digest}`) against key results of the case.",
        "bands": bands,
        "inputs": {one.key.path: _assumed(case, one) for one in assumed},
    }
    return Rig(Path(path).stem, Path(path), case, assumed, digest, numbers, table)


def write_template(folder: Path) -> None:
    """Write README and table of a new set into a folder; files that are there already are kept.

    Raises
    ------
    InputError
        One of them is there already.
    """
    there = [name for name in TEMPLATE if (folder / name).exists()]
    if there:
        raise InputError(f"{folder} already has {', '.join(there)}; choose another folder", key="--template")
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in TEMPLATE.items():
        (folder / name).write_text(text, encoding="utf-8")


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
        if text.endswith("%"):
            return {"relative": float(text[:-1]) / 100.0, "source": source}
        if ".." in text:
            low, high = (float(end) for end in text.split(".."))
            return {"at_least": low, "at_most": high, "source": source}
        return {"absolute": float(text), "source": source}
    except ValueError:
        raise InputError(
            f"accepted is {as_given(text)}; allowed: 10 %, 0.5, 10..20 or empty", key="NAME"
        ) from None


def _assumed(case: Case, one: VariedKey) -> dict[str, Any]:
    texts = [one.text(end) for end in (float(value_at(case, one.key.path)), one.low, one.high)]
    return {"value": texts[0], "band": texts[1:], "assumed": "range given with --assume"}
