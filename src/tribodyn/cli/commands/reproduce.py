"""``tribodyn reproduce``: the figures of the source paper from our own runs, and its claims judged."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.interrupt import last_words
from tribodyn.cli.options import OutputDirectory
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.papers.cheng_2022.runs import PaperFigure, Runs

HELP = "make the figures of the source paper, and judge its claims"
EXAMPLE = "tribodyn reproduce fig9 claims"
CLAIMS: Final = "claims"
ENSEMBLE: Final = "ensemble"
ALL: Final = "all"
_PROCESSES: Final = 2  #: Members of the ensemble that are measured at once, at most.


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``reproduce``."""
    parser.add_argument(
        "what",
        nargs="*",
        metavar="WHAT",
        help="fig8 ... fig19, joints, undamped, claims or all (default: all); ensemble, alone: measure every "
        "claim on every member of the ensemble behind the verdicts, but those that the folder has",
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", default="results-reproduction", help="where files go"
    )
    parser.add_argument(
        "--formulation",
        metavar="NAME",
        default="paper",
        help="formulation that the figures show: paper (the default) or exact",
    )


def execute(args: Namespace) -> int:
    """Make the requested figures and tables."""
    from tribodyn.papers.cheng_2022.figures import FIGURES, FORMULATIONS, Runs

    wanted = _wanted(args.what or [ALL], list(FIGURES))
    if args.formulation not in FORMULATIONS:
        raise InputError(
            f"{as_given(args.formulation)}; allowed: {', '.join(FORMULATIONS)}", key="--formulation"
        )
    console = Console.of(args)
    directory = OutputDirectory(args.output)
    last_words(f"interrupted; what was finished until then is in {os.fspath(directory.path)}")
    with directory.reserved():
        runs = Runs(note=console.note)
        for name in wanted:
            if name == ENSEMBLE:
                _ensemble(directory.path, console)
            elif name == CLAIMS:
                _claims(runs, directory.path, console)
            else:
                _figure(FIGURES[name], runs, args.formulation, directory.path, console)
    console.say(f"everything is in {directory.path}/")
    return 0


def _wanted(given: list[str], figures: list[str]) -> list[str]:
    """Return the names to make, each once, in the order of the paper."""
    names = [*figures, CLAIMS]
    for name in given:
        if name not in (*names, ALL, ENSEMBLE):
            raise InputError(f"{as_given(name)}; allowed: {', '.join(names)}, {ALL}, {ENSEMBLE}", key="WHAT")
    if ENSEMBLE in given:
        return [ENSEMBLE]
    return names if ALL in given else [name for name in names if name in given]


def _figure(figure: PaperFigure, runs: Runs, formulation: str, folder: Path, console: Console) -> None:
    from tribodyn.papers.cheng_2022.figures import save_figure

    data = figure.data(runs, formulation)
    console.note(f"drawing {figure.name}: {figure.title}")
    save_figure(figure, data, folder)


def _ensemble(folder: Path, console: Console) -> None:
    from tribodyn.papers.cheng_2022.claims.measured import measure

    target = measure(folder, min(os.cpu_count() or 1, _PROCESSES), console.note)
    console.say(f"the ensemble is in {target}")


def _claims(runs: Runs, folder: Path, console: Console) -> None:
    from tribodyn.papers.cheng_2022 import claims
    from tribodyn.papers.cheng_2022.claims import summary
    from tribodyn.papers.cheng_2022.figures import save_claims

    console.note("measuring the claims of the paper")
    rows = claims.judge(runs, claims.CLAIMS)
    save_claims(rows, folder)
    console.say(claims.as_text(rows))
    console.say(summary.as_text(summary.summarise(rows)))
    if console.json:
        show_json(claims.as_json(rows))
