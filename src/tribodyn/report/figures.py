"""The figures of a result as files: which there are, and drawing them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import xarray as xr

from tribodyn.figures import sweep
from tribodyn.figures.figure_family import Family, remove, save
from tribodyn.mechanisms.results import all_there, mechanism_of


def figures_of(dataset: xr.Dataset) -> Mapping[str, Family]:
    """Return the figures that may be drawn of a result: those of a run, or of a sweep one for each number."""
    if dataset.attrs.get("kind") == "sweep":
        return sweep.families(dataset)
    return mechanism_of(dataset).figures


def draw_all(dataset: xr.Dataset, directory: str | Path, *, part: slice = slice(None)) -> list[Path]:
    """Draw every figure that the result holds the data for, as PNG and as PDF.

    Parameters
    ----------
    dataset
        A result, whole or partial.
    directory
        Folder to write to; made if missing. A figure left by an earlier result that this one cannot
        show is removed.
    part
        Which of them: processes that share the work take every other one.

    Returns
    -------
    list of pathlib.Path
        The PNG files written, in reading order; the PDF of each is in the same folder.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for family in list(figures_of(dataset).values())[part]:
        if family.drawable(dataset):
            with all_there(dataset):
                written.append(save(family.draw(dataset), folder, family.name))
        else:
            remove(folder, family.name)
    return written
