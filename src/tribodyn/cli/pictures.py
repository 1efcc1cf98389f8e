"""Figures and report of a stored result."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.cli.directory import FIGURES, REPORT

if TYPE_CHECKING:
    import xarray as xr


def draw(dataset: xr.Dataset, directory: Path) -> None:
    """Draw all figures and write the report of a result into its directory."""
    from tribodyn import figures, report

    figures.draw_all(dataset, directory / FIGURES)
    report.write(dataset, directory / REPORT)
