"""``tribodyn bounce``: the restitution that contact laws and damping factors really give."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_case_arguments, chosen_case
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant

if TYPE_CHECKING:
    from tribodyn.cases.case import Case
    from tribodyn.mechanisms.bushing import Bearing

HELP = "drop the shaft on every contact law and damping factor, and show which restitution comes out"
EXAMPLE = "tribodyn bounce slider-crank --law rsdc"
_COLUMNS = ("wanted", "point", "plate", "shaft")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``bounce``."""
    add_case_arguments(parser)
    parser.add_argument(
        "--law",
        metavar="NAME",
        action="append",
        help="a contact law to show; all without it; may be repeated",
    )
    parser.add_argument(
        "--joint", metavar="NAME", help="a joint of the case whose shaft is dropped (default: the first one)"
    )


def execute(args: Namespace) -> int:
    """Print one line for each law and factor."""
    bearing = _chosen(chosen_case(args), args.joint)
    from tribodyn.contact import LAWS
    from tribodyn.simulation.bounce import bounces

    names = args.law or list(LAWS)
    unknown = [name for name in names if name not in LAWS]
    if unknown:
        hint = meant(unknown[0], LAWS)
        raise InputError(f"{as_given(unknown[0])}; allowed: {', '.join(LAWS)}{hint}", key="--law")
    console = Console.of(args)
    console.note("Restitution wanted, and realised by a point, a plate and a shaft on these surfaces.")
    console.say(f"{'law':<8}{'damping factor':<22}" + "".join(f"{name:>9}" for name in _COLUMNS))
    rows = []
    for row in bounces(bearing, names):
        rows.append(asdict(row))
        numbers = "".join(f"{rows[-1][name]:>9.4f}" for name in _COLUMNS)
        console.say(f"{row.law:<8}{row.factor:<22}{numbers}")
    if args.json:
        show_json(rows)
    return 0


def _chosen(case: Case, name: str | None) -> Bearing:
    """Return the joint of a case with this name, or the first one, that is a shaft in a bore."""
    from tribodyn.mechanisms.catalogue import MECHANISMS

    found = MECHANISMS[case.kind()].bearings_of(case)
    if not found:
        reason = (
            "no joint of this case is a shaft in a bore with clearance; one is needed, as in slider-crank"
        )
        raise InputError(reason, key="CASE")
    chosen = next(iter(found)) if name is None else name
    if chosen not in found:
        raise InputError(
            f"{as_given(chosen)}; allowed: {', '.join(found)}{meant(chosen, found)}", key="--joint"
        )
    return found[chosen]
