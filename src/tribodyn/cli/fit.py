"""``tribodyn fit``: keys of a case fitted to measured data, with intervals and what the data determine."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.choosing import add_case_arguments, chosen_case, typed, without_quotes
from tribodyn.cli.console import Console, show_json
from tribodyn.cli.directory import OutputDirectory
from tribodyn.cli.interrupt import last_words
from tribodyn.cli.progress import announced_compilation
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.studies.calibration import Calibration
    from tribodyn.studies.fit_report import FittedKey

HELP = "fit keys of a case to measured data: values, intervals, and what the data determine"
_BETWEEN: Final = re.compile(r",(?=\s*[A-Za-z_][\w.-]*\s*=)")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``fit``."""
    add_case_arguments(parser)
    parser.add_argument(
        "--data",
        metavar="FILE",
        required=True,
        help="CSV: time and variables of a result, or quantity, value",
    )
    parser.add_argument(
        "--vary",
        metavar="PATH=LOW..HIGH[,...]",
        action="append",
        required=True,
        help='keys to fit with their ranges: joint.clearance="10..60 um"; may be repeated',
    )
    parser.add_argument(
        "--noise",
        metavar="PERCENT",
        type=float,
        default=1.0,
        help="noise of curves over their range, and of numbers without half width (default: %(default)s)",
    )
    parser.add_argument(
        "--starts", metavar="N", type=int, default=2, help="starts of the fit (default: %(default)s)"
    )
    parser.add_argument(
        "--no-profiles", action="store_true", help="leave out profile intervals, which take longest"
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        help="where files go; an interrupted fit goes on there (default: fit-CASE)",
    )


def execute(args: Namespace) -> int:
    """Fit, write the files and print the fitted keys."""
    from tribodyn.simulation import simulate
    from tribodyn.studies import measured
    from tribodyn.studies.calibration import Calibration, VariedKey
    from tribodyn.studies.fit_report import as_json, fitted_keys, save
    from tribodyn.studies.identifiability import statements

    _check(args)
    case, console = chosen_case(args), Console.of(args)
    asked = [part for text in args.vary for part in _BETWEEN.split(typed(text))]
    keys = [VariedKey.of(case, without_quotes(text)) for text in asked]
    directory = OutputDirectory(f"fit-{Path(args.case).stem}" if args.output is None else args.output)
    last_words(
        f"interrupted; finished runs are kept in {directory.path}, from which the same command goes on"
    )
    with directory.reserved(), announced_compilation(console.note):
        run = simulate(case)
        data = measured.read(args.data, run).outside_impacts(run)
        fit = Calibration(case, keys, data, data.noise(0.01 * args.noise), directory.path, console.note)
        found = fit.fitted(args.starts)
        profiles = None if args.no_profiles else [fit.profile(found, k) for k in range(len(keys))]
        words, fitted = statements(fit, found), fitted_keys(fit, found, profiles)
        save(fit, found, fitted, words, Path(args.data).name, directory.path)
    _tell(fit, fitted, words, console)
    console.say(f"fitted.toml, fit.md and residuals.csv are in {directory.path}/")
    if args.json:
        show_json(as_json(fit, found, fitted, words, Path(args.data).name))
    return 0


def _check(args: Namespace) -> None:
    if not 0.0 < args.noise < 100.0:
        raise InputError(f"given {as_given(str(args.noise))}; allowed: above 0 and below 100", key="--noise")
    if args.starts < 1:
        raise InputError(f"given {args.starts}; allowed: 1 or more", key="--starts")


def _tell(fit: Calibration, keys: list[FittedKey], words: list[str], console: Console) -> None:
    from tribodyn.studies.fit_report import interval_text

    for k, key in enumerate(keys):
        interval = interval_text(fit, k, key.profile or key.interval)
        console.say(f"  {key.words}    95 %: {interval}")
    for sentence in words:
        console.say(sentence)
