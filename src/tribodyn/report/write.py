"""The reports of a result, whatever kind it is, and of a sweep with all its points."""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any, Final

import xarray as xr

from tribodyn.mechanisms.results import all_there, key_numbers_of
from tribodyn.report.comparison import curves_over_each_other
from tribodyn.report.content import chapters, reading, variables
from tribodyn.report.figures import figures_of
from tribodyn.report.page import page, render
from tribodyn.report.parallel import ParallelAxis, ParallelPoint, at_first, axes_of, payload, points_of
from tribodyn.results.dataset import SWEEP
from tribodyn.results.store import write_text
from tribodyn.results.summary import caution
from tribodyn.views.section import Chapter, Section


def render_sweep(dataset: xr.Dataset, stills: Sequence[Path], folder: Path | None) -> str:
    """Return the page of a sweep as text.

    ``stills``: PNG files of its figures, shown below; ``folder``: where the sweep is stored: reports of
    points that are there are linked.
    """
    axes, points = axes_of(dataset), points_of(dataset, folder)
    first = key_numbers_of(str(dataset.attrs.get("swept_kind", "")), [axis.name for axis in axes])
    section = Section(
        name="parallel",
        title="All points",
        caption=(
            "Each line is a point of the sweep. Click a line where it meets an axis to open the report of "
            "that point. Choose below which axes stand side by side; colours follow the first of them. "
            "Grey dashed lines are points whose energy balance misses too much: do not use their numbers."
        ),
        needs=(),
        widget="parallel",
        data=lambda _: payload(axes, points, first),
    )
    lead = "Parameters at the left, what came out at the right."
    planned = [
        Chapter("all", "Side by side", lead, (section,)),
        *curves_over_each_other(axes, points, folder),
    ]
    shown, payloads = chapters(dataset, planned, stills, figures_of(dataset))
    lost = [point for point in points if point.failure]
    return page(
        "sweep.html",
        payload={"clock": None, "figures": payloads} if payloads else None,
        title=str(dataset.attrs.get("title", "")) or "Sweep",
        version=dataset.attrs.get("tribodyn_version", ""),
        count=len(points),
        lost=len(lost),
        failures=_reasons(lost),
        ranges=[_range(axis) for axis in axes],
        chapters=shown,
        columns=[axis.label for axis in _columns(axes, first)],
        rows=[_row(k, point, _columns(axes, first)) for k, point in enumerate(points)],
        case=dataset.attrs.get("case", ""),
        variables=variables(dataset),
        reading=reading((), "sweep.nc"),
    )


def _columns(axes: Sequence[ParallelAxis], first: Collection[str]) -> list[ParallelAxis]:
    """Return the content of the table of points."""
    names = at_first(list(axes), first)
    return [axis for axis in axes if axis.name in names]


def _reasons(lost: Sequence[ParallelPoint]) -> list[dict[str, Any]]:
    """Return the reasons why points have no numbers, each once, the most frequent first."""
    counts: dict[str, int] = {}
    for point in lost:
        counts[point.failure] = counts.get(point.failure, 0) + 1
    return [{"text": text, "count": counts[text]} for text in sorted(counts, key=lambda text: -counts[text])]


def _range(axis: ParallelAxis) -> dict[str, Any]:
    """Return name, smallest and largest value of an axis, with the points that have them."""
    order = [int(k) for k in axis.values.argsort() if axis.values[k] == axis.values[k]]
    if axis.categories or not order:
        return {
            "label": axis.label,
            "low": ", ".join(axis.categories) or "—",
            "high": "",
            "parameter": axis.parameter,
        }
    return {
        "label": axis.label,
        "low": axis.texts[order[0]],
        "high": axis.texts[order[-1]],
        "parameter": axis.parameter,
    }


def _row(number: int, point: ParallelPoint, columns: Sequence[ParallelAxis]) -> dict[str, Any]:
    """Return a point for the table."""
    return {
        "number": number + 1,
        "name": point.name,
        "link": point.link,
        "failure": point.failure,
        "caution": caution(point.doubtful),
        "cells": [
            {"text": axis.texts[number], "doubtful": bool(point.doubtful) and not axis.parameter}
            for axis in columns
        ],
    }


NAME: Final = "report.html"


def write(dataset: xr.Dataset, target: str | Path, figures: Sequence[str | Path] | None = None) -> Path:
    """Write the report of a result.

    Parameters
    ----------
    dataset
        A result, whole or partial, or a sweep.
    target
        File ending in ``.html``, or the folder in which ``report.html`` is to be.
    figures
        PNG files that stand for the live figures on paper, in order; by default those of
        :func:`tribodyn.report.draw_all` in ``figures/`` beside the report.

    Returns
    -------
    pathlib.Path
        The file written.
    """
    path = Path(target)
    path = path if path.suffix == ".html" else path / NAME
    path.parent.mkdir(parents=True, exist_ok=True)
    stills = _beside(path, dataset) if figures is None else [Path(figure) for figure in figures]
    sweep = dataset.attrs.get("kind") == SWEEP
    with all_there(dataset):
        page = (render_sweep if sweep else render)(dataset, stills, path.parent)
    write_text(path, page)
    return path


def _beside(path: Path, dataset: xr.Dataset) -> list[Path]:
    """Return the figures in the folder of the report, in reading order."""
    candidates = [path.parent / "figures" / f"{name}.png" for name in figures_of(dataset)]
    return [figure for figure in candidates if figure.is_file()]
