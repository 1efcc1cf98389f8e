"""``tribodyn compare``: several stored results in one report."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.directory import REPORT
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.report import Run

HELP = "several runs in one report: what differs, and their curves over each other"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``compare``."""
    parser.add_argument(
        "directories", metavar="DIR", nargs="+", help="directories that `tribodyn run` wrote to, two or more"
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        default="comparison.html",
        help="page to write (default: %(default)s)",
    )


def execute(args: Namespace) -> int:
    """Write the page that compares the results."""
    if len(args.directories) < 2:
        raise InputError("given one directory; allowed: two or more", key="DIR")
    if Path(args.output).is_dir():
        raise InputError(f"{as_given(args.output)}, a directory; allowed: a file to write", key="--output")
    target = Path(args.output)
    runs = _runs(args.directories, target)
    from tribodyn.report import compared, write_comparison

    try:
        write_comparison(runs, target)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(
            f"{as_given(args.output)}: it cannot be written ({reason})", key="--output"
        ) from None
    console = Console.of(args)
    summaries, stretch = compared([run.dataset for run in runs])
    if stretch:
        console.say(stretch)
    console.say(f"look at {target}")
    if console.json:
        show_json({run.name: summary for run, summary in zip(runs, summaries, strict=True)})
    return 0


def _runs(directories: Sequence[str], target: Path) -> list[Run]:
    """Return the runs, named by their directories."""
    from tribodyn.mechanisms.results import read
    from tribodyn.report import Run

    for directory in directories:
        if not os.path.isdir(directory):
            raise InputError(
                f"{as_given(directory)}, not a directory; allowed: directories that `tribodyn run` wrote to",
                key="DIR",
            )
    return [
        Run(name, read(directory), _link(Path(directory), target))
        for name, directory in zip(_names(directories), directories, strict=True)
    ]


def _names(directories: Sequence[str]) -> list[str]:
    """Return short names of directories, all different."""
    last = [Path(os.path.abspath(directory)).name for directory in directories]
    names = last if len(set(last)) == len(last) else list(directories)
    return [name if names.index(name) == k else f"{name} ({k + 1})" for k, name in enumerate(names)]


def _link(directory: Path, target: Path) -> str:
    """Return the address of a run's own report as seen from the page, empty where there is none."""
    report = directory / REPORT
    if not report.is_file():
        return ""
    try:
        return quote(Path(os.path.relpath(report, target.parent)).as_posix())
    except ValueError:  # on another drive
        return report.resolve().as_uri()
