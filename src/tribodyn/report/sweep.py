"""A sweep as one page: all its points across parallel axes, and the report of each a click away."""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from tribodyn.mechanisms.results import key_numbers_of
from tribodyn.report.comparison import curves_over_each_other
from tribodyn.report.content import chapters, reading, variables
from tribodyn.report.figures import figures_of
from tribodyn.report.page import page
from tribodyn.report.parallel import ParallelAxis, ParallelPoint, at_first, axes_of, payload, points_of
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
