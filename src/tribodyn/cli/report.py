"""``tribodyn report``: draw figures and report again from stored results."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.directory import REPORT, OutputDirectory
from tribodyn.cli.pictures import draw
from tribodyn.core.errors import InputError

HELP = "build figures and the HTML report again from stored results"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``report``."""
    parser.add_argument("directory", metavar="DIR", help="directory that `tribodyn run` wrote to")


def execute(args: Namespace) -> int:
    """Draw figures and report beside the stored result."""
    from tribodyn.results.store import read
    from tribodyn.results.summary import summarise

    if not os.path.isdir(args.directory):
        raise InputError(
            f'given "{args.directory}", not a directory; allowed: a directory that `tribodyn run` wrote to',
            key="DIR",
        )
    dataset = read(args.directory)
    directory = OutputDirectory(args.directory)
    console = Console.of(args)
    console.note("drawing figures and report")
    draw(dataset, directory.path)
    console.say(f"look at {directory.path / REPORT}")
    if console.json:
        show_json(summarise(dataset))
    return 0
