"""Figures and reports of stored results."""

from __future__ import annotations

import warnings
from argparse import ArgumentParser
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.cli.interrupt import on_leaving
from tribodyn.cli.options import FIGURES, REPORT

if TYPE_CHECKING:
    import xarray as xr


def add_arguments(parser: ArgumentParser) -> None:
    """Add the options that leave pictures out."""
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="draw no figures")
    parser.add_argument("--no-report", dest="page", action="store_false", help="write no report")


def draw(dataset: xr.Dataset, directory: Path, *, figures: bool = True, page: bool = True) -> None:
    """Draw all figures and write the report of a result into its directory."""
    if not (figures or page):
        return
    from tribodyn import report

    if figures:
        every_other = [
            partial(report.draw_all, dataset, directory / FIGURES, part=slice(k, None, 2)) for k in (0, 1)
        ]
        with _meanwhile(every_other[1]):
            every_other[0]()
    if page:
        report.write(dataset, directory / REPORT)


@contextmanager
def _meanwhile(work: Callable[[], object]) -> Iterator[None]:
    """Have another process do something while the block runs; where none can, this one does it then."""
    from multiprocessing import get_context

    from tribodyn.core.platforms import FORKS, processors

    if not FORKS or processors() < 2:
        yield
        work()
        return
    with warnings.catch_warnings():
        # Threads of libraries hold no lock here, and matplotlib, which is all that runs there, has none.
        warnings.simplefilter("ignore", DeprecationWarning)
        process = get_context("fork").Process(target=_alone, args=(work,), daemon=True)
        process.start()
    on_leaving(process.kill)
    try:
        yield
    except BaseException:
        process.kill()
        raise
    process.join()
    if process.exitcode:
        work()


def _alone(work: Callable[[], object]) -> None:
    """Do the work of a process that another one started, which is the one to hear signals and to complain."""
    import os
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        work()
    except BaseException:
        os._exit(1)


def draw_points(directory: Path, note: Callable[[str], None]) -> None:
    """Write the report of every point of a sweep that has its whole result, without figures as files.

    ``directory``: of the sweep; ``note``: prints a line.
    """
    from tribodyn import report
    from tribodyn.mechanisms.results import read
    from tribodyn.results.store import POINTS, RESULT

    found = sorted((directory / POINTS).glob(f"*/{RESULT}"))
    # A link could lead out of the folder of the sweep.
    results = [result for result in found if not result.parent.is_symlink()]
    if results:
        note(f"writing the reports of {len(results)} points")
    for result in results:
        report.write(read(result), result.parent / REPORT)
