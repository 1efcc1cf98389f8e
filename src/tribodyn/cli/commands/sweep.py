"""``tribodyn sweep``: simulate a case at many values of its parameters."""

from __future__ import annotations

import json
import os
import traceback
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.cli.console import POINTS, Console, Progress, complain, progress, show_json
from tribodyn.cli.interrupt import Interruption, last_words
from tribodyn.cli.options import POINTS as POINTS_FOLDER
from tribodyn.cli.options import (
    REPORT,
    OutputDirectory,
    add_study_arguments,
    changes,
    chosen_case,
    typed,
    where,
    without_quotes,
)
from tribodyn.cli.pictures import add_arguments as add_drawing_arguments
from tribodyn.cli.pictures import draw, draw_points
from tribodyn.cli.tables import sweep_in_words
from tribodyn.core import fork_server
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, nearest

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases import Case
    from tribodyn.studies import Arrival, Means, SweepPlan

HELP = "simulate a case at many values of its parameters, on all processors or on a Dask cluster"
EXAMPLE = "tribodyn sweep slider-crank --vary joints.wrist.clearance.radial='20 um:40 um:5 um' --workers 2"
_STOPPING: Final = "stopping; finished points are kept; interrupt again to leave at once"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``sweep``."""
    add_study_arguments(parser, "sweep")
    parser.add_argument(
        "--vary",
        metavar="PATH=VALUES",
        action="append",
        required=True,
        help='a list "20 um,30 um", a range "10 um:50 um:10 um" or a distribution "normal(20 um, 2 um)"; '
        "may be repeated: lists and ranges form a grid",
    )
    parser.add_argument(
        "--limit",
        dest="limits",
        metavar="NAME=LIMIT",
        action="append",
        default=[],
        help="upper limit of a key result; the share of points within it is printed; may be repeated",
    )
    parser.add_argument(
        "--show",
        metavar="NAMES",
        help="key results of summary.json in the table, instead of all that vary: "
        "vane_angle_error_max_deg,steps",
    )
    parser.add_argument(
        "--samples", metavar="N", type=int, help="how many samples are drawn from distributions"
    )
    parser.add_argument(
        "--method",
        metavar="NAME",
        default="lhs",
        help="lhs (Latin hypercube), sobol, or saltelli: sensitivities, N (parameters + 2) points",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="equal seeds give equal samples")
    add_drawing_arguments(parser)
    again = parser.add_mutually_exclusive_group()
    again.add_argument("--retry", action="store_true", help="compute again the points that failed before")
    again.add_argument("--fresh", action="store_true", help="compute all points again")
    whole = parser.add_mutually_exclusive_group()
    whole.add_argument(
        "--results",
        dest="whole",
        action="store_true",
        default=None,
        help="keep the whole result of each point; by default those of up to 24 points are kept",
    )
    whole.add_argument("--summary-only", dest="whole", action="store_false", help="keep none of them")


def execute(args: Namespace) -> int:
    """Run the sweep; 0 when every point has a result and everything is written, else 1."""
    folder = f"sweep-{Path(args.case).stem}" if args.output is None else args.output
    # Where there are points already, there may be nothing to compute.
    if args.workers != 0 and args.scheduler is None and not os.path.exists(f"{folder}/{POINTS_FOLDER}"):
        # It imports and loads while this process imports, too.
        fork_server.start(name=args.case, changes=changes(args))
    from tribodyn.studies import Means, Sampling, make_plan
    from tribodyn.studies.search import limit, no_run_has

    console = Console.of(args)
    case = chosen_case(args)
    shown = _shown(args.show, case)
    limits = [limit(text, case, "--limit", least=False) for text in args.limits]
    plan = make_plan(case, _variations(args.vary), Sampling(args.samples, args.method, args.seed))
    means = Means(**where(args), retry=args.retry, fresh=args.fresh, keep_results=args.whole)
    directory = OutputDirectory(folder)
    with directory.reserved():
        with Interruption(_STOPPING) as interruption:
            last_words(f"aborted; points that had finished are kept in {os.fspath(directory.path)}")
            if args.figures or args.page:
                # It draws in the end, and is imported here, while the fork server still gets ready.
                from tribodyn import report  # noqa: F401
            dataset = _computed(plan, directory.path, means, console, interruption)
        # That of an earlier sweep would contradict this one.
        (directory.path / REPORT).unlink(missing_ok=True)
        # Only the table and the figures of this command look at it.
        dataset.attrs["shown"] = ",".join(shown)
        dataset.attrs["limits"] = json.dumps({asked.name: asked.value for asked in limits})
        _judge(dataset, directory.path)
        drawn = _draw(dataset, directory.path, console, args, points=not interruption.requested)
    _tell(directory.path, shown, console)
    _warn(dataset)
    lost = int(dataset.attrs["points_failed"])
    if lost:
        complain(_lost(dataset, lost))
    absent = [name for name in (*shown, *(asked.name for asked in limits)) if name not in dataset]
    for name in absent:
        complain(no_run_has(name, dataset))
    return 0 if drawn and not lost and not absent else 1


def _judge(dataset: xr.Dataset, path: Path) -> None:
    """Add to the record which share of the points keeps each limit, and on what the numbers depend."""
    from dataclasses import asdict

    from tribodyn.results.store import write_text
    from tribodyn.studies import sensitivities, shares
    from tribodyn.studies.sweep import RECORD, finite

    limits: dict[str, float] = json.loads(dataset.attrs["limits"])
    given = {name: value for name, value in limits.items() if name in dataset}
    record = json.loads((path / RECORD).read_text(encoding="utf-8"))
    record["limits"] = [
        {"name": name, "limit": given[name], **finite(asdict(share))}
        for name, share in shares(dataset, given).items()
    ]
    record["sensitivities"] = {
        name: {path: finite(asdict(index)) for path, index in found.items()}
        for name, found in sensitivities(dataset).items()
    }
    write_text(path / RECORD, json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _shown(asked: str | None, case: Case) -> list[str]:
    """Return the names of the key results that the user requests."""
    from tribodyn.mechanisms.results import key_results_of_case
    from tribodyn.results.summary import name_today
    from tribodyn.studies.search import LISTED

    names = [name_today(name.strip()) for name in (asked or "").split(",") if name.strip()]
    known = key_results_of_case(case)
    for name in names:
        if name not in known:
            raise InputError(
                f"{as_given(name)}; not a key result; {nearest(name, known)}. {LISTED}", key="--show"
            )
    return names


def _variations(texts: list[str]) -> dict[str, str]:
    """Return the varied values, by path."""
    variations: dict[str, str] = {}
    for text in texts:
        path, equals, values = (without_quotes(part) for part in typed(text).partition("="))
        if not (equals and path and values):
            raise InputError(
                f'{as_given(text)}; allowed: PATH=VALUES, such as joint.clearance="20 um,30 um"', key="--vary"
            )
        if path in variations:
            raise InputError("this parameter is varied twice", key=path, source="--vary")
        variations[path] = values
    return variations


def _computed(plan: SweepPlan, path: Path, means: Means, console: Console, stop: Interruption) -> xr.Dataset:
    from tribodyn.studies import Watcher, run

    with ExitStack() as stack:
        shown = _Shown(plan, console, stack)
        return run(plan, path, means, Watcher(shown, stop, shown.note))


class _Shown:
    """Shows the arrival of points; the bar opens when it is known how many there are to compute."""

    def __init__(self, plan: SweepPlan, console: Console, stack: ExitStack) -> None:
        self._n_points = len(plan.points)
        self._console = console
        self._stack = stack
        self._bar: Progress

    def note(self, text: str) -> None:
        """Print a line about the work."""
        self._bar.note(text)

    def __call__(self, arrival: Arrival) -> None:
        """Show one arrival."""
        if arrival.point is None:
            there = self._n_points - arrival.to_do
            here = f", {there} are there already" if there else ""
            self._console.note(f"computing {arrival.to_do} of {self._n_points} points{here}")
            for warning in arrival.warnings:
                complain(f"warning: {warning}")
            self._bar = self._stack.enter_context(progress(max(arrival.to_do, 1), self._console, POINTS))
            return
        if arrival.failure:
            self._bar.note(f"no result at {arrival.point.label}: {arrival.failure}")
        self._bar(arrival.done)


def _draw(dataset: xr.Dataset, path: Path, console: Console, args: Namespace, *, points: bool) -> bool:
    """Draw figures and reports; the results are safe whatever happens here. Tell whether all were drawn.

    The reports of ``points`` take long, and can be left out.
    """
    safe = f"the results are saved in {path}; `tribodyn report {path}` draws them"
    last_words(f"interrupted while drawing; {safe}")
    from tribodyn.results.store import FEW_POINTS

    try:
        if args.page and points and int(dataset.attrs["points_in_all"]) <= FEW_POINTS:
            draw_points(path, console.note)
        if args.page or args.figures:
            console.note("drawing figures and report")
        draw(dataset, path, figures=args.figures, page=args.page)
    except Exception as error:
        if args.debug:
            traceback.print_exc()
        complain(f"figures and report could not be made ({error}); {safe}")
        return False
    last_words(f"interrupted; everything is in {path}")
    return True


def _tell(path: Path, shown: Sequence[str], console: Console) -> None:
    """Print the table, and where to look."""
    record: dict[str, Any] = json.loads((path / "sweep.json").read_text(encoding="utf-8"))
    for line in ("", record["title"], *sweep_in_words(record, shown), ""):
        console.say(line)
    from tribodyn.studies.sweep import DATASET

    look = path / (REPORT if (path / REPORT).exists() else DATASET)
    console.say(f"look at {look}; everything is in {path}{os.sep}")
    if console.json:
        show_json(record)


def _warn(dataset: xr.Dataset) -> None:
    """Report notes that points do not share, and how many have warnings, with the words of the first."""
    for note in json.loads(dataset.attrs["notes"]):
        complain(note)
    texts = [text for text in dataset["warnings"].values.ravel().tolist() if text]
    if texts:
        count = f"{len(texts)} of {dataset.attrs['points_in_all']} points"
        complain(f"warning of {count}, the first of them (sweep.json has all): {texts[0]}")


def _lost(dataset: xr.Dataset, lost: int) -> str:
    """Report the number of points without a result, and the way to get them."""
    reason = next(text for text in dataset["failure"].values.ravel().tolist() if text)
    return (
        f"{lost} of {dataset.attrs['points_in_all']} points have no result ({reason}); the same command goes "
        "on where this one ended, with --retry it also computes again what failed"
    )
