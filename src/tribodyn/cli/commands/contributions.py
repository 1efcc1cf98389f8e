"""``tribodyn contributions``: how much of the error of an output comes from which joint."""

from __future__ import annotations

import math
import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.options import FIGURES, add_study_arguments, chosen_case, kept_runs

if TYPE_CHECKING:
    from tribodyn.studies import OutputShares

HELP = "divide the error of each output among the joints with clearance"
EXAMPLE = "tribodyn contributions four-bar"
_NOTHING: Final = 1.0e-9  #: Error of a joint over that of all that is rounding.


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``contributions``."""
    add_study_arguments(parser, "contributions")
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="draw no figures")


def execute(args: Namespace) -> int:
    """Simulate each joint alone and all together, and print the shares."""
    from tribodyn.studies import contributions
    from tribodyn.studies.contributions import real_joints

    case, console = chosen_case(args), Console.of(args)
    real_joints(case)
    with kept_runs("contributions", args) as kept:
        found = contributions(case, **kept)
        if args.figures:
            _draw(found, case.title, kept["directory"] / FIGURES)
    for one in found:
        _tell(one, console)
    if args.figures:
        console.say(f"\nfigures are in {os.fspath(kept['directory'] / FIGURES)}{os.sep}")
    if console.json:
        show_json({one.output: _as_json(one) for one in found})
    return 0


def _draw(found: Iterable[OutputShares], title: str, folder: Path) -> None:
    """Draw the shares in the error of each output."""
    from tribodyn.figures.builds import Shares, draw_shares
    from tribodyn.figures.chart import save

    folder.mkdir(exist_ok=True)
    for one in found:
        words = f"Shares in the error of {one.output}, {one.together:.4g} {one.unit} root mean square"
        shares = Shares(words, title, one.joints, one.shares, one.interaction, one.estimate, one.causes)
        save(draw_shares(shares), folder, f"contributions_{one.output}")


def _tell(one: OutputShares, console: Console) -> None:
    """Print the shares of the joints in the error of an output, the largest first."""
    unit = one.unit
    known = math.isfinite(one.estimated)
    console.say(f"\nError of {one.output}, root mean square: {one.together:.4g} {unit}")
    if known:
        console.say(f"By superposition of smooth, rigid joints: {one.estimated:.4g} {unit}")
    heads = ("by superposition", *one.causes) if known else ()
    console.say(f"\n  {'joint':<24}{'alone':>12} {unit:<6}{'share':>10}" + "".join(f"{h:>18}" for h in heads))
    for k in (-one.shares).argsort():
        parts = (one.estimate[k].sum(), *one.estimate[k]) if known else ()
        alone = one.alone[k] if one.alone[k] > _NOTHING * one.together else 0.0
        row = f"  {one.joints[k]:<24}{alone:>12.4g} {unit:<6}{one.shares[k]:>10.1%}"
        console.say(row + "".join(f"{part:>18.1%}" for part in parts))
    console.say(f"  {'only together':<24}{'':>12} {'':<6}{one.interaction:>10.1%}")


def _as_json(one: OutputShares) -> dict[str, object]:
    return {
        "unit": one.unit,
        "together": one.together,
        "alone": dict(zip(one.joints, one.alone.tolist(), strict=True)),
        "shares": dict(zip(one.joints, one.shares.tolist(), strict=True)),
        "interaction": one.interaction,
        "superposition": {
            "together": one.estimated,
            "shares": {
                joint: dict(zip(one.causes, parts.tolist(), strict=True))
                for joint, parts in zip(one.joints, one.estimate, strict=True)
            },
        }
        if math.isfinite(one.estimated)
        else None,
    }
