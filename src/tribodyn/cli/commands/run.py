"""``tribodyn run``: simulate a case, save the result, draw it, say what came out."""

from __future__ import annotations

import os
import sys
import traceback
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.cli.console import CYCLES, Console, Progress, complain, progress, show_json, stage
from tribodyn.cli.interrupt import Interruption, last_words
from tribodyn.cli.options import REPORT, RESULT, OutputDirectory, add_case_arguments, chosen_case
from tribodyn.cli.pictures import add_arguments as add_drawing_arguments
from tribodyn.cli.pictures import draw
from tribodyn.cli.tables import in_words
from tribodyn.core.errors import InputError
from tribodyn.core.platforms import memory
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases import Case

HELP = "simulate a case; results, figures and a report go to a directory"
EXAMPLE = "tribodyn run slider-crank --set joints.wrist.clearance.radial='25 um' -o wide"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``run``."""
    add_case_arguments(parser)
    add_drawing_arguments(parser)
    parser.add_argument("-o", "--output", metavar="DIR", help="where results go (default: results-CASE)")
    parser.add_argument("--verify", metavar="HASH", help="fail unless this is the SHA-256 of the rows")
    parser.add_argument(
        "--force",
        action="store_true",
        help="compute a finished campaign again, and overwrite the finished result of another case",
    )


def execute(args: Namespace) -> int:
    """Run the case; 0 when it came to its end and everything is written, else 1."""
    console = Console.of(args)
    with stage("reading the case"):
        case = chosen_case(args)
    folder = _name(args) if args.output is None else args.output
    if not args.force:
        _spare(folder, case)
    directory = OutputDirectory(folder)
    with directory.reserved():
        if not args.force and _is_finished_campaign(case, directory.path):
            dataset, summary = _kept(directory, console)
        else:
            dataset, summary = _computed(case, directory, console)
        _tell(summary, console)
        with stage("drawing"):
            drawn = _draw(dataset, directory, console, args)
    _say_where(directory.path, console)
    failure = str(dataset.attrs.get("failure", ""))
    if failure:
        complain(_stopped(dataset, case, failure, directory.path))
    return 0 if drawn and not failure and _is_verified(summary, args.verify, console) else 1


def _is_verified(summary: dict[str, Any], wanted: str | None, console: Console) -> bool:
    """Compare the hash of the rows with the wanted one, if there is one; report what was found."""
    if wanted is None:
        return True
    from tribodyn.results.dataset import ROWS_HASH

    found = summary.get(ROWS_HASH, "that of no rows: nothing was integrated")
    if wanted.strip().lower() == found:
        console.say(f"verified: the SHA-256 of the rows is {found}")
        return True
    complain(
        f"not verified: the SHA-256 of the rows is {found}, not {wanted}; the manual's page on equal numbers "
        "lists what changes it"
    )
    return False


def _is_finished_campaign(case: Case, path: Path) -> bool:
    from tribodyn.results.store import holds_run

    return bool(case.campaign_cycles) and holds_run(path, case.to_toml())


def _kept(directory: OutputDirectory, console: Console) -> tuple[xr.Dataset, dict[str, Any]]:
    """Return the finished campaign of a directory, and its summary."""
    from tribodyn.mechanisms.results import read, summarise

    path = os.fspath(directory.path)
    console.note(f"this wear campaign is finished and kept in {path}; --force computes it again")
    dataset = read(directory.path)
    return dataset, summarise(dataset)


def _computed(case: Case, directory: OutputDirectory, console: Console) -> tuple[xr.Dataset, dict[str, Any]]:
    """Simulate and save; return the result and its summary."""
    with Interruption() as stop:
        with stage("simulating"):
            dataset = _simulate(case, directory, console, stop)
        last_words(f"aborted while saving; what stands in {os.fspath(directory.path)} is whole")
        with stage("saving"):
            summary = _save(dataset, directory)
        if case.campaign_cycles and not dataset.attrs.get("failure"):
            directory.checkpoint.unlink(missing_ok=True)
    return dataset, summary


def _name(args: Namespace) -> str:
    """Return the default directory: named after case and analysis, in the current directory."""
    analysis = "" if args.analysis is None else f"-{args.analysis}"
    return f"results-{Path(args.case).stem}{analysis}"


def _spare(folder: str, case: Case) -> None:
    """Refuse a folder that holds the finished result of another case; the same one can be made again."""
    if not os.path.exists(os.path.join(folder, RESULT)):
        return
    from tribodyn.results.store import finished_case

    if finished_case(folder) not in (None, case.to_toml()):
        raise InputError(
            f"{as_given(folder)}: the finished result of another case is there; allowed: another directory, "
            "or --force to overwrite it",
            key="--output",
        )


def _simulate(case: Case, directory: OutputDirectory, console: Console, stop: Interruption) -> xr.Dataset:
    console.note(f"running {case.title}")
    if case.campaign_cycles and directory.checkpoint.exists():
        console.note(f"going on with the wear campaign kept in {os.fspath(directory.checkpoint)}")
    from tribodyn.simulation import estimate, simulate

    expected = estimate(case)
    expected.require_memory(memory())
    for warning in expected.warnings:
        complain(f"warning: {warning}")
    with _progress(case, console) as shown:
        return simulate(case, progress=shown, stop=stop, checkpoint=directory.checkpoint)


def _progress(case: Case, console: Console) -> Progress:
    """Return the display of progress: simulated time, or the cycles of a wear campaign."""
    if case.campaign_cycles:
        return progress(case.campaign_cycles, console, CYCLES)
    return progress(case.duration, console)


def _save(dataset: xr.Dataset, directory: OutputDirectory) -> dict[str, Any]:
    from tribodyn.mechanisms.results import summarise
    from tribodyn.results.store import write_run

    summary = summarise(dataset)
    write_run(dataset, directory.path, summary, stale=directory.pictures())
    return summary


def _draw(dataset: xr.Dataset, directory: OutputDirectory, console: Console, args: Namespace) -> bool:
    """Draw figures and report; the result is safe whatever happens here. Tell whether all were drawn."""
    path = os.fspath(directory.path)
    safe = f"the result is saved in {path}; `tribodyn report {path}` draws them"
    last_words(f"interrupted while drawing figures and report; {safe}")
    if args.figures or args.page:
        console.note("drawing figures and report")
    try:
        draw(dataset, directory.path, figures=args.figures, page=args.page)
    except Exception as error:
        if args.debug:
            traceback.print_exc()
        for picture in directory.pictures():
            picture.unlink(missing_ok=True)
        complain(f"figures and report could not be made ({error}); {safe}")
        return False
    last_words(f"interrupted; everything is in {path}")
    return True


def _tell(summary: dict[str, Any], console: Console) -> None:
    """Print the key results, notes and warnings."""
    for line in ("", str(summary.get("title", "")), *in_words(summary), ""):
        console.say(line)
    for note in summary["notes"]:
        console.say(f"note: {note}")
    for warning in summary["warnings"]:
        complain(f"warning: {warning}")
    if console.json:
        show_json(summary)
    sys.stdout.flush()


def _say_where(path: Path, console: Console) -> None:
    """Print the places of the results."""
    report = path / REPORT
    console.say(f"look at {report if report.exists() else path / RESULT}; everything is in {path}{os.sep}")


def _stopped(dataset: xr.Dataset, case: Case, failure: str, path: Path) -> str:
    """Report the time and reason of a stop, and the place of the rest."""
    if case.campaign_cycles:
        return (
            f"the wear campaign stopped after {dataset.attrs.get('wear_cycles_reached', 0)} of "
            f"{case.campaign_cycles} cycles: {failure}; what was computed until then is saved in "
            f"{os.fspath(path)}; the same command continues from there"
        )
    reached = float(dataset.attrs.get("time_reached", 0.0))
    return (
        f"the run stopped at t = {reached:.6g} s of {case.duration:.6g} s: {failure}; "
        f"what was computed until then is saved in {os.fspath(path)}"
    )
