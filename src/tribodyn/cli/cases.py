"""``tribodyn cases``: list the built-in cases."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from tribodyn.cli.console import show_json

HELP = "list the built-in cases"


def add_arguments(parser: ArgumentParser) -> None:
    """``cases`` takes no arguments."""


def execute(args: Namespace) -> int:
    """Print one line for each case."""
    from tribodyn.cases import CASES

    if args.json:
        show_json({name: entry.summary for name, entry in CASES.items()})
        return 0
    width = max(len(name) for name in CASES)
    for name, entry in CASES.items():
        print(f"{name:<{width}}  {entry.summary}")
    return 0
