"""``tribodyn check``: find out what a run would refuse, without running it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_case_arguments, chosen_case

if TYPE_CHECKING:
    from tribodyn.cases import Case
    from tribodyn.simulation.costs import Estimate

HELP = "validate a case file without running it"
EXAMPLE = "tribodyn check slider-crank --deep"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``check``."""
    add_case_arguments(parser)
    parser.add_argument(
        "--deep", action="store_true", help="also find the start of the run and take its first step"
    )


def execute(args: Namespace) -> int:
    """Say that the case is valid; if not, something has raised."""
    from tribodyn.integrate import SOLVERS

    console = Console.of(args)
    case = chosen_case(args)
    SOLVERS[str(case.at("solver.name"))].prepare()
    remarks, taken = _try(case, args.deep)
    cycles = case.campaign_cycles
    length = f"{cycles} cycles of wear" if cycles else f"{case.duration:.6g} s"
    tried = "; its start was found and the first step taken" if args.deep else ""
    console.say(f'{args.case}: valid, a "{case.kind()}" case of {length}{tried}')
    console.say(f"estimated: {taken}")
    for remark in remarks:
        console.say(remark)
    if args.json:
        estimate = {"memory_bytes": round(taken.memory), "processor_time_s": round(taken.seconds, 3)}
        show_json({"case": args.case, "valid": True, "estimate": estimate, "remarks": list(remarks)})
    return 0


def _try(case: Case, deep: bool) -> tuple[Sequence[str], Estimate]:
    from tribodyn.simulation import check, estimate

    return check(case, deep=deep), estimate(case)
