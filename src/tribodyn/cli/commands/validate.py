"""``tribodyn validate``: comparison with measured data, each number with its uncertainty and a verdict."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import OutputDirectory, add_changes, changes, typed, without_quotes
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.validation.catalogue import ValidationSet

HELP = "compare with measured data: measured and computed values, uncertainties, verdicts"
EXAMPLE = "tribodyn validate oblique_impact -o out/validation"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``validate``."""
    parser.add_argument(
        "names",
        metavar="NAME",
        nargs="*",
        help="a validation set, or your own file of numbers (default: all sets)",
    )
    parser.add_argument("--against", metavar="CASE", help="the case that your own numbers belong to")
    parser.add_argument(
        "--assume",
        metavar="PATH=LOW..HIGH",
        action="append",
        default=[],
        help="range of an input of that case that is not known; may be repeated",
    )
    add_changes(parser)
    parser.add_argument(
        "--template", metavar="DIR", help="write README and table of a new set there, no more"
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="write a page and a plot of each set there, too"
    )


def execute(args: Namespace) -> int:
    """Run the sets and print every compared number."""
    from tribodyn.validation.report import Judged, as_json, as_text, save, summary

    console = Console.of(args)
    if args.template is not None:
        return _template(args.template, console)
    sets = _sets(args)
    directory = None if args.output is None else OutputDirectory(args.output)
    judged = []
    with nullcontext() if directory is None else directory.reserved():
        for one in sets:
            if one.missing:
                console.say(f"{one.missing}\n")
                continue
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


def _sets(args: Namespace) -> list[ValidationSet]:
    """Return the sets of the package, or the user's own."""
    from tribodyn.mechanisms.catalogue import load_case
    from tribodyn.studies.calibration import VariedKey
    from tribodyn.validation.catalogue import chosen
    from tribodyn.validation.rig import rig

    if args.against is None:
        if args.assume or changes(args):
            raise InputError("it belongs to --against CASE", key="--assume" if args.assume else "--set")
        if own := [name for name in args.names if name.lower().endswith(".csv")]:
            raise InputError(f"{as_given(own[0])} needs the case it belongs to: --against CASE", key="NAME")
        return list(chosen(args.names))
    if len(args.names) != 1:
        raise InputError("one file of numbers belongs to --against CASE", key="NAME")
    case = load_case(args.against, changes(args), source="--set")
    assumed = tuple(VariedKey.of(case, without_quotes(typed(text)), "--assume") for text in args.assume)
    return [rig(args.names[0], case, assumed)]


def _template(folder: str, console: Console) -> int:
    from tribodyn.validation.rig import write_template

    write_template(Path(folder))
    console.say(f"README.md and numbers.csv are in {folder}/")
    return 0
