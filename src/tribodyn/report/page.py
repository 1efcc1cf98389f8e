"""A result as one HTML file that needs nothing else: data, figures, scripts and styles inside, no network."""

import json
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from mebdf.arrays import FloatArray
from tribodyn.cases import keys_of
from tribodyn.cases.keys import ASSUMED
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import key_numbers_of, known, mechanism_of, read, summarise
from tribodyn.report import assets
from tribodyn.report.content import chapters, reading, variables
from tribodyn.report.figures import figures_of
from tribodyn.results import KeyResult, json_attribute
from tribodyn.results.summary import caution
from tribodyn.views.encode import inside_page
from tribodyn.views.numbers import as_read, columns_of, fitting, in_words, interval, tables_of
from tribodyn.views.playback import clock

FOLDER: Final = "assumptions"  #: Folder beside a result in which its report looks for the sweep.
GROUPS: Final = ("Accuracy", "Load")  #: Groups of key results that the report shows.


def bands(dataset: xr.Dataset, summary: Mapping[str, Any], folder: Path) -> dict[str, Any] | None:
    """Return the bands of a run as the page shows them; nothing without a sweep of the same case.

    ``dataset``: the result of the run; ``summary``: its key results; ``folder``: where the report goes.
    Returns ``keys`` with their range in words, and ``rows`` with label, unit, value, whole band and the band
    of each key alone, the others being those of the run.
    """
    sweep = _sweep_of(dataset, folder / FOLDER / "sweep.nc")
    if sweep is None:
        return None
    case = parse_case(str(dataset.attrs["case"]), "case")
    keys = [key for key in json.loads(sweep.attrs["varied"]) if key in sweep.dims]
    here = {key: _nearest(sweep[key].values, case.at(key)) for key in keys}
    shown = known([name for name in summary if name in sweep], str(summary["kind"]))
    rows = [
        _assumed_row(key_result, summary[name], sweep[name], here)
        for name, key_result in shown.items()
        if key_result.group in GROUPS and not key_result.count
    ]
    return {"keys": [{"name": key, "range": _range(sweep[key])} for key in keys], "rows": rows}


def _assumed_row(
    key_result: KeyResult, value: Any, swept: xr.DataArray, here: Mapping[str, int]
) -> dict[str, Any]:
    """Return a key result of the run, with its band over all keys and over each alone."""
    unit, factor = fitting(key_result.unit, [value, *swept.values.ravel().tolist()])
    digits = key_result.digits
    return {
        "label": key_result.label,
        "unit": unit,
        "value": in_words(value * factor, digits),
        "whole": _band(swept.values * factor, digits),
        "alone": [_band(_alone(swept, key, here) * factor, digits) for key in here],
    }


def _sweep_of(dataset: xr.Dataset, file: Path) -> xr.Dataset | None:
    """Return the sweep in a file if it is one around the case of a result."""
    try:
        sweep = read(file)
    except InputError:
        return None
    around = bool(dataset.attrs.get("case")) and sweep.attrs.get("case") == dataset.attrs["case"]
    return sweep if around and "varied" in sweep.attrs else None


def _nearest(values: Any, value: Any) -> int:
    """Return the place of the run's own value among those of the sweep, or of the one nearest to it."""
    return int(np.argmin(np.abs(np.asarray(values, dtype=np.float64) - float(value))))


def _alone(numbers: xr.DataArray, key: str, here: Mapping[str, int]) -> FloatArray:
    """Return a number over one key, the others as in the run."""
    others = {name: place for name, place in here.items() if name != key}
    return np.asarray(numbers.isel(others).values, dtype=np.float64)


def _band(values: FloatArray, digits: int) -> str:
    """Return the smallest and the largest of the numbers that are there, in words."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return "—"
    low, high = in_words(float(finite.min()), digits), in_words(float(finite.max()), digits)
    return low if low == high else f"{low} to {high}"


def _range(values: xr.DataArray) -> str:
    """Return between which values a key was varied."""
    scale, unit = (
        float(values.attrs.get("shown_scale", 1.0)),
        as_read(str(values.attrs.get("shown_unit", ""))),
    )
    low, high = (in_words(float(end) / scale) for end in (values.min(), values.max()))
    return f"{low} to {high} {as_read(unit)}".rstrip()


_FIRST_RESULTS: Final = 3
_FIRST_WARNINGS: Final = 2  #: Key results and warnings beside the moving mechanism; all others follow below.

#: A key result with ``label``, ``value``, ``unit``, ``meaning`` and whether it is ``assumed``.
Number = dict[str, str | bool]
_NO_CELL: Final = {"value": "–", "assumed": False}


def number(key_result: KeyResult, summary: Mapping[str, Any], name: str) -> Number:
    """Return a key result of a summary in words."""
    value = summary[name]
    unit, factor = fitting(key_result.unit, [value])
    return {
        "label": key_result.label_in(summary),
        "value": interval(summary, name, factor) or _scaled(value, factor, key_result.digits),
        "unit": unit,
        "meaning": key_result.meaning,
        "assumed": name in summary.get("assumed", ()),
    }


def _scaled(value: Any, factor: float, digits: int) -> str:
    """Return a value in words, a number times a factor."""
    return in_words(value * factor if isinstance(value, float) else value, digits)


def first_numbers(summary: Mapping[str, Any]) -> list[Number]:
    """Return the key results that a reader wants first."""
    kind = str(summary["kind"])
    found = known(summary, kind)
    names = key_numbers_of(kind, found)[:_FIRST_RESULTS]
    return [number(found[name], summary, name) for name in names]


def grouped(summary: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the key results of the whole, in their groups."""
    numbers = [entry for entry in known(summary, str(summary["kind"])).items() if not entry[1].part]
    return [
        {"name": group, "numbers": [number(key_result, summary, name) for name, key_result in members]}
        for group, members in groupby(numbers, key=lambda entry: entry[1].group)
    ]


def tables(summary: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the key results of parts, such as joints: a table of parts and quantities for each kind."""
    groups = tables_of(known(summary, str(summary["kind"])))
    return [_table(group, members, summary) for group, members in groups.items() if group]


def _table(group: str, key_results: Mapping[str, KeyResult], summary: Mapping[str, Any]) -> dict[str, Any]:
    columns = columns_of(key_results, summary)
    cells = {
        (one.part, number): {
            "value": interval(summary, name, column.factor)
            or _scaled(summary[name], column.factor, one.digits),
            "assumed": name in summary.get("assumed", ()),
        }
        for number, column in enumerate(columns)
        for name, one in column.members.items()
    }
    parts = dict.fromkeys(one.part for one in key_results.values())
    return {
        "name": group,
        "columns": [
            {"label": one.label, "unit": one.unit, "meaning": next(iter(one.members.values())).meaning}
            for one in columns
        ],
        "rows": [
            {"part": part, "cells": [cells.get((part, number), _NO_CELL) for number in range(len(columns))]}
            for part in parts
        ],
    }


def facts(dataset: xr.Dataset) -> dict[str, str]:
    """Return the kind of run in a few words."""
    attributes, shown = dataset.attrs, {}
    if "clearance" in attributes:
        shown["clearance"] = f"{in_words(attributes['clearance'] * 1e6)} µm"
    if "contact_law" in attributes:
        shown["contact law"] = str(attributes["contact_law"])
    if "formulation" in attributes:
        shown["formulation"] = str(attributes["formulation"])
    if "friction_coefficient" in attributes:
        shown["friction coefficient"] = in_words(attributes["friction_coefficient"]) + _ours(dataset)
    return shown


def _ours(dataset: xr.Dataset) -> str:
    """Say of a friction coefficient that it is our default; a reader must not take it for a measured one."""
    key = keys_of(mechanism_of(dataset).case)["joint.friction_coefficient"]
    assumed = key.source == ASSUMED and dataset.attrs["friction_coefficient"] == key.default
    return " (the default, assumed)" if assumed else ""


def versions(dataset: xr.Dataset) -> dict[str, str]:
    """Return the versions of what made the result."""
    ending = "_version"
    return {
        name.removesuffix(ending): str(value)
        for name, value in dataset.attrs.items()
        if isinstance(name, str) and name.endswith(ending)
    }


def render(dataset: xr.Dataset, stills: Sequence[Path], folder: Path) -> str:
    """Return the page of a result as text; what assumptions do stands in its folder."""
    summary = summarise(dataset)
    mechanism = mechanism_of(dataset)
    shown, payloads = chapters(dataset, mechanism.chapters, stills, figures_of(dataset))
    return page(
        payload={"clock": clock(dataset), "figures": payloads} if payloads else None,
        title=summary["title"] or "Result",
        version=dataset.attrs.get("tribodyn_version", ""),
        failure=summary["failure"],
        caution=caution(summary["doubtful"]),
        time_reached=in_words(summary.get("simulated_time_s", 0.0)),
        warnings=json_attribute(dataset, "warnings", []),
        warnings_shown=_FIRST_WARNINGS,
        notes=json_attribute(dataset, "notes", []),
        facts=facts(dataset),
        key=first_numbers(summary),
        groups=grouped(summary),
        tables=tables(summary),
        opening=shown[0] if shown and shown[0]["playback"] else None,
        bands=bands(dataset, summary, folder),
        chapters=shown,
        solver=_solver(dataset),
        versions=versions(dataset),
        case=dataset.attrs.get("case", ""),
        variables=variables(dataset),
        reading=reading(()),
    )


def page(template: str = "page.html", *, payload: Mapping[str, Any] | None, **content: Any) -> str:
    """Return a page from its template.

    Every text is escaped: a title may hold anything. Only our own scripts run, named by their hashes.

    ``template``: a file in ``templates``; ``payload``: what the scripts read; without it the page has no
    scripts; ``content``: what the template asks for.
    """
    environment = Environment(
        loader=PackageLoader("tribodyn.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(
        inside=assets.inside(bool(payload)), payload=inside_page(payload) if payload else "", **content
    )


def _solver(dataset: xr.Dataset) -> dict[str, str]:
    """Return statistics of the solver and what the balances and the grid say."""
    found = {name: in_words(value) for name, value in json_attribute(dataset, "solver", {}).items()}
    residuals = {
        "energy_residual": "energy residual, whole system",
        "clearance_energy_residual": "energy residual, clearance motion",
        "grid_force_error": "force error of the grid",
    }
    return found | {
        label: f"{in_words(100.0 * dataset.attrs[name])} %"
        for name, label in residuals.items()
        if isinstance(dataset.attrs.get(name), float)
    }
