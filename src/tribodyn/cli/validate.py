"""``tribodyn validate``: comparison with measured data, each number with its uncertainty and a verdict."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from contextlib import AbstractContextManager, nullcontext

from tribodyn.cli.compiling import announced_compilation
from tribodyn.cli.console import Console, show_json
from tribodyn.cli.directory import OutputDirectory

HELP = "compare with measured data: measured and computed values, uncertainties, verdicts"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``validate``."""
    parser.add_argument("names", metavar="NAME", nargs="*", help="a validation set (default: all sets)")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="write a page and a plot of each set there, too"
    )


def execute(args: Namespace) -> int:
    """Run the sets and print every compared number."""
    from tribodyn.validation.catalogue import chosen
    from tribodyn.validation.report import Judged, as_json, as_text, summary
    from tribodyn.validation.save import save

    console, sets = Console.of(args), list(chosen(args.names))
    directory = None if args.output is None else OutputDirectory(args.output)
    judged = []
    with announced_compilation(console.note), _reserved(directory):
        for one in sets:
            console.note(f"computing {one.name}")
            judged.append(Judged(one, one.run()))
            console.say(as_text(judged[-1]) + "\n")
        if directory is not None:
            save(judged, directory.path)
    console.say(summary(judged))
    if directory is not None:
        console.say(f"pages, plots and validation.json are in {directory.path}/")
    if args.json:
        show_json([as_json(one) for one in judged])
    return 0


def _reserved(directory: OutputDirectory | None) -> AbstractContextManager[None]:
    return nullcontext() if directory is None else directory.reserved()
