"""Points of a sweep over each other: what a comparison of runs shows, where the sweep is small enough."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import xarray as xr

from tribodyn.mechanisms.results import mechanism_of, read
from tribodyn.report.parallel import ParallelAxis, ParallelPoint
from tribodyn.results.store import POINTS, RESULT
from tribodyn.views.overlay import overlays
from tribodyn.views.section import Chapter

MOST: Final = 6
"""Points up to which their curves can be distinguished."""
LEAD: Final = "Press the name of a run below a plot to hide or show it."


def curves_over_each_other(
    axes: Sequence[ParallelAxis], points: Sequence[ParallelPoint], folder: Path | None
) -> list[Chapter]:
    """Return the chapter with the curves of all points; none of many, or where results were not kept."""
    if folder is None or not 2 <= len(points) <= MOST:
        return []
    runs = {
        _name(axes, number): read(folder / POINTS / point.name)
        for number, point in enumerate(points)
        if _kept(folder, point)
    }
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


def _name(axes: Sequence[ParallelAxis], number: int) -> str:
    """Return the changes that lead to a point."""
    return ", ".join(f"{axis.label}: {axis.texts[number]}" for axis in axes if axis.parameter)
