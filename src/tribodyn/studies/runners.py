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
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from tribodyn.core.errors import InputError, TribodynError
from tribodyn.studies.plan import Point
from tribodyn.studies.work import Outcome, compute, failed, warm_up

if TYPE_CHECKING:
    from distributed import Client, Future

Stop: TypeAlias = Callable[[], bool]
Finished: TypeAlias = Iterator[tuple[Point, Outcome]]

DEATHS: Final = 2
"""How many deaths of its worker a point survives: it is tried once more after each."""
_LISTEN: Final = 0.2
"""Time between two looks at whether to stop [s]."""
_PATIENCE: Final = 15.0
"""How long a scheduler may be out of reach [s]."""
_GONE: Final = "the Dask scheduler is gone; all points that had finished are saved"

# The threads of a worker would only take time from the other workers.
_ONE_THREAD: Final = {
    name: "1" for name in ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
}


def here(points: Sequence[Point], keep_result: bool, stop: Stop) -> Finished:
    """Compute points one after the other in this process, without Dask."""
    for point in points:
        if stop():
            return
        yield point, compute(point.toml, version("tribodyn"), keep_result)


def local(points: Sequence[Point], keep_result: bool, stop: Stop, workers: int | None) -> Finished:
    """Compute points in processes of this machine, one thread each.

    Parameters
    ----------
    points, keep_result, stop
        As for :func:`here`.
    workers
        How many processes; by default one for each processor.
    """
    from dask.system import CPU_COUNT

    # Compiled in this process, once, before workers that would all do the same look for it on the disk.
    warm_up(points[0].toml)
    with _local_client(min(workers or CPU_COUNT, len(points))) as client:
        yield from _computed(client, points, keep_result, stop)


def cluster(points: Sequence[Point], keep_result: bool, stop: Stop, address: str) -> Finished:
    """Compute points on the workers of a Dask scheduler that runs already.

    Parameters
    ----------
    points, keep_result, stop
        As for :func:`here`.
    address
        Such as ``tcp://10.0.0.1:8786``.
    """
    with _remote_client(address) as client:
        _warm_up_each_host(client, points[0].toml, stop)
        yield from _computed(client, points, keep_result, stop)


@contextmanager
def _local_client(workers: int) -> Iterator[Client]:
    import dask
    from distributed import Client, LocalCluster

    settings = {
        "distributed.scheduler.allowed-failures": DEATHS,
        "distributed.nanny.pre-spawn-environ": _ONE_THREAD,
        # Compiled code holds the interpreter for long stretches, which is no news.
        "distributed.admin.tick.limit": "1h",
    }
    with (
        dask.config.set(settings),
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
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
    with client:
        yield client


def _warm_up_each_host(client: Client, toml: str, stop: Stop) -> None:
    """Let one worker of each machine fill the cache of compiled code that the others there read."""
    workers = client.scheduler_info()["workers"]
    one_a_host = {about["host"]: address for address, about in workers.items()}
    tasks = [client.submit(warm_up, toml, workers=[address], pure=False) for address in one_a_host.values()]
    while any(task.status == "pending" for task in tasks) and not stop():
        _demand_connection(client, time.monotonic())
        time.sleep(_LISTEN)


def _computed(client: Client, points: Sequence[Point], keep_result: bool, stop: Stop) -> Finished:
    """Yield points as they finish; what is still to be done when ``stop`` says so is called off."""
    run, own = uuid.uuid4().hex[:8], version("tribodyn")
    waiting: dict[str, tuple[Point, Future[Any]]] = {}
    done: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
    for point in points:
        key = f"{point.name}-{run}"
        future = client.submit(compute, point.toml, own, keep_result, key=key, pure=False)
        waiting[key] = (point, future)
        future.add_done_callback(done.put)
    try:
        yield from _arriving(client, waiting, done, stop)
    finally:
        with contextlib.suppress(Exception):
            client.cancel([future for _, future in waiting.values()], force=True)


def _arriving(
    client: Client,
    waiting: dict[str, tuple[Point, Future[Any]]],
    done: queue.SimpleQueue[Future[Any]],
    stop: Stop,
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
