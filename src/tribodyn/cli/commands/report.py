"""``tribodyn report``: draw figures and report again from stored results."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.cli.console import Console, complain, show_json
from tribodyn.cli.interrupt import last_words
from tribodyn.cli.options import REPORT, OutputDirectory
from tribodyn.cli.pictures import draw, draw_points
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    import xarray as xr

HELP = "build figures and the HTML report again from stored results"
EXAMPLE = "tribodyn report results-slider-crank"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``report``."""
    parser.add_argument(
        "directory", metavar="DIR", help="directory that `tribodyn run` or `tribodyn sweep` wrote to"
    )
    parser.add_argument("--points", action="store_true", help="of a sweep: the report of every point too")


def execute(args: Namespace) -> int:
    """Draw figures and report beside the stored result."""
    if not os.path.isdir(args.directory):
        raise InputError(
            f"{as_given(args.directory)}, not a directory; allowed: a directory that `tribodyn run` wrote to",
            key="DIR",
        )
    dataset = _read(Path(args.directory))
    directory = OutputDirectory(args.directory)
    console = Console.of(args)
    last_words(f"interrupted; what was finished until then is in {os.fspath(directory.path)}")
    with directory.reserved():
        if args.points:
            draw_points(directory.path, console.note)
        console.note("drawing figures and report")
        draw(dataset, directory.path)
        _mend(dataset, directory.path)
    console.say(f"look at {directory.path / REPORT}")
    if console.json:
        show_json(_outcome(dataset))
    return 0


def _outcome(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the key results of a run, or of each point of a sweep with the values varied (SI)."""
    from tribodyn.mechanisms.results import summarise
    from tribodyn.results.dataset import SWEEP

    if dataset.attrs.get("kind") != SWEEP:
        return summarise(dataset)
    points = dataset.to_dataframe().reset_index().astype(object)
    return {
        "title": dataset.attrs.get("title", ""),
        "points": points.where(points.notna(), None).to_dict("records"),
    }


def _mend(dataset: xr.Dataset, directory: Path) -> None:
    """Write again what follows from the result of a run and is missing or not true to it.

    A case file that is there stays as it is: somebody may have edited it on the way to the next run.
    """
    from tribodyn.mechanisms.results import summarise
    from tribodyn.results.store import CASE, RESULT, SUMMARY, case_text, summary_text, write_text

    if not (directory / RESULT).is_file():
        return
    if not (directory / CASE).exists():
        write_text(directory / CASE, case_text(dataset))
    summary, text = directory / SUMMARY, summary_text(summarise(dataset))
    if not _holds(summary, text):
        write_text(summary, text)
        complain(
            f"{os.fspath(summary)} was missing, damaged or of another result; it was written again "
            f"from {RESULT}"
        )


def _holds(path: Path, text: str) -> bool:
    """Tell whether a file holds this text and no other."""
    try:
        return read_regular(path, len(text.encode())) == text.encode()
    except OSError:
        return False


def _read(directory: Path) -> xr.Dataset:
    """Return the result of a run, or of a sweep, stored in a directory."""
    from tribodyn.mechanisms.results import read
    from tribodyn.results.store import RESULT
    from tribodyn.studies.sweep import DATASET

    sweep = directory / DATASET
    return read(sweep if sweep.is_file() and not (directory / RESULT).is_file() else directory)
