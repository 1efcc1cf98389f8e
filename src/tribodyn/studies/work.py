"""Work of every runner: some points, from a case and its changes to numbers and bytes.

It writes no file but the whole result, where it is given a folder for that.
"""

import contextlib
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeAlias

from tribodyn.cases import Case
from tribodyn.core.errors import TribodynError
from tribodyn.core.platforms import unexpected, version
from tribodyn.results.summary import Summary
from tribodyn.studies.plan import Point


@dataclass(frozen=True)
class PointOutcome:
    """Outcome of a point."""

    #: As :func:`tribodyn.results.summarise` gives it; of a point that could not be computed only texts.
    summary: Summary
    #: The dataset as NetCDF; empty where there is none, or none is wanted, or it is staged.
    result: bytes = b""
    #: File with the dataset, from :func:`tribodyn.results.store.stage`; empty where there is none.
    staged: str = ""
    final: bool = True  #: Whether computing it again would give the same. Not so where a worker died.

    @property
    def failure(self) -> str:
        """Why there are no numbers, empty where there are."""
        return str(self.summary.get("failure", ""))


def failed(reason: str, *, final: bool) -> PointOutcome:
    """Return the facts on a point that gave no result."""
    return PointOutcome({"title": "", "status": "failed", "failure": reason, "warnings": []}, final=final)


def compute(
    case: Case,
    changes: Sequence[Mapping[str, str]],
    made_by: str,
    keep_result: bool,
    staging: str = "",
    stop: Callable[[], bool] | None = None,
) -> list[PointOutcome]:
    """Simulate a case with some changes after the other, in one call of a worker.

    A point that fails is an outcome too: no exception leaves this function but those that end processes.
    ``changes``: of each point, by dotted path; ``made_by``: version of tribodyn that planned it, another one
    does not compute it; ``keep_result``: whether the whole result is returned beside the key results;
    ``staging``: path beside which it is left as a file, on a machine whose disk the caller sees: bytes of a
    worker go through two processes before they are written, and where that fails, the result is returned all
    the same; ``stop``: as for :func:`tribodyn.simulation.simulate`.
    """
    own = version("tribodyn")
    if own != made_by:
        reason = f"the worker has tribodyn {own}, the sweep was planned by {made_by}"
        return len(changes) * [failed(reason, final=False)]
    return [_outcome(case, one, keep_result, staging, stop) for one in changes]


def _outcome(
    case: Case, changes: Mapping[str, str], keep_result: bool, staging: str, stop: Callable[[], bool] | None
) -> PointOutcome:
    try:
        return _simulated(case.replace(changes), keep_result, staging, stop)
    except TribodynError as error:
        return failed(str(error), final=True)
    except MemoryError:
        return failed("the worker has not enough memory", final=False)
    except Exception as error:
        return failed(unexpected(error), final=True)


_MOST_OF_BLOCK: Final = 16
#: Processor time of a block [s]: what is lost with its worker, and how long a stop waits.
_BLOCK_TIME: Final = 1.0
_TURNS: Final = 4  #: Blocks that each worker still gets: the last ones are short, so that all end together.


def blocks_of(case: Case, points: Sequence[Point], workers: int) -> Iterator[Sequence[Point]]:
    """Yield points that a worker computes in one call: few of long cases, and towards the end one."""
    from tribodyn.simulation import estimate

    seconds, done = estimate(case).seconds, 0
    most = min(max(int(_BLOCK_TIME / seconds), 1), _MOST_OF_BLOCK)
    while done < len(points):
        size = min(max((len(points) - done) // (_TURNS * workers), 1), most)
        yield points[done : done + size]
        done += size


def _simulated(case: Case, keep_result: bool, staging: str, stop: Callable[[], bool] | None) -> PointOutcome:
    from tribodyn.mechanisms.results import summarise
    from tribodyn.results import netcdf_content
    from tribodyn.results.store import stage
    from tribodyn.simulation import simulate

    dataset = simulate(case, stop=stop)
    summary, content = summarise(dataset), netcdf_content(dataset) if keep_result else b""
    if content and staging:
        with contextlib.suppress(OSError):
            return PointOutcome(summary, staged=os.fspath(stage(Path(staging), content)))
    return PointOutcome(summary, content)


def load(name: str, toml: str, changes: Mapping[str, str]) -> None:
    """Import the packages for points, and load the equations of a case.

    ``name``, ``toml``: the case: a file or a built-in one, or its text. The other is empty. ``changes``:
    values to change in it, by dotted path.
    """
    import_what_points_need()
    from tribodyn.mechanisms.catalogue import load_case, parse_case
    from tribodyn.simulation import first_steps

    with contextlib.suppress(Exception):
        case = parse_case(toml, "sweep") if toml else load_case(name)
        first_steps(case.replace(changes))


def import_what_points_need() -> None:
    """Import the packages of :func:`compute`."""
    import xarray as xr

    from tribodyn import simulation  # noqa: F401
    from tribodyn.results import netcdf_content

    # It imports what it writes with.
    with contextlib.suppress(Exception):
        netcdf_content(xr.Dataset())


Finished: TypeAlias = Iterator[tuple[Point, PointOutcome]]

LISTEN: Final = 0.1  #: Time between two looks at whether to stop [s].
_SOON: Final = 5.0  #: Time after which a user reads why workers are not ready [s].
_PREPARING: Final = "preparing the workers"


@dataclass(frozen=True)
class SweepJob:
    """Points to be computed."""

    case: Case  #: The case that all begin from.
    points: Sequence[Point]  #: One or more.
    keep_result: bool  #: Whether outcomes hold the whole result beside the key results.
    staging: str  #: Path beside which workers of this machine leave it instead; empty for none.
    #: Asked several times a second; when true, what is still to be done is called off.
    stop: Callable[[], bool]
    note: Callable[[str], None]  #: Called with what a user should know.


def stop_while_preparing(job: SweepJob) -> Callable[[], bool]:
    """Return a check for a stop that reports after a while why there are no points yet."""
    began, news = time.monotonic(), [_PREPARING]

    def stop() -> bool:
        if news and time.monotonic() - began > _SOON:
            job.note(news.pop())
        return job.stop()

    return stop
