"""``tribodyn allocate``: the cheapest tolerances that keep limits with a probability."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_study_arguments, chosen_case, kept_runs
from tribodyn.core.errors import InputError

if TYPE_CHECKING:
    from tribodyn.studies import Allocation

HELP = "find the cheapest tolerances with which limits are kept with a probability"
EXAMPLE = "tribodyn allocate slider-crank --limit error_rms_um_slider=25 --probability 0.99 --cost costs.toml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``allocate``."""
    add_study_arguments(parser, "allocate")
    parser.add_argument(
        "--limit",
        metavar="NAME=LIMIT",
        action="append",
        required=True,
        help="the most that a number of summary.json may be, in its unit, with >= the least; several must "
        "be kept together",
    )
    parser.add_argument(
        "--probability", metavar="P", type=float, required=True, help="of a machine that keeps them: 0.997"
    )
    parser.add_argument("--cost", metavar="FILE", required=True, help="TOML file of tolerances and costs")
    parser.add_argument(
        "--samples", metavar="N", type=int, default=500, help="runs that confirm it (default: %(default)s)"
    )


def execute(args: Namespace) -> int:
    """Find the cheapest choice, confirm it, and print it."""
    from tribodyn.studies import allocate
    from tribodyn.studies.allocation import CHOSEN

    if args.samples < 1:
        raise InputError(f"given {args.samples}; allowed: 1 or more", key="--samples")
    case, console = chosen_case(args), Console.of(args)
    with kept_runs("allocate", args) as kept:
        found = allocate(case, args.limit, args.probability, args.cost, samples=args.samples, **kept)
    _tell(found, args.probability, console)
    console.say(f"The case with these tolerances is {kept['directory'] / CHOSEN}")
    if console.json:
        show_json(_as_json(found))
    return 0


def _tell(found: Allocation, probability: float, console: Console) -> None:
    """Print the choice, the share of each tolerance, the fresh simulations and the cost over probability."""
    names = [one.name for one in found.limits]
    console.say(f"\n  {'tolerance':<24}{'chosen':>12}  " + "".join(f"{name:>32}" for name in names))
    for k, one in enumerate(found.tolerances):
        parts = "".join(f"{share:>32.1%}" for share in found.contributions[:, k])
        console.say(f"  {one.name:<24}{found.chosen.labels[k]:>12}  {parts}")
    sure = found.confirmed
    console.say(f"\nCost {found.chosen.cost:.6g}: {found.chosen.probability:.2%} keep the limits")
    console.say(
        f"Simulated anew: {sure.within} of {sure.points} do, that is {sure.low:.2%} to {sure.high:.2%} of "
        "all (95 % confidence)"
    )
    if sure.high < probability:
        console.note(f"these simulations contradict {probability:.2%}: ask for more, or give --samples")
    if all(width >= one.widest for one, width in zip(found.tolerances, found.chosen.widths, strict=True)):
        console.note("the widest tolerances do: these limits ask for none of the finer ones")
    console.say("\nLeast cost over probability:")
    for asked, choice in found.front:
        console.say(f"  {asked:>8.1%}{choice.cost:>12.6g}   {', '.join(choice.labels)}")
    console.say(f"({found.simulations} simulations)")


def _as_json(found: Allocation) -> dict[str, object]:
    names, sure = [one.name for one in found.tolerances], found.confirmed
    limits = [one.name for one in found.limits]
    return {
        "chosen": dict(zip(names, found.chosen.labels, strict=True)),
        "widths": dict(zip(names, found.chosen.widths, strict=True)),
        "cost": found.chosen.cost,
        "probability": found.chosen.probability,
        "confirmed": [sure.within, sure.points, sure.low, sure.high],
        "contributions": {
            limit: dict(zip(names, parts, strict=True))
            for limit, parts in zip(limits, found.contributions.tolist(), strict=True)
        },
        "front": [[asked, one.cost, dict(zip(names, one.labels, strict=True))] for asked, one in found.front],
        "missed": dict(zip(limits, found.missed.tolist(), strict=True)),
        "simulations": found.simulations,
    }
