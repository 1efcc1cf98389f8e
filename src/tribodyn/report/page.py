"""A result as one HTML file that needs nothing else: data, figures, scripts and styles inside, no network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from tribodyn.cases import keys_of
from tribodyn.cases.keys import ASSUMED
from tribodyn.mechanisms.results import key_numbers_of, known, mechanism_of, summarise
from tribodyn.report import assets
from tribodyn.report.bands import bands
from tribodyn.report.content import chapters, reading, variables
from tribodyn.report.figures import figures_of
from tribodyn.results import KeyResult, json_attribute
from tribodyn.results.summary import caution
from tribodyn.views.encode import inside_page
from tribodyn.views.numbers import in_words
from tribodyn.views.playback import clock

_FIRST_RESULTS: Final = 3
_FIRST_WARNINGS: Final = 2
"""Key results and warnings beside the moving mechanism; all others follow below."""

Number = dict[str, str | bool]
"""A key result with ``label``, ``value``, ``unit``, ``meaning`` and whether it is ``assumed``."""
_NO_CELL: Final = {"value": "–", "assumed": False}


def number(key_result: KeyResult, summary: Mapping[str, Any], name: str) -> Number:
    """Return a key result of a summary in words."""
    return {
        "label": key_result.label_in(summary),
        "value": in_words(summary[name], key_result.digits),
        "unit": key_result.unit,
        "meaning": key_result.meaning,
        "assumed": name in summary.get("assumed", ()),
    }


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
    numbers = [entry for entry in known(summary, str(summary["kind"])).items() if entry[1].part]
    return [
        _table(group, dict(members), summary)
        for group, members in groupby(numbers, key=lambda entry: entry[1].group)
    ]


def _table(group: str, key_results: Mapping[str, KeyResult], summary: Mapping[str, Any]) -> dict[str, Any]:
    columns = {(one.column_in(summary), one.unit): one for one in key_results.values()}
    cells = {
        (one.part, one.column_in(summary), one.unit): {
            "value": in_words(summary[name], one.digits),
            "assumed": name in summary.get("assumed", ()),
        }
        for name, one in key_results.items()
    }
    parts = dict.fromkeys(one.part for one in key_results.values())
    return {
        "name": group,
        "columns": [
            {"label": label, "unit": unit, "meaning": one.meaning} for (label, unit), one in columns.items()
        ],
        "rows": [
            {"part": part, "cells": [cells.get((part, *column), _NO_CELL) for column in columns]}
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

    Parameters
    ----------
    template
        A file in ``templates``.
    payload
        What the scripts read; without it the page has no scripts.
    content
        What the template asks for.
    """
    environment = Environment(
        loader=PackageLoader("tribodyn.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(
        inside=assets.inside(bool(payload)),
        payload=inside_page(payload) if payload else "",
        **content,
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
