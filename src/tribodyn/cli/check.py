"""``tribodyn check``: validate a case file without running it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from tribodyn.cli.choosing import add_case_arguments, chosen_case
from tribodyn.cli.console import Console, show_json

HELP = "validate a case file without running it"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``check``."""
    add_case_arguments(parser)


def execute(args: Namespace) -> int:
    """Say that the case is valid; if not, loading it has raised, or its integrator is not installed."""
    from tribodyn.integrate import SOLVERS

    case = chosen_case(args)
    SOLVERS[str(case.at("solver.name"))].prepare()
    cycles = case.campaign_cycles
    length = f"{cycles} cycles of wear" if cycles else f"{case.duration:.6g} s"
    Console.of(args).say(f'{args.case}: valid, a "{case.kind()}" case of {length}')
    if args.json:
        show_json({"case": args.case, "valid": True})
    return 0
