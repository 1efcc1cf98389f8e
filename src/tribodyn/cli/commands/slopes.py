"""``tribodyn slopes``: how much key results change with keys of a case, where they have a slope."""

from __future__ import annotations

import math
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import add_study_arguments, chosen_case, kept_runs, typed, without_quotes

if TYPE_CHECKING:
    from tribodyn.studies import Slope

HELP = "change of key results with keys of a case, by differences over a ladder of steps"
EXAMPLE = "tribodyn slopes slider-crank --vary joints.wrist.clearance.radial --of error_rms_um_slider"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``slopes``."""
    add_study_arguments(parser, "slopes")
    parser.add_argument(
        "--vary",
        metavar="PATH[=STEP]",
        action="append",
        required=True,
        help="a key, and the longest step (default: 5 %% of its value); may be given again",
    )
    parser.add_argument(
        "--of",
        metavar="NAME",
        action="append",
        required=True,
        help="a number of summary.json; may be given again",
    )


def execute(args: Namespace) -> int:
    """Take the differences, and print them."""
    from tribodyn.studies import slopes

    case, console = chosen_case(args), Console.of(args)
    parts = [[without_quotes(part) for part in typed(text).partition("=")] for text in args.vary]
    keys = {path: step or None for path, _, step in parts}
    with kept_runs("slopes", args) as kept:
        found = slopes(case, keys, args.of, **kept)
    for number in dict.fromkeys(one.number for one in found):
        console.say(f"\n{number}, change for 1 % of the key:")
        for one in found:
            if one.number == number:
                console.say(_line(one))
    if console.json:
        show_json([_as_json(one) for one in found])
    return 0


def _line(one: Slope) -> str:
    if not one.steps:
        tried = ", ".join(f"{slope:.3g}" for slope in one.tried)
        return f"  {one.path:<40} no slope: steps give {tried} (SI units of the key)"
    percent = f"{one.relative:>+10.3g} %" if math.isfinite(one.relative) else f"{'':>12}"
    uncertain = f" ± {one.spread:.1g}" if one.spread else ""
    return f"  {one.path:<40}{percent}   {one.value:.4g}{uncertain} per SI unit, {len(one.steps)} steps agree"


def _as_json(one: Slope) -> dict[str, object]:
    return {
        "path": one.path,
        "number": one.number,
        "slope": one.value if one.steps else None,
        "spread": one.spread if one.steps else None,
        "relative": one.relative if math.isfinite(one.relative) else None,
        "steps": list(one.steps),
        "tried": one.tried.tolist(),
    }
