"""The figures of the paper from our own runs, listed once, and how they and the claims are written."""

import json
from pathlib import Path
from typing import Final

import xarray as xr

from tribodyn.figures.chart import save_png
from tribodyn.papers.cheng_2022 import clearance, drive, journal, trunnion, undamped
from tribodyn.papers.cheng_2022.claims import summary
from tribodyn.papers.cheng_2022.claims.table import Row, as_json, as_markdown
from tribodyn.papers.cheng_2022.runs import FORMULATIONS, PaperFigure, Runs
from tribodyn.results import netcdf_content
from tribodyn.results.store import write_bytes, write_text

#: Every figure of the paper that shows results, by name, and two that its conclusions ask for.
FIGURES: Final[dict[str, PaperFigure]] = {
    figure.name: figure
    for figure in (
        journal.DRY,
        journal.OIL,
        drive.CRANK,
        drive.VANE,
        trunnion.FORCES,
        trunnion.PATH,
        trunnion.VELOCITIES,
        trunnion.PRESSURE,
        clearance.MOTION,
        clearance.FORCES,
        clearance.ATTITUDE,
        clearance.WEAR,
        drive.SPLIT,
        undamped.UNDAMPED,
    )
}

__all__ = ["FIGURES", "FORMULATIONS", "PaperFigure", "Runs"]


def save_figure(figure: PaperFigure, data: xr.Dataset, folder: Path) -> None:
    """Write ``fig12.png`` and its data, ``fig12.nc``.

    ``figure``: what to draw; ``data``: from ``figure.data``; ``folder``: where to; must exist.
    """
    write_bytes(folder / f"{figure.name}.nc", netcdf_content(data))
    save_png(figure.draw(data), folder / f"{figure.name}.png")


def save_claims(rows: list[Row], folder: Path) -> None:
    """Write the table and its counts, each as Markdown and as JSON."""
    found = summary.summarise(rows)
    write_text(folder / "claims.md", as_markdown(rows))
    write_text(folder / "counts.md", summary.as_markdown(found))
    for name, data in (("claims", as_json(rows)), ("counts", found)):
        text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
        write_text(folder / f"{name}.json", text + "\n")
