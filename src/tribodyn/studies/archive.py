"""The points of a sweep on disk, named by their hashes, and merged to one dataset.

Key results of a point are a line of ``points.jsonl``. A point that keeps its whole result has a folder
instead, in which ``summary.json`` is written last, the mark of a point that is done.
"""

import json
import math
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final, TextIO

import numpy as np
import xarray as xr

from tribodyn.cases import Key
from tribodyn.cases.units import si_unit, to_si
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.files import read_regular
from tribodyn.core.platforms import version
from tribodyn.core.quoting import brief
from tribodyn.mechanisms.results import known
from tribodyn.mechanisms.self_checks import YIELDED
from tribodyn.results.dataset import SWEEP, assembled, variable
from tribodyn.results.schema import is_summary
from tribodyn.results.store import (
    CASE,
    POINTS,
    RESULT,
    SUMMARY,
    adopt,
    remove_stale_parts,
    summary_text,
    write_bytes,
    write_text,
)
from tribodyn.results.summary import Summary
from tribodyn.results.variables import POINT_TEXTS
from tribodyn.studies.plan import POINT, Point, SweepPlan
from tribodyn.studies.work import PointOutcome

_LARGEST_SUMMARY: Final = 1_000_000
_LARGEST_FILE: Final = 2_000_000_000
LINES: Final = "points.jsonl"  #: File with a line of JSON for each point: its name and its key results.


class Archive:
    """Storage of points.

    ``directory``: folder of the sweep; ``points/`` in it is made when there is a point whose whole result is
    kept; ``whole``: whether each point keeps its whole result, in a folder of its own. Raises InputError if
    something else has the name of that folder.
    """

    def __init__(self, directory: Path, *, whole: bool) -> None:
        self.folder, self._file, self._whole = directory / POINTS, directory / LINES, whole
        self.staging = self.folder.absolute() / secrets.token_hex(4)
        """Path beside which workers of this machine leave whole results, under names of this sweep."""
        self._lines: TextIO | None = None
        if self.folder.exists() and not self.folder.is_dir():
            raise InputError(f"{brief(self.folder)} is a file; choose another directory", key="--output")
        self._kept = {} if whole else dict(self._read())

    def _read(self) -> Iterator[tuple[str, Summary]]:
        """Yield names and summaries of the lines that are whole, the latest of a point last."""
        try:
            lines = read_regular(self._file, _LARGEST_FILE).splitlines()
        except OSError:
            return
        for line in lines:
            with suppress(ValueError, RecursionError, TypeError, KeyError):
                found = json.loads(line)
                if isinstance(found["point"], str) and is_summary(found["summary"]):
                    yield found["point"], found["summary"]

    def find(self, point: Point) -> Summary | None:
        """Return the summary of a point that is done, with its whole result if that is kept, else None.

        A point that failed may have no result.
        """
        if point.name in self._kept:
            return self._kept[point.name]
        try:
            content = json.loads(read_regular(self.folder / point.name / SUMMARY, _LARGEST_SUMMARY))
        except (OSError, ValueError, RecursionError):
            return None
        if not is_summary(content):
            return None
        result = self.folder / point.name / RESULT
        return None if self._whole and not content.get("failure") and not result.is_file() else content

    @contextmanager
    def open(self) -> Iterator[None]:
        """Have the storage while the block runs; in the end what nobody kept goes."""
        if not self._whole:
            try:
                yield
            finally:
                if self._lines is not None:
                    os.fsync(self._lines.fileno())
                    self._lines.close()
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        remove_stale_parts(self.folder)
        try:
            yield
        finally:
            for part in self.folder.glob(f".{self.staging.name}.*.part"):
                part.unlink(missing_ok=True)
            with suppress(OSError):
                self.folder.rmdir()

    def keep(self, point: Point, outcome: PointOutcome) -> None:
        """Write a point, each file whole or not at all."""
        if not self._whole:
            self._append(_line(point.name, outcome.summary))
            return
        folder = self.folder / point.name
        folder.mkdir(parents=True, exist_ok=True)
        for part in folder.glob(".*.part"):
            part.unlink(missing_ok=True)
        write_text(folder / CASE, point.toml)
        if outcome.staged:
            adopt(Path(outcome.staged), folder / RESULT)
        elif outcome.result:
            write_bytes(folder / RESULT, outcome.result)
        write_text(folder / SUMMARY, summary_text(outcome.summary))

    def _append(self, line: str) -> None:
        """Write a line at the end of the file; what was written in part goes, and a link in its place."""
        if self._lines is None:
            write_text(self._file, "".join(_line(name, summary) for name, summary in self._kept.items()))
            self._lines = self._file.open("a", encoding="utf-8")
        self._lines.write(line)
        self._lines.flush()


def _line(name: str, summary: Summary) -> str:
    return json.dumps({"point": name, "summary": summary}, ensure_ascii=False, allow_nan=False) + "\n"


NOT_COMPUTED: Final = "not computed: the sweep was stopped before"


def refuse_failures(dataset: xr.Dataset, words: str = "a run failed") -> None:
    """Raise an error that says why a point of a merged sweep has no result, if one has none."""
    for text in dataset["failure"].values.ravel().tolist():
        if text:
            raise TribodynError(f"{words}: {text}")


_NAMED: Final = 5


def remarks(plan: SweepPlan, summaries: Mapping[str, Summary]) -> list[str]:
    """Return notes on points of a plan where they differ: some have elastic bodies as they needed them."""
    notes = {point.label: summaries.get(point.name, {}).get("notes") for point in plan.points}
    return remark(
        [label for label, of_one in notes.items() if isinstance(of_one, list) and YIELDED in of_one],
        len(notes),
    )


def remark(softer: Sequence[str], points: int) -> list[str]:
    """Return a note on the points that have elastic bodies, by their labels, if some of all points do not."""
    if len(softer) in (0, points):
        return []
    named = "; ".join(softer[:_NAMED]) + ("; ..." if len(softer) > _NAMED else "")
    return [
        f"{len(softer)} of {points} points have elastic bodies, since asperities alone do not carry "
        f'them; bulk = "conformal" gives them to all: {named}'
    ]


def merge(plan: SweepPlan, summaries: Mapping[str, Summary]) -> xr.Dataset:
    """Return the dataset of a sweep.

    Parameters
    ----------
    plan
        Its points.
    summaries
        Key results of those that were computed, by name of the point.

    Returns
    -------
    xarray.Dataset
        One dimension for each parameter of a grid, named by its dotted path, and ``point`` for samples. The
        values of the parameters are coordinates (SI; ``shown_unit`` and ``shown_scale`` say how to print
        them). One variable for each key result, NaN where a point failed or was not reached, with
        ``units`` and ``long_name``; the texts ``failure``, ``warnings``, ``doubtful`` and ``points`` of each
        point.
    """
    rows = [summaries.get(point.name, {"failure": NOT_COMPUTED}) for point in plan.points]
    shape = tuple(axis.size for axis in plan.axes)
    dims = tuple(axis.name for axis in plan.axes)

    def laid_out(values: Sequence[Any], dtype: Any, about: dict[str, str]) -> xr.Variable:
        return variable(dims, np.array(values, dtype=dtype).reshape(shape), about)

    kind = plan.case.kind()
    texts = {name: [_text(row.get(name, "")) for row in rows] for name in ("failure", "warnings", "doubtful")}
    texts["points"] = [point.name for point in plan.points]
    numbers = {name: laid_out(*_column(name, rows, kind)) for name in _numbers(rows, kind)}
    words = {
        name: laid_out(values, object, {"long_name": POINT_TEXTS[name]}) for name, values in texts.items()
    }
    return assembled(numbers | words, _coordinates(plan), _attributes(plan, rows, remarks(plan, summaries)))


def _numbers(rows: Sequence[Summary], kind: str) -> list[str]:
    """Return the names of all numbers that any point gave, the known ones first and in their order."""
    given = {name: None for row in rows for name, value in row.items() if isinstance(value, int | float)}
    first = known(given, kind)
    return [*first, *(name for name in given if name not in first)]


def _column(name: str, rows: Sequence[Summary], kind: str) -> tuple[list[float], type, dict[str, Any]]:
    """Return the values of a key result over all points; a point that failed has none."""
    found = [math.nan if row.get("failure") else row.get(name) for row in rows]
    values = [float(one) if isinstance(one, int | float) else math.nan for one in found]
    one = known([name], kind).get(name)
    if one is None:
        return values, float, {"long_name": name}
    about = {"units": one.unit or "1", "long_name": one.label, "group": one.group, "comment": one.meaning}
    return values, float, about | {"digits": 0 if one.count else one.digits}


def _text(about_number: object) -> str:
    return "; ".join(about_number) if isinstance(about_number, list) else str(about_number)


def _coordinates(plan: SweepPlan) -> dict[str, xr.Variable]:
    coordinates = {}
    for axis in plan.axes:
        if axis.name == POINT:
            numbers = np.arange(axis.size)
            coordinates[POINT] = variable((POINT,), numbers, {"long_name": "number of the sample"})
        for key, values in axis.columns.items():
            coordinates[key.path] = variable((axis.name,), np.asarray(values), _about(key))
    return coordinates


def _about(key: Key) -> dict[str, Any]:
    about: dict[str, Any] = {"long_name": key.description}
    if key.kind == "quantity":
        scale = to_si(f"1 {key.unit}", key.unit)
        about |= {"units": si_unit(key.unit), "shown_unit": key.unit, "shown_scale": scale}
    elif key.kind in {"number", "count"}:
        about["units"] = "1"
    return about


def _attributes(plan: SweepPlan, rows: Sequence[Summary], notes: Sequence[str]) -> dict[str, Any]:
    sampling: dict[str, Any] = {}
    if plan.sampled:
        s = plan.sampling
        sampling = {"samples": s.samples, "sampling_method": s.method, "sampling_seed": s.seed}
    return {
        "kind": SWEEP,
        "swept_kind": plan.case.kind(),
        "title": plan.case.title,
        "case": plan.case.to_toml(),
        "tribodyn_version": version("tribodyn"),
        "varied": json.dumps([key.path for axis in plan.axes for key in axis.columns]),
        "points_in_all": len(rows),
        "points_failed": sum(bool(row.get("failure")) for row in rows),
        "notes": json.dumps(notes),
        **sampling,
    }
