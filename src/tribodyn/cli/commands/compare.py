"""``tribodyn compare``: several stored results in one report."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import REPORT
from tribodyn.cli.tables import LEFT_OUT, grey
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, brief, on_one_line

if TYPE_CHECKING:
    from tribodyn.report import ComparedRun, RunDifferences

HELP = "several runs in one report: what differs, and their curves over each other"
EXAMPLE = "tribodyn compare results-slider-crank wide"


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
    from tribodyn.report import differences, write_comparison

    try:
        write_comparison(runs, target)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(
            f"{as_given(args.output)}: it cannot be written ({reason})", key="--output"
        ) from None
    console = Console.of(args)
    found = differences([run.dataset for run in runs])
    for line in _in_words([run.name for run in runs], found):
        console.say(line)
    console.say(f"look at {target}")
    if console.json:
        show_json({run.name: summary for run, summary in zip(runs, found.summaries, strict=True)})
    return 0


def _in_words(names: Sequence[str], found: RunDifferences) -> Iterator[str]:
    """Give a table of what differs in the cases, and of what came of it; grey where numbers are doubtful."""
    from tribodyn.results.summary import caution

    heads = [["", *names]]
    heads += [[brief(on_one_line(text)) for text in (row["path"], *row["values"])] for row in found.keys]
    rows = [_row(row) for group in found.groups if group["name"] not in LEFT_OUT for row in group["rows"]]
    widths = [max(map(len, column)) for column in zip(*heads, *rows, strict=True)]
    warnings = [summary["doubtful"] for summary in found.summaries]
    if found.stretch:
        yield found.stretch
    for table, marks in ((heads, [""] * len(names)), (rows, warnings)):
        for first, *others in table:
            cells = [f"{text:>{width}}" for text, width in zip(others, widths[1:], strict=True)]
            shown = (grey(cell, mark) for cell, mark in zip(cells, marks, strict=True))
            yield "  ".join([f"{first:<{widths[0]}}", *shown]).rstrip()
    yield from (
        caution(mark, f"the numbers of {name}") for name, mark in zip(names, warnings, strict=True) if mark
    )


def _row(row: Mapping[str, Any]) -> list[str]:
    """Return label and numbers of a row, each with its difference from the first."""
    cells = (
        f"{cell['value']}  ({cell['change']})" if cell["change"] else cell["value"] for cell in row["cells"]
    )
    return [f"{row['label']} {row['unit']}".rstrip(), *cells]


def _runs(directories: Sequence[str], target: Path) -> list[ComparedRun]:
    """Return the runs, named by their directories."""
    from tribodyn.mechanisms.results import read
    from tribodyn.report import ComparedRun

    for directory in directories:
        if not os.path.isdir(directory):
            raise InputError(
                f"{as_given(directory)}, not a directory; allowed: directories that `tribodyn run` wrote to",
                key="DIR",
            )
    return [
        ComparedRun(name, read(directory), _link(Path(directory), target))
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
