"""``tribodyn cases``: list the built-in cases."""

from argparse import ArgumentParser, Namespace

from tribodyn.cli.console import show_json

HELP = "list the built-in cases"
EXAMPLE = "tribodyn cases"


def add_arguments(parser: ArgumentParser) -> None:
    """``cases`` takes no arguments."""


def execute(args: Namespace) -> int:
    """Print one line for each case."""
    from tribodyn.mechanisms.catalogue import built_in

    if args.json:
        show_json({name: entry.summary for name, entry in built_in().items()})
        return 0
    width = max(len(name) for name in built_in())
    for name, entry in built_in().items():
        print(f"{name:<{width}}  {entry.summary}")
    return 0
