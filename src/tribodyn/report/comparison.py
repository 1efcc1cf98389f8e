"""Several runs on one page: what differs on top, then their curves over each other."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import xarray as xr

from tribodyn.core import files
from tribodyn.mechanisms.results import all_there, known, mechanism_of, read, summarise
from tribodyn.report.content import chapters, reading
from tribodyn.report.page import page
from tribodyn.report.parallel import ParallelAxis, ParallelPoint
from tribodyn.results import KeyResult, json_attribute
from tribodyn.results.store import POINTS, RESULT, write_text
from tribodyn.results.summary import caution
from tribodyn.views.common import in_common, overlays
from tribodyn.views.numbers import fitting, in_words, interval
from tribodyn.views.section import Chapter

MOST: Final = 6  #: Points up to which their curves can be distinguished.
LEAD: Final = "Press the name of a run below a plot to hide or show it."


def curves_over_each_other(
    axes: Sequence[ParallelAxis], points: Sequence[ParallelPoint], folder: Path | None
) -> list[Chapter]:
    """Return the chapter with the curves of all points; none of many, or where results were not kept."""
    if folder is None or not 2 <= len(points) <= MOST:
        return []
    varied = [axis for axis in axes if axis.parameter]
    names = [", ".join(f"{axis.label}: {axis.texts[k]}" for axis in varied) for k in range(len(points))]
    kept = [(name, point) for name, point in zip(names, points, strict=True) if _kept(folder, point)]
    runs = {name: read(folder / POINTS / point.name) for name, point in kept}
    return [chapter_of(runs)] if len(runs) > 1 else []


def chapter_of(runs: dict[str, xr.Dataset]) -> Chapter:
    """Return the chapter with the curves of runs, by their names."""
    planned = {
        overlay.name: overlay for dataset in runs.values() for overlay in mechanism_of(dataset).overlays
    }
    return Chapter("curves", "Curves over each other", LEAD, overlays(list(planned.values()), runs))


def _kept(folder: Path, point: ParallelPoint) -> bool:
    """Tell whether the whole result of a point is there; a name or a link could lead elsewhere."""
    place = folder / POINTS / point.name
    inside = Path(point.name).name == point.name and not place.is_symlink()
    return inside and (place / RESULT).is_file()


#: Groups of key results that are of each whole run; all others are of the stretch that the runs share.
OF_RUN: Final = ("Wear", "Loss", "Trust", "Effort")
#: Names of such numbers in other groups, as those of joints.
_OF_RUN: Final = re.compile(r"(^|_)(wear|life|heat)(_|$)")
_ALIKE: Final = 2.0  #: Ratio of the cycles of two runs from which on it is named.
OF_FORCE: Final = ("Load", "Joints")  #: Groups of key results that the error of the grid is of.
NO_DIFFERENCE: Final = "no difference"
NOTABLE: Final = 0.01  #: Relative difference from the first run above which a number stands out.


@dataclass(frozen=True)
class ComparedRun:
    """A run to compare."""

    name: str  #: What it is called on the page.
    dataset: xr.Dataset  #: Its result.
    link: str = ""  #: Address of its own report, empty where there is none.


@dataclass(frozen=True)
class RunDifferences:
    """Differences between runs; the others are compared with the first."""

    #: Keys of the cases that are not the same in all runs: ``path`` and ``values``.
    keys: Sequence[Mapping[str, Any]]
    #: Key results in groups: ``name`` and ``rows``, of which each has ``label``, ``unit`` and, for each run,
    #: a cell of ``value``, ``change``, whether that is ``notable`` and the run ``doubtful``.
    groups: Sequence[Mapping[str, Any]]
    #: What numbers of the motion were taken from, in a sentence; empty where that is each whole run.
    stretch: str
    summaries: Sequence[Mapping[str, Any]]  #: The numbers themselves, for each run.


def differences(results: Sequence[xr.Dataset]) -> RunDifferences:
    """Return the differences between results, like beside like."""
    summaries, stretch = _compared(results)
    stretch = " ".join(filter(None, (stretch or _of_lengths(summaries), _of_whole_runs(summaries))))
    grid = max(float(result.attrs.get("grid_force_error", 0.0)) for result in results)
    return RunDifferences(_different_keys(results), _numbers(summaries, grid), stretch, summaries)


def write_comparison(runs: Sequence[ComparedRun], target: str | Path) -> Path:
    """Write the page that compares runs.

    Parameters
    ----------
    runs
        Two or more, each with its own name; differences are from the first.
    target
        File to write.

    Returns
    -------
    pathlib.Path
        The file written.
    """
    path = Path(target)
    path.parent.mkdir(parents=True, exist_ok=True)
    with all_there(*(run.dataset for run in runs)):
        page = render(runs)
    write_text(path, page)
    return path


def render(runs: Sequence[ComparedRun]) -> str:
    """Return the page as text."""
    planned = chapter_of({run.name: run.dataset for run in runs})
    shown, payloads = chapters(runs[0].dataset, [planned])
    found = differences([run.dataset for run in runs])
    return page(
        "compare.html",
        payload={"clock": None, "figures": payloads} if payloads else None,
        title=f"Comparison of {len(runs)} runs",
        version=runs[0].dataset.attrs.get("tribodyn_version", ""),
        runs=[_about(run, summary) for run, summary in zip(runs, found.summaries, strict=True)],
        stretch=found.stretch,
        groups=found.groups,
        keys=found.keys,
        chapters=shown,
        reading=reading(()),
    )


def _compared(results: Sequence[xr.Dataset]) -> tuple[list[dict[str, Any]], str]:
    """Return summaries of the same stretch, and in a sentence what they were taken from.

    Numbers of the motion, of the whole and of its joints, outputs and drives, are those of what all results
    hold; wear, heat, trust and effort are those of each whole run.
    """
    alike, stretch = in_common(results)
    summaries = []
    for result, part in zip(results, alike, strict=True):
        whole, cut = summarise(result), summarise(part)
        known_here = known([*whole, *cut], str(whole["kind"]))
        of_stretch = {
            name
            for name, key_result in known_here.items()
            if key_result.group not in OF_RUN and not _OF_RUN.search(name)
        }
        summaries.append(
            {name: value for name, value in whole.items() if name not in of_stretch}
            | {name: value for name, value in cut.items() if name in of_stretch}
        )
    return summaries, stretch


def _of_lengths(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Return a sentence on the lengths of runs whose numbers are of each whole run, where these differ."""
    times = [float(summary.get("simulated_time_s", 0.0)) for summary in summaries]
    if max(times) <= (1.0 + NOTABLE) * min(times):
        return ""
    listed = ", ".join(f"{time:.4g} s" for time in times)
    return f"All numbers are of each whole run, and these last differently: {listed}."


def _of_whole_runs(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Return a sentence on the cycles of wear that runs went through, where these are far apart."""
    cycles = [int(summary.get("wear_cycles", 0)) or 1 for summary in summaries]
    if max(cycles) < _ALIKE * min(cycles):
        return ""
    listed = ", ".join(f"{number:,}" for number in cycles)
    return f"Wear is of the whole runs, which went through different numbers of drive cycles: {listed}."


def _about(run: ComparedRun, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return name, title and warnings of a run."""
    failure = f"stopped at t = {in_words(summary.get('simulated_time_s', 0.0))} s: {summary['failure']}"
    caution_of_run = caution(summary["doubtful"])
    warnings = [caution_of_run] if caution_of_run else []
    warnings += [failure] if summary["failure"] else []
    return {
        "name": run.name,
        "title": summary["title"],
        "link": run.link,
        "warnings": warnings + json_attribute(run.dataset, "warnings", []),
    }


def _numbers(summaries: Sequence[Mapping[str, Any]], grid: float) -> list[dict[str, Any]]:
    """Return, in groups, every key result that any run has, with the difference from the first run."""
    names = {name: None for summary in summaries for name in summary}
    kinds = {str(summary["kind"]) for summary in summaries}
    kind = kinds.pop() if len(kinds) == 1 else ""
    rows = [_row(name, key_result, summaries, grid) for name, key_result in known(names, kind).items()]
    return [
        {"name": name, "rows": list(members)} for name, members in groupby(rows, lambda row: row["group"])
    ]


def _row(
    name: str, key_result: KeyResult, summaries: Sequence[Mapping[str, Any]], grid: float
) -> dict[str, Any]:
    values = [summary.get(name) for summary in summaries]
    unit, factor = fitting(key_result.unit, values)
    shown = [value * factor if isinstance(value, float) else value for value in values]
    return {
        "label": _label(key_result, summaries),
        "unit": unit,
        "group": key_result.group,
        "cells": [
            {
                **_cell(value, shown[0], key_result, grid),
                **({"value": ends} if (ends := interval(summary, name, factor)) else {}),
                "doubtful": bool(summary["doubtful"]),
            }
            for value, summary in zip(shown, summaries, strict=True)
        ],
    }


def _label(key_result: KeyResult, summaries: Sequence[Mapping[str, Any]]) -> str:
    """Return the label of a row; after how many reversals a peak was looked for, where that is one number."""
    labels = {key_result.label_in(summary) for summary in summaries}
    return labels.pop() if len(labels) == 1 else key_result.label


def _cell(value: Any, first: Any, key_result: KeyResult, grid: float) -> dict[str, Any]:
    """Return a number, and in percent how far it is from that of the first run.

    What is less than the digits that hold, or of forces than the error of the grid, is no difference.
    """
    if value is None:
        return {"value": "—", "change": "", "notable": False}
    words = in_words(value, key_result.digits)
    if first is None or not first or value == first:
        return {"value": words, "change": "", "notable": False}
    share = (value - first) / abs(first)
    if abs(share) <= max(
        0.5 * 10.0 ** (1 - key_result.digits), grid if key_result.group in OF_FORCE else 0.0
    ):
        return {"value": words, "change": NO_DIFFERENCE, "notable": False}
    way = "+" if share > 0.0 else ""
    change = (
        f"{way}{in_words(100.0 * share, 2)} %" if abs(share) < 10.0 else f"× {in_words(value / first, 2)}"
    )
    return {
        "value": words,
        "change": change.replace("-", "−"),
        # How much work it was depends on the machine: no result stands out by that.
        "notable": abs(share) > NOTABLE and key_result.group != "Effort",
    }


def _different_keys(datasets: Sequence[xr.Dataset]) -> list[dict[str, Any]]:
    """Return the keys of the cases that are not the same in all runs."""
    cases = [_flat(_case(dataset)) for dataset in datasets]
    paths = {path: None for case in cases for path in case}
    rows = [{"path": path, "values": [case.get(path, "—") for case in cases]} for path in paths]
    return [row for row in rows if len(set(row["values"])) > 1]


def _case(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the tables of a case; none where its text is not TOML."""
    try:
        return files.parse(str(dataset.attrs.get("case", "")))
    except ValueError:
        return {}


def _flat(tables: Mapping[str, Any], prefix: str = "") -> dict[str, str]:
    """Return nested tables as texts by dotted path."""
    flat: dict[str, str] = {}
    for name, value in tables.items():
        path = prefix + name
        flat |= _flat(value, f"{path}.") if isinstance(value, dict) else {path: str(value) or "(empty)"}
    return flat
