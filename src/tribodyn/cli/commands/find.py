"""``tribodyn find``: the last value of a parameter at which a number keeps its limit."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_study_arguments, chosen_case, kept_runs, typed, where, without_quotes
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.studies.search import Search
    from tribodyn.studies.sweep import Arrival

HELP = "find the last value of a parameter at which a key result keeps a limit"
EXAMPLE = (
    "tribodyn find slider-crank --vary joints.wrist.clearance.radial=10..60um --until error_rms_um_slider=20"
)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``find``."""
    add_study_arguments(parser, "find", workers=0)
    parser.add_argument(
        "--vary", metavar="PATH=A..B", required=True, help='the range to search: joint.clearance="10..60 um"'
    )
    parser.add_argument(
        "--until",
        metavar="NAME=LIMIT",
        required=True,
        help="the most that a number of summary.json may be, in its unit: vane_angle_error_max_deg=0.03; "
        "with >= the least; error_rms_um_tip=-20%% is a change against the case as it is",
    )
    parser.add_argument(
        "--within",
        metavar="PERCENT",
        type=float,
        default=1.0,
        help="how near, as a share of the range (default: %(default)s)",
    )


def execute(args: Namespace) -> int:
    """Search, and say what was found."""
    from tribodyn.studies import Means
    from tribodyn.studies.search import Search, limit, question

    if not 0.0 < args.within < 100.0:
        raise InputError(f"given {args.within:g}; allowed: above 0 and below 100", key="--within")
    case, console = chosen_case(args), Console.of(args)
    path, equals, values = (without_quotes(part) for part in typed(args.vary).partition("="))
    if not equals:
        raise InputError(
            f"{as_given(args.vary)}; allowed: PATH=A..B, such as joint.clearance=10..60um", key="--vary"
        )
    until = limit(args.until, case, "--until")
    if until.others:
        console.note(f"{until.name} is taken; {', '.join(until.others)} would match, too")
    asked = question(case, path, values, until)

    def arrived(arrival: Arrival) -> None:
        if arrival.point is not None:
            console.note(f"tried {arrival.point.label}")

    with kept_runs("find", args) as kept:
        watcher = replace(kept["watcher"], arrived=arrived)
        search = Search(asked, kept["directory"], Means(**where(args), keep_results=False), watcher)
        root = search.root(args.within / 100.0)
        search.dataset()
    _tell(search, root, console)
    return 0


def _tell(search: Search, root: float, console: Console) -> None:
    """Print the tried values and the answer."""
    from tribodyn.cases.keys import VALUE
    from tribodyn.results.summary import wear_interval
    from tribodyn.studies.variation import written

    asked, limit = search.question, search.limit
    unit = asked.key_result.unit
    for value in sorted(search.tried):
        console.say(f"  {written(asked.key, value):<16}{search.tried[value]:>12.4g} {unit}")
    low, high = (written(asked.key, end) for end in search.bracket())
    label, path = asked.key_result.label, asked.key.path.removesuffix(f".{VALUE}")
    reached = f"{search.tried[root]:.4g} {unit}".rstrip()
    console.say(
        f"\n{label}: {limit.sign} {limit.value:.6g} {unit}".rstrip()
        + f" at {path} = {written(asked.key, root)}, where it is {reached}"
    )
    ends = wear_interval(limit.name, asked.key_result.part, asked.case.wear_scatter())
    if ends is not None:
        low_end, high_end = (f"{end * search.tried[root]:.2g}" for end in ends)
        console.say(f"(at the nominal wear rate; of equal parts {low_end} to {high_end} {unit})")
    console.say(
        f"(the limit lies between {low} and {high}; {len(search.tried)} runs, kept in "
        f"{os.fspath(search.directory)}{os.sep})"
    )
    if console.json:
        show_json(
            {
                "path": asked.key.path,
                "value": written(asked.key, root),
                "between": [low, high],
                "number": limit.name,
                "limit": limit.value,
                "reached": search.tried[root],
                "interval": None if ends is None else [end * search.tried[root] for end in ends],
                "tried": {
                    written(asked.key, value): number for value, number in sorted(search.tried.items())
                },
            }
        )
