"""``tribodyn show``: print the whole resolved case as commented TOML."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from tribodyn.cli.choosing import add_case_arguments, chosen_case
from tribodyn.cli.console import show_json

HELP = "print a case with every key explained, as TOML: copy it, edit it, run it"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``show``."""
    add_case_arguments(parser)


def execute(args: Namespace) -> int:
    """Print the case."""
    case = chosen_case(args)
    if args.json:
        show_json(case.model_dump())
    else:
        print(case.to_toml(comments=True), end="")
    return 0
