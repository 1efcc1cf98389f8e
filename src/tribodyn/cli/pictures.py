"""Figures and reports of stored results."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.directory import FIGURES, REPORT

if TYPE_CHECKING:
    import xarray as xr

FEW_POINTS: Final = 24
"""Points of a sweep up to which each gets its report without being asked: a second and 3 MB each."""


def draw(dataset: xr.Dataset, directory: Path) -> None:
    """Draw all figures and write the report of a result into its directory."""
    from tribodyn import report

    report.draw_all(dataset, directory / FIGURES)
    report.write(dataset, directory / REPORT)


def draw_points(directory: Path, note: Callable[[str], None]) -> None:
    """Write the report of every point of a sweep that has its whole result, without figures as files.

    Parameters
    ----------
    directory
        Of the sweep.
    note
        Prints a line.
    """
    from tribodyn import report
    from tribodyn.mechanisms.results import read
    from tribodyn.results.store import POINTS, RESULT

    found = sorted((directory / POINTS).glob(f"*/{RESULT}"))
    # A link could lead out of the folder of the sweep.
    results = [result for result in found if not result.parent.is_symlink()]
    note(f"writing the reports of {len(results)} points")
    for result in results:
        report.write(read(result), result.parent / REPORT)
