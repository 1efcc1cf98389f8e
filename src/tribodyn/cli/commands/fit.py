"""``tribodyn fit``: keys of a case fitted to measured data, with intervals and what the data determine."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.interrupt import last_words
from tribodyn.cli.options import OutputDirectory, add_case_arguments, chosen_case, typed, without_quotes
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.cases.case import Case
    from tribodyn.studies.calibration import Calibration
    from tribodyn.studies.fit_report import FittedKey
    from tribodyn.studies.measured import Experiment

HELP = "fit keys of a case to measured data: values, intervals, and what the data determine"
EXAMPLE = "tribodyn fit slider-crank --data run.csv --vary joints.wrist.clearance.radial=10..60um"
_WITH: Final = " with "
_BETWEEN: Final = re.compile(r",(?=\s*[A-Za-z_][\w.-]*\s*=)")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``fit``."""
    add_case_arguments(parser)
    parser.add_argument(
        "--data",
        metavar="FILE[ with PATH=VALUE,...]",
        action="append",
        required=True,
        help="CSV: time and variables of a result, or quantity, value; several runs are fitted at once, "
        'each with its own settings: --data "slow.csv with drives.motor.speed=500rpm"',
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
        "--posterior",
        metavar="STEPS",
        type=int,
        help="sample the posterior distribution, too, with this many steps (needs tribodyn[posterior])",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        help="where files go; an interrupted fit goes on there (default: fit-CASE)",
    )


def execute(args: Namespace) -> int:
    """Fit, write the files and print the fitted keys."""
    import numpy as np

    from tribodyn.results.store import write_text
    from tribodyn.studies import posterior
    from tribodyn.studies.calibration import Calibration, VariedKey
    from tribodyn.studies.fit_report import as_json, fitted_keys, save, statements

    _check(args)
    case, console = chosen_case(args), Console.of(args)
    asked = [part for text in args.vary for part in _BETWEEN.split(typed(text))]
    keys = [VariedKey.of(case, without_quotes(text)) for text in asked]
    directory = OutputDirectory(f"fit-{Path(args.case).stem}" if args.output is None else args.output)
    last_words(
        f"interrupted; finished runs are kept in {directory.path}, from which the same command goes on"
    )
    with directory.reserved():
        experiments = [_experiment(case, typed(text)) for text in args.data]
        noise = np.concatenate([one.data.noise(0.01 * args.noise) for one in experiments])
        fit = Calibration(case, keys, experiments, noise, directory.path, console.note)
        found = fit.fitted(args.starts)
        profiles = None if args.no_profiles else [fit.profile(found, k) for k in range(len(keys))]
        samples = None if args.posterior is None else posterior.sample(fit, found, args.posterior)
        words = statements(fit, found) + ([] if samples is None else samples.statements) + fit.remarks()
        fitted = fitted_keys(fit, found, profiles, samples)
        save(fit, found, fitted, words, directory.path)
        if samples is not None:
            write_text(directory.path / posterior.SAMPLES, samples.table())
    _tell(fit, fitted, words, console)
    console.say(f"fitted.toml, fit.md and residuals.csv are in {directory.path}/")
    if args.json:
        show_json(as_json(fit, found, fitted, words))
    return 0


def _experiment(case: Case, text: str) -> Experiment:
    """Return the data that ``FILE with PATH=VALUE,...`` names, outside the impacts of their run."""
    from tribodyn.simulation import simulate
    from tribodyn.studies import measured

    file, _, given = text.partition(_WITH)
    settings = dict(_setting(one) for one in _BETWEEN.split(given)) if given.strip() else {}
    run = simulate(case.replace(settings))
    return measured.Experiment(Path(file).name, settings, measured.read(file, run).outside_impacts(run))


def _setting(text: str) -> tuple[str, object]:
    path, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not value:
        raise InputError(f"{as_given(text)}; allowed: FILE with PATH=VALUE,...", key="--data")
    return path, value


def _check(args: Namespace) -> None:
    from tribodyn.studies.posterior import LEAST_STEPS, sampler_package

    if args.posterior is not None:
        sampler_package()
        if args.posterior < LEAST_STEPS:
            raise InputError(f"given {args.posterior}; allowed: {LEAST_STEPS} or more", key="--posterior")
    if not 0.0 < args.noise < 100.0:
        raise InputError(f"{as_given(str(args.noise))}; allowed: above 0 and below 100", key="--noise")
    if args.starts < 1:
        raise InputError(f"given {args.starts}; allowed: 1 or more", key="--starts")


def _tell(fit: Calibration, keys: list[FittedKey], words: list[str], console: Console) -> None:
    from tribodyn.studies.fit_report import interval_text

    for k, key in enumerate(keys):
        interval = interval_text(fit, k, key.posterior or key.profile or key.interval)
        console.say(f"  {key.words}    95 %: {interval}")
    for sentence in words:
        console.say(sentence)
