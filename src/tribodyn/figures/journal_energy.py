"""The energy ledger of a journal: where the work of the load goes, law beside law."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.figures.base import Family
from tribodyn.figures.journal import laws, of_law
from tribodyn.figures.style import (
    BLUE,
    DASHDOT,
    DASHED,
    DOTTED,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    SMALL,
    SOLID,
    VERMILION,
    LineStyle,
    caption,
    finish,
    lines,
    sheet,
)

TITLE: Final = "Journal: energy ledger"
TERMS: Final[dict[str, tuple[str, str, LineStyle]]] = {
    "energy_loads": ("load work, in", INK, SOLID),
    "energy_kinetic": ("kinetic", BLUE, DASHED),
    "energy_contact": ("stored in contact", VERMILION, DASHDOT),
    "energy_damping": ("contact damping, out", GREEN, DOTTED),
    "energy_film": ("film, out", ORANGE, SOLID),
    "energy_residual": ("residual", PURPLE, DASHED),
}


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the terms of the ledger of each law over time [mJ]."""
    figure = sheet(dataset, TITLE, 3.9)
    names = laws(dataset)
    grid = figure.subplots(1, max(len(names), 1), sharey=True, squeeze=False)[0]
    time = np.asarray(dataset["time"].values, dtype=np.float64) * 1e3
    terms = {name: look for name, look in TERMS.items() if name in dataset.variables}
    for k, (axes, law) in enumerate(zip(grid, names, strict=True)):
        lines(axes, time, [(of_law(dataset, name, k, 1e3), *look) for name, look in terms.items()], width=1.0)
        residual = 100.0 * float(dataset["residual_fraction"].values[k])
        caption(axes, f"{law}: residual at most {residual:.2g} %")
        finish(axes, "time [ms]", "" if k else "energy [mJ]")
    if names:
        handles, labels = grid[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, fontsize=SMALL)
    return figure


FAMILY: Final = Family(
    name="journal_energy",
    title=TITLE,
    caption=(
        "What the load puts in is moving, stored in the contact, or has become heat of contact damping or of "
        "the film. The residual is what the integration lost or made up."
    ),
    needs=("law", "energy_loads", "energy_kinetic", "energy_contact", "energy_damping", "residual_fraction"),
    draw=draw,
)
