"""A sweep from its plan to the merged dataset and its files, with the time that it will take."""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean
from typing import Any, Final, TypedDict, Unpack

import xarray as xr

from tribodyn.cases import keys_in
from tribodyn.cases.tables import with_components
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.platforms import memory, processors, version
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.results import netcdf_content
from tribodyn.results.store import FEW_POINTS, prepare_directory, write_bytes, write_text
from tribodyn.results.summary import Summary
from tribodyn.simulation import estimate
from tribodyn.simulation.costs import MOST_MEMORY, MOST_TIME, PROGRAM, in_bytes, in_time
from tribodyn.studies.archive import NOT_COMPUTED, Archive, merge
from tribodyn.studies.cluster import Tls, cluster
from tribodyn.studies.local import local
from tribodyn.studies.plan import Point, Sampling, SweepPlan, make_plan
from tribodyn.studies.statistics import statistics
from tribodyn.studies.variation import SOURCE, Asked, written
from tribodyn.studies.work import Finished, SweepJob, compute

_LOOKED_AT: Final = 16  #: Points whose estimates stand for all.


def warnings_of(plan: SweepPlan, to_do: int, workers: int | None) -> list[str]:
    """Return warnings that the points of a sweep take long, or together much memory.

    ``to_do``: how many of its points are to be computed; ``workers``: processes of this machine, as
    :class:`~tribodyn.studies.sweep.Means` has them. Points are refused that no machine of this size holds.
    """
    n_workers = min(max(processors() if workers is None else workers, 1), to_do)
    places = {round(k * (len(plan.points) - 1) / (_LOOKED_AT - 1)) for k in range(_LOOKED_AT)}
    looked_at = [estimate(plan.case.replace(plan.points[i].changes, source=SOURCE)) for i in sorted(places)]
    seconds = to_do * fmean(one.seconds for one in looked_at) / n_workers
    largest = max(looked_at, key=lambda one: one.memory)
    largest.require_memory(memory())
    found = []
    if seconds > MOST_TIME:
        found.append(
            f"{to_do} points in {n_workers} processes are estimated to take {in_time(seconds)}, more than "
            f"{in_time(MOST_TIME)}: give fewer values, or change {looked_at[-1].time_key}"
        )
    # Workers share the program.
    together = PROGRAM + n_workers * (largest.memory - PROGRAM)
    if together > MOST_MEMORY:
        found.append(
            f"{n_workers} points at once are estimated to take {in_bytes(together)} of memory, more than "
            f"{in_bytes(MOST_MEMORY)}: give fewer --workers, or change {largest.memory_key}"
        )
    return found


DATASET: Final = "sweep.nc"
RECORD: Final = "sweep.json"


@dataclass(frozen=True)
class Arrival:
    """Progress of a sweep."""

    #: How many points were computed, and how many this sweep computes in all.
    done: int
    to_do: int
    point: Point | None = None  #: The one that has just arrived; None at the beginning.
    failure: str = ""  #: Why it gave no result, empty where it did.
    warnings: Sequence[str] = ()  #: At the beginning: that points take long, or together much memory.


class Where(TypedDict, total=False):
    """Processes or cluster that a study computes on, as :class:`Means` has them."""

    workers: int | None
    scheduler: str | None
    tls: Tls | None


@dataclass(frozen=True)
class Means:
    """Options of a sweep's computation; none of them changes a number."""

    #: Processes on this machine, by default one for each processor; 0 computes in this process.
    workers: int | None = None
    scheduler: str | None = None  #: Address of a Dask scheduler to use instead.
    tls: Tls | None = None  #: How to know it, where its address begins with ``tls://``.
    retry: bool = False  #: Whether points that failed before are computed again.
    fresh: bool = False  #: Whether all points are.
    #: Whether each point keeps its whole result beside its key results; by default those of a sweep of a few
    #: points do, see :data:`~tribodyn.results.store.FEW_POINTS`.
    keep_results: bool | None = None

    def __post_init__(self) -> None:
        """Refuse means that cannot compute."""
        if self.workers is not None and self.workers < 0:
            raise InputError(f"given {self.workers}; allowed: 0 or more", key="--workers")
        if self.tls is not None and self.scheduler is None:
            raise InputError("certificates are for a scheduler; give its address too", key="--scheduler")


@dataclass(frozen=True)
class Watcher:
    """Listener to the progress of a sweep, which may end it."""

    arrived: Callable[[Arrival], None] = lambda _: None  #: Called at the beginning and after every point.
    #: Asked several times a second; when true, the sweep ends with the points it has.
    stop: Callable[[], bool] = lambda: False
    note: Callable[[str], None] = lambda _: None  #: Called with a line about the work.


SILENT: Final = Watcher()  #: A listener that hears nothing and ends nothing.


def sweep(
    case: AnyCase,
    vary: Mapping[str, Asked],
    *,
    samples: int | None = None,
    method: str = "lhs",
    seed: int = 0,
    directory: str | Path | None = None,
    retry: bool = False,
    progress: Callable[[Arrival], None] | None = None,
    stop: Callable[[], bool] | None = None,
    **where: Unpack[Where],
) -> xr.Dataset:
    """Simulate a case at many values of its parameters.

    Parameters
    ----------
    case
        A case, a :class:`tribodyn.Mechanism`, the name of a built-in case, or a file.
    vary
        By dotted path, what each parameter is to be: values (``["20 um", "30 um"]``), or text as on the
        command line: ``"20, 30, 40 um"``, ``"10 um:50 um:10 um"``, ``"normal(20 um, 2 um)"``. Lists and
        ranges form a grid.
    samples, method, seed
        How many samples are drawn from distributions, by which sampler (``"lhs"`` or ``"sobol"``), and
        from which seed.
    directory
        Where points and merged results are kept; what is there already is not computed again. By default
        nothing is written.
    retry
        Whether points that failed in an earlier sweep are computed again.
    progress
        Called at the beginning and after every point.
    stop
        Asked several times a second; when true, the sweep ends with the points it has.
    **where
        ``workers``: processes on this machine, by default one for each processor; 0 computes in this process.
        A script that uses processes needs ``if __name__ == "__main__":``, as with :mod:`multiprocessing`.
        ``scheduler``: address of a Dask scheduler to use instead, such as ``"tcp://10.0.0.1:8786"``, and
        ``tls``: certificates for one whose address begins with ``tls://``.

    Returns
    -------
    xarray.Dataset
        See :func:`tribodyn.studies.archive.merge`.

    Raises
    ------
    InputError
        Something asked for cannot be; nothing has been computed.
    """
    plan = make_plan(case_of(case), vary, Sampling(samples, method, seed))
    means = Means(**where, retry=retry)
    watcher = Watcher(progress or Watcher.arrived, stop or Watcher.stop)
    return run(plan, None if directory is None else Path(directory), means, watcher)


def run(
    plan: SweepPlan, directory: Path | None, means: Means = Means(), watcher: Watcher = Watcher()
) -> xr.Dataset:
    """Compute the missing points of a plan and merge all of it.

    Parameters
    ----------
    plan
        From :func:`~tribodyn.studies.plan.make_plan`.
    directory
        Where runs are kept; those that are there already are not computed again. None keeps nothing.
    means
        The processes that compute.
    watcher
        Is called as points arrive, and may end the sweep.

    Returns
    -------
    xarray.Dataset
        See :func:`tribodyn.studies.archive.merge`.

    Raises
    ------
    InputError
        A scheduler does not answer, or the folder holds another sweep.
    TribodynError
        The workers ended; points that had arrived are merged and kept.
    """
    summaries: dict[str, Summary] = {}
    try:
        compute_missing(plan, directory, means, watcher, summaries)
    except InputError:
        raise
    except TribodynError:
        _merged(plan, summaries, directory)
        raise
    return _merged(plan, summaries, directory)


def _kept(plan: SweepPlan, archive: Archive | None, means: Means) -> dict[str, Summary]:
    """Return the summaries of the points that need not be computed again."""
    if archive is None or means.fresh:
        return {}
    found = {point.name: archive.find(point) for point in plan.points}
    return {
        name: summary
        for name, summary in found.items()
        if summary is not None and not (means.retry and summary.get("failure"))
    }


def compute_missing(
    plan: SweepPlan, directory: Path | None, means: Means, watcher: Watcher, summaries: dict[str, Summary]
) -> None:
    """Compute the missing points of a plan, keep each when it arrives, and add the summaries of all.

    ``plan``, ``directory``, ``means``, ``watcher``: as for :func:`run`; ``summaries``: filled by the names of
    points.
    """
    whole = len(plan.points) <= FEW_POINTS if means.keep_results is None else means.keep_results
    whole = whole and directory is not None
    archive = None if directory is None else Archive(prepare_directory(directory), whole=whole)
    summaries |= _kept(plan, archive, means)
    # By name: samples may coincide.
    missing = list({point.name: point for point in plan.points if point.name not in summaries}.values())
    warnings = warnings_of(plan, len(missing), means.workers) if missing and means.scheduler is None else ()
    watcher.arrived(Arrival(0, len(missing), warnings=warnings))
    if not missing:
        return
    staging = "" if archive is None else str(archive.staging)
    job = SweepJob(plan.case, missing, whole, staging, watcher.stop, watcher.note)
    with nullcontext() if archive is None else archive.open():
        for done, (point, outcome) in enumerate(_finished(job, means), 1):
            if archive is not None and outcome.final:
                archive.keep(point, outcome)
            summaries[point.name] = outcome.summary
            watcher.arrived(Arrival(done, len(missing), point, outcome.failure))


def _finished(job: SweepJob, means: Means) -> Finished:
    if means.scheduler is not None:
        return cluster(job, means.scheduler, means.tls)
    return _here(job) if means.workers == 0 else local(job, means.workers)


def _here(job: SweepJob) -> Finished:
    """Compute points one after the other in this process."""
    for point in job.points:
        if job.stop():
            return
        (outcome,) = compute(job.case, [point.changes], version("tribodyn"), job.keep_result, stop=job.stop)
        if outcome.failure and job.stop():
            return
        yield point, outcome


def _merged(plan: SweepPlan, summaries: dict[str, Summary], directory: Path | None) -> xr.Dataset:
    dataset = merge(plan, summaries)
    if directory is not None:
        write_bytes(directory / DATASET, netcdf_content(dataset))
        record = json.dumps(_record(plan, summaries, dataset), indent=2, ensure_ascii=False, allow_nan=False)
        write_text(directory / RECORD, record + "\n")
    return dataset


def _record(plan: SweepPlan, summaries: dict[str, Summary], dataset: xr.Dataset) -> dict[str, Any]:
    """Return the sweep as JSON holds it: one entry a point, and the statistics of samples."""
    keys = with_components(keys_in(plan.case))
    nothing: Summary = {"status": "missing", "failure": NOT_COMPUTED}
    return {
        "title": plan.case.title,
        "kind": plan.case.kind(),
        "tribodyn_version": version("tribodyn"),
        "points": [
            {"point": point.name, "changes": dict(point.changes), **summaries.get(point.name, nothing)}
            for point in plan.points
        ],
        "statistics": [
            {
                "at": {path: written(keys[path], value) for path, value in at.items()},
                "numbers": {name: finite(numbers) for name, numbers in found.items()},
            }
            for at, found in statistics(dataset)
        ],
    }


def finite(numbers: dict[str, float]) -> dict[str, float]:
    """Return those of some numbers that JSON can hold."""
    return {name: value for name, value in numbers.items() if math.isfinite(value)}
