"""A result as one HTML file that needs nothing else: data, figures, scripts and styles inside, no network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from tribodyn.mechanisms.results import mechanism_of, summarise
from tribodyn.report import assets
from tribodyn.report.bands import bands
from tribodyn.report.content import chapters, reading, variables
from tribodyn.report.figures import figures_of
from tribodyn.report.headlines import chosen, facts, grouped, versions
from tribodyn.results import json_attribute
from tribodyn.results.summary import caution
from tribodyn.views.encode import safe_json
from tribodyn.views.numbers import in_words
from tribodyn.views.playback import clock


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
        notes=json_attribute(dataset, "notes", []),
        facts=facts(dataset),
        key=chosen(summary, mechanism.key_numbers),
        groups=grouped(summary),
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
        payload=safe_json(payload) if payload else "",
        **content,
    )


def _solver(dataset: xr.Dataset) -> dict[str, str]:
    """Return statistics of the solver and what the ledgers and the grid say."""
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
