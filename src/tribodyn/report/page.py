"""A result as one HTML file that needs nothing else: no network, no scripts, figures inside."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Final

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined

from tribodyn.figures import FIGURES
from tribodyn.report.numbers import in_words
from tribodyn.results import HEADLINES, json_attribute, summarise
from tribodyn.results.atomic import write_text

NAME: Final = "report.html"


def write(dataset: xr.Dataset, target: str | Path, figures: Sequence[str | Path] | None = None) -> Path:
    """Write the report of a result.

    Parameters
    ----------
    dataset
        A result, whole or partial.
    target
        File ending in ``.html``, or the folder in which ``report.html`` is to be.
    figures
        PNG files to show, in order; by default those of :func:`tribodyn.figures.draw_all` in ``figures/``
        beside the report.

    Returns
    -------
    pathlib.Path
        The file written.
    """
    path = Path(target)
    path = path if path.suffix == ".html" else path / NAME
    path.parent.mkdir(parents=True, exist_ok=True)
    shown = _beside(path) if figures is None else [Path(figure) for figure in figures]
    write_text(path, render(dataset, shown))
    return path


def _beside(path: Path) -> list[Path]:
    """Return the figures in the folder of the report, in reading order."""
    candidates = [path.parent / "figures" / f"{name}.png" for name in FIGURES]
    return [figure for figure in candidates if figure.is_file()]


def render(dataset: xr.Dataset, figures: Sequence[Path]) -> str:
    """Return the page as text.

    Every text of the result is escaped: a title may hold anything.
    """
    environment = Environment(
        loader=PackageLoader("tribodyn.report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    summary = summarise(dataset)
    return environment.get_template("page.html").render(
        title=summary["title"] or "Result",
        version=dataset.attrs.get("tribodyn_version", ""),
        failure=summary["failure"],
        time_reached=in_words(summary.get("simulated_time_s", 0.0)),
        warnings=json_attribute(dataset, "warnings", []),
        facts=_facts(dataset),
        groups=_groups(summary),
        figures=[_figure(path) for path in figures],
        case=dataset.attrs.get("case", ""),
        solver={name: in_words(value) for name, value in json_attribute(dataset, "solver", {}).items()},
        versions=_versions(dataset),
    )


def _groups(summary: Mapping[str, float | int | str]) -> list[dict[str, object]]:
    """Return the headline numbers in groups, each with its meaning."""
    known = [(name, headline) for name, headline in HEADLINES.items() if name in summary]
    return [
        {
            "name": group,
            "numbers": [
                {
                    "label": headline.label,
                    "value": in_words(summary[name]),
                    "unit": headline.unit,
                    "meaning": headline.meaning,
                }
                for name, headline in members
            ],
        }
        for group, members in groupby(known, key=lambda entry: entry[1].group)
    ]


def _facts(dataset: xr.Dataset) -> dict[str, str]:
    """Return what kind of run it was, in a few words."""
    facts = {}
    if "clearance" in dataset.attrs:
        facts["clearance"] = f"{in_words(dataset.attrs['clearance'] * 1e6)} µm"
    if "contact_law" in dataset.attrs:
        facts["contact law"] = str(dataset.attrs["contact_law"])
    if "formulation" in dataset.attrs:
        facts["formulation"] = str(dataset.attrs["formulation"])
    if "friction_coefficient" in dataset.attrs:
        # The source paper gives no value; a reader must not take the number for a measured one.
        facts["friction coefficient"] = f"{in_words(dataset.attrs['friction_coefficient'])} (assumed)"
    return facts


def _versions(dataset: xr.Dataset) -> dict[str, str]:
    """Return the versions of what made the result."""
    ending = "_version"
    return {
        name.removesuffix(ending): str(value)
        for name, value in dataset.attrs.items()
        if isinstance(name, str) and name.endswith(ending)
    }


def _figure(path: Path) -> dict[str, str]:
    """Return a figure with its title and caption, the image as a data address."""
    family = FIGURES.get(path.stem)
    return {
        "title": family.title if family else path.stem,
        "caption": family.caption if family else "",
        "source": "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode("ascii"),
    }
