"""The report of a result beside it, whatever kind of result it is."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import xarray as xr

from tribodyn.mechanisms.results import all_there
from tribodyn.report.figures import figures_of
from tribodyn.report.page import render
from tribodyn.report.sweep import render_sweep
from tribodyn.results.dataset import SWEEP
from tribodyn.results.store import write_text

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
