"""Where points are computed: in this process, in processes of this machine, or on a Dask cluster.

Each runner takes points and yields them with their outcomes as they finish. Local processes and a
cluster differ in nothing but where the scheduler is.
"""

from __future__ import annotations

import contextlib
import logging
import queue
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from tribodyn.core import fork_server
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.versions import version
from tribodyn.studies.plan import Point
from tribodyn.studies.work import Outcome, compute, failed, warm_up

if TYPE_CHECKING:
    from distributed import Client, Future

Finished: TypeAlias = Iterator[tuple[Point, Outcome]]

DEATHS: Final = 2
"""How many deaths of its worker a point survives: it is tried once more after each."""
_LISTEN: Final = 0.1
"""Time between two looks at whether to stop [s]."""
_SOON: Final = 5.0
"""How long workers may get ready before a user is told why nothing happens [s]."""
_PREPARING: Final = (
    "preparing the workers; where the equations are not compiled yet this takes a minute or two"
)
_PATIENCE: Final = 15.0
"""How long a scheduler may be out of reach [s]."""
_GONE: Final = "the Dask scheduler is gone; all points that had finished are saved"


@dataclass(frozen=True)
class Job:
    """What is to be computed.

    Attributes
    ----------
    points
        One or more.
    keep_result
        Whether outcomes hold the whole result beside the headline numbers.
    staging
        Path beside which workers of this machine leave it instead; empty for none.
    stop
        Asked several times a second; when true, what is still to be done is called off.
    note
        Told what a user should know.
    """

    points: Sequence[Point]
    keep_result: bool
    staging: str
    stop: Callable[[], bool]
    note: Callable[[str], None]


def here(job: Job) -> Finished:
    """Compute points one after the other in this process, without Dask."""
    for point in job.points:
        if job.stop():
            return
        outcome = compute(point.toml, version("tribodyn"), job.keep_result, stop=job.stop)
        if outcome.failure and job.stop():
            return
        yield point, outcome


def local(job: Job, workers: int | None) -> Finished:
    """Compute points in processes of this machine, one thread each.

    Parameters
    ----------
    job
        The points.
    workers
        How many processes; by default one for each processor.
    """
    from dask.system import CPU_COUNT

    # The command line has started it already, before all else.
    fork_server.start(job.points[0].toml, {})
    with _local_client(min(workers or CPU_COUNT, len(job.points))) as client:
        yield from _computed(client, job, job.staging)


def cluster(job: Job, address: str) -> Finished:
    """Compute points on the workers of a Dask scheduler that runs already.

    Parameters
    ----------
    job
        The points.
    address
        Such as ``tcp://10.0.0.1:8786``.
    """
    with _remote_client(address) as client:
        yield from _computed(client, job, staging="")


@contextmanager
def _local_client(workers: int) -> Iterator[Client]:
    import dask
    from distributed import Client, LocalCluster

    settings = {
        "distributed.scheduler.allowed-failures": DEATHS,
        "distributed.nanny.pre-spawn-environ": fork_server.ENVIRONMENT,
        "distributed.worker.multiprocessing-method": fork_server.METHOD,
        # Compiled code holds the interpreter for long stretches, which is no news.
        "distributed.admin.tick.limit": "1h",
    }
    with (
        dask.config.set(settings),
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            # Without a dashboard its server starts all the same: any free port, for another sweep may have
            # the usual one.
            scheduler_kwargs={"dashboard": False},
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
            preload=["tribodyn.studies.work"],
        ) as processes,
        Client(processes) as client,
    ):
        yield client


@contextmanager
def _remote_client(address: str) -> Iterator[Client]:
    from distributed import Client

    try:
        client = Client(address, timeout=_PATIENCE)
    except (OSError, ValueError, ImportError) as error:
        raise InputError(
            f'given "{address}": no scheduler answers there ({error}); allowed: the address that '
            "`dask scheduler` prints, such as tcp://10.0.0.1:8786",
            key="--scheduler",
        ) from None
    with _quiet(), client:
        yield client


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask from printing tracebacks when the connection is lost: we say it in a sentence."""
    loggers = [logging.getLogger(name) for name in ("distributed", "distributed.client")]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _prepare(client: Client, job: Job) -> None:
    """Let one worker of each machine fill the cache of compiled code, from which the others there read it.

    Meanwhile the others import what they need.
    """
    from distributed.comm.addressing import get_address_host

    workers = list(client.nthreads())
    first = {get_address_host(address): address for address in workers}.values()
    tasks = {
        address: client.submit(
            warm_up,
            job.points[0].toml if address in first else "",
            workers=[address],
            allow_other_workers=True,
            pure=False,
        )
        for address in workers
    }
    done: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
    for address in first:
        tasks[address].add_done_callback(done.put)
    left, news, began = len(first), [_PREPARING], time.monotonic()
    while left and not job.stop():
        try:
            done.get(timeout=_LISTEN)
            left -= 1
        except queue.Empty:
            if news and time.monotonic() - began > _SOON:
                job.note(news.pop())
            _demand_connection(client, time.monotonic())


def _computed(client: Client, job: Job, staging: str) -> Finished:
    """Yield points as they finish; what is still to be done when the job stops is called off."""
    _prepare(client, job)
    run, own = uuid.uuid4().hex[:8], version("tribodyn")
    waiting: dict[str, tuple[Point, Future[Any]]] = {}
    done: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
    for point in job.points:
        key = f"{point.name}-{run}"
        future = client.submit(compute, point.toml, own, job.keep_result, staging, key=key, pure=False)
        waiting[key] = (point, future)
        future.add_done_callback(done.put)
    try:
        yield from _arriving(client, waiting, done, job.stop)
    finally:
        with contextlib.suppress(Exception):
            client.cancel([future for _, future in waiting.values()], force=True)


def _arriving(
    client: Client,
    waiting: dict[str, tuple[Point, Future[Any]]],
    done: queue.SimpleQueue[Future[Any]],
    stop: Callable[[], bool],
) -> Finished:
    heard = time.monotonic()
    while waiting and not stop():
        try:
            future = done.get(timeout=_LISTEN)
        except queue.Empty:
            heard = _demand_connection(client, heard)
            continue
        if future.cancelled():
            raise TribodynError(_GONE)
        point, _ = waiting.pop(str(future.key))
        yield point, _outcome(future)
        # Frees the worker's memory.
        future.release()


def _demand_connection(client: Client, heard: float) -> float:
    """Return when the scheduler was last known to be there; give up after a while without it."""
    if client.status == "running":
        return time.monotonic()
    if client.status == "closed" or time.monotonic() - heard > _PATIENCE:
        raise TribodynError(_GONE)
    return heard


def _outcome(future: Future[Any]) -> Outcome:
    """Return what came of a point; what Dask reports says nothing about the point itself and is not final."""
    from distributed import KilledWorker

    try:
        outcome = future.result()
    except KilledWorker:
        return failed("its worker process died at every attempt", final=False)
    except Exception as error:
        return failed(f"the worker could not compute it: {type(error).__name__}: {error}", final=False)
    assert isinstance(outcome, Outcome)
    return outcome
