"""Figures: from a result to what an engineer would look at first."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import xarray as xr

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given
from tribodyn.figures import (
    contact_force,
    energy,
    journal,
    journal_energy,
    journal_orbit,
    mechanism,
    motion,
    pressure,
    sweep,
    tilt,
    trajectory,
    vane_error,
    wear,
    wear_history,
)
from tribodyn.figures.base import Family
from tribodyn.figures.save import remove, save
from tribodyn.results.attributes import SWEEP

FIGURES: Final[dict[str, Family]] = {
    module.FAMILY.name: module.FAMILY
    for module in (
        motion,
        vane_error,
        contact_force,
        trajectory,
        tilt,
        pressure,
        wear,
        energy,
        mechanism,
    )
}
"""Every figure of a run of the mechanism, in the order in which one reads them."""

JOURNAL_FIGURES: Final[dict[str, Family]] = {
    module.FAMILY.name: module.FAMILY for module in (journal, journal_orbit, journal_energy)
}
"""Every figure of a run of the journal."""

CAMPAIGN_FIGURES: Final[dict[str, Family]] = FIGURES | {wear_history.FAMILY.name: wear_history.FAMILY}
"""Every figure of a wear campaign of the mechanism."""

_OF_RUNS: Final[dict[str, dict[str, Family]]] = {"vsv": FIGURES, "journal": JOURNAL_FIGURES}

__all__ = ["CAMPAIGN_FIGURES", "FIGURES", "JOURNAL_FIGURES", "Family", "draw_all", "figures_of"]


def figures_of(dataset: xr.Dataset) -> dict[str, Family]:
    """Return the figures that may be drawn of a result: those of a run, or of a sweep one for each number."""
    kind = str(dataset.attrs.get("kind", "vsv"))
    if kind == SWEEP:
        return sweep.families(dataset)
    if kind not in _OF_RUNS:
        raise InputError(f"{as_given(kind)}; allowed: {', '.join([*_OF_RUNS, SWEEP])}", key="kind")
    return CAMPAIGN_FIGURES if "wear_cycles" in dataset.variables else _OF_RUNS[kind]


def draw_all(dataset: xr.Dataset, directory: str | Path) -> list[Path]:
    """Draw every figure that the result holds the data for, as PNG and as PDF.

    Parameters
    ----------
    dataset
        A result, whole or partial.
    directory
        Folder to write to; made if missing. A figure left by an earlier result that this one cannot
        show is removed.

    Returns
    -------
    list of pathlib.Path
        The PNG files written, in reading order; the PDF of each stands beside it.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for family in figures_of(dataset).values():
        if family.drawable(dataset):
            written.append(save(family.draw(dataset), folder, family.name))
        else:
            remove(folder, family.name)
    return written
