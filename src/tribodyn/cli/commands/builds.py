"""``tribodyn builds``: numbers of very many builds of a machine whose copies scatter."""

from __future__ import annotations

import math
import os
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import (
    FIGURES,
    add_study_arguments,
    changes,
    chosen_case,
    kept_runs,
    typed,
    without_quotes,
)
from tribodyn.core import fork_server
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from pathlib import Path

    from tribodyn.studies import Builds

HELP = "draw very many builds of a machine whose copies scatter, from copies simulated alone"
_ARRAYS = ("quantiles", "low", "high", "together", "same")
EXAMPLE = "tribodyn builds ring.toml --copies 400 --draws 100000 --limit copies_spread_max_deg=0.1"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``builds``."""
    add_study_arguments(parser, "builds")
    for option, default, words in (
        ("--copies", 4000, "copies that are simulated alone"),
        ("--draws", 1_000_000, "builds that are drawn from them"),
        ("--coupled", 0, "builds that are simulated as a whole, to see what that leaves out"),
        ("--seed", 0, "equal seeds give equal builds"),
    ):
        parser.add_argument(
            option, metavar="N", type=int, default=default, help=f"{words} (default: %(default)s)"
        )
    parser.add_argument(
        "--limit",
        dest="limits",
        metavar="NAME=LIMIT",
        action="append",
        default=[],
        help="the most that a number of a build may be; the share beyond it is printed; may be repeated",
    )
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="draw no figures")


def execute(args: Namespace) -> int:
    """Simulate copies, draw builds, and print their numbers."""
    if args.workers != 0 and args.scheduler is None:
        # It imports and loads while this process does, and simulates equal copies.
        fork_server.start(name=args.case, changes=changes(args))
    from tribodyn.studies import builds

    for option, least in (("copies", 2), ("draws", 100), ("coupled", 0), ("seed", 0)):
        if getattr(args, option) < least:
            raise InputError(f"given {getattr(args, option)}; allowed: {least} or more", key=f"--{option}")
    case, console = chosen_case(args), Console.of(args)
    with kept_runs("builds", args) as kept:
        found = builds(
            case,
            copies=args.copies,
            draws=args.draws,
            coupled=args.coupled,
            limits=dict(map(_limit, args.limits)),
            seed=args.seed,
            **kept,
        )
        if args.figures:
            _draw(found, case.title, kept["directory"] / FIGURES)
    _tell(found, console)
    if args.figures:
        console.say(f"\nfigures are in {os.fspath(kept['directory'] / FIGURES)}{os.sep}")
    if console.json:
        show_json(_as_json(found))
    return 0


def _limit(text: str) -> tuple[str, float]:
    name, _, number = (without_quotes(part) for part in typed(text).partition("="))
    try:
        value = float(number)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(
            f"{as_given(text)}; allowed: NAME=NUMBER, such as copies_spread_max_deg=0.1", key="--limit"
        )
    return name, value


def _draw(found: Builds, title: str, folder: Path) -> None:
    """Draw the distribution of each number."""
    from tribodyn.figures.builds import draw
    from tribodyn.figures.chart import save

    folder.mkdir(exist_ok=True)
    numbers = [(one.label, one.quantiles, one.drawn, one.together) for one in found.numbers]
    save(draw(numbers, title), folder, "builds")


def _tell(found: Builds, console: Console) -> None:
    """Print quantiles, what coupled builds say of them, shares beyond limits and contributions."""
    from tribodyn.studies.builds import LEVELS

    console.say(f"\n{found.draws} builds of {found.of_build} copies, from {found.copies} copies alone")
    heads = "".join(f"{f'{100 * level:g} %':>26}" for level in LEVELS)
    console.say(f"\n  {'number':<26}{'mean':>10}{heads}   (95 % confidence)")
    for one in found.numbers:
        cells = (
            f"{value:>11.4g} ({low:.4g}..{high:.4g})"
            for value, low, high in zip(one.quantiles, one.low, one.high, strict=True)
        )
        console.say(f"  {one.name:<26}{one.mean:>10.4g}" + "".join(f"{cell:>26}" for cell in cells))
    if found.numbers[0].together.size:
        console.say(
            f"\n{found.numbers[0].together.size} builds as a whole, over those of the same copies alone:"
        )
        for one in found.numbers:
            ratio, line = one.together.mean() / one.same.mean() - 1.0, one.correlation
            expected = "".join(f"{value:>10.4g}" for value in one.coupled)
            console.say(
                f"  {one.name:<26}{ratio:>+8.1%}, correlation {line:.3f}; quantiles to expect{expected}"
            )
    for name, (share, low, high) in found.beyond.items():
        console.say(f"\n{share:.3%} of builds are beyond the limit of {name} ({low:.3%} to {high:.3%})")
    console.say("\nShare of the variance of errors that each causes alone:")
    for name, part in sorted(found.contributions.items(), key=lambda item: -item[1]):
        console.say(f"  {name:<26}{part:>10.1%}")


def _as_json(found: Builds) -> dict[str, object]:
    from tribodyn.studies.builds import LEVELS

    return {
        "copies": found.copies,
        "of_build": found.of_build,
        "draws": found.draws,
        "levels": list(LEVELS),
        "numbers": {
            one.name: {
                **{name: getattr(one, name) for name in ("label", "mean", "deviation")},
                **{name: getattr(one, name).tolist() for name in _ARRAYS},
                "coupled": one.coupled.tolist() if one.together.size > 2 else None,
            }
            for one in found.numbers
        },
        "beyond": {name: list(share) for name, share in found.beyond.items()},
        "contributions": dict(found.contributions),
    }
