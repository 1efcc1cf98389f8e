"""Points computed on the workers of a Dask scheduler that runs already; only here is Dask imported."""

from __future__ import annotations

import contextlib
import logging
import queue
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.platforms import version
from tribodyn.studies.plan import Point
from tribodyn.studies.work import LISTEN, Finished, PointOutcome, SweepJob, blocks_of, compute, failed

if TYPE_CHECKING:
    from distributed import Client, Future, Security

_PATIENCE: Final = 15.0  #: Time for which a scheduler may be out of reach [s].
_GONE: Final = "the Dask scheduler is gone; all points that had finished are saved"
_ENCRYPTED: Final = "tls://"


@dataclass(frozen=True)
class Tls:
    """Files in PEM format by which a scheduler and this process know each other."""

    #: Certificate of the authority that the certificates of scheduler, workers and this process come from.
    ca: str | Path
    cert: str | Path  #: Certificate of this process.
    key: str | Path | None = None  #: Its private key; None where ``cert`` holds it, too.


def cluster(job: SweepJob, address: str, tls: Tls | None = None) -> Finished:
    """Compute points on the workers of a Dask scheduler that runs already.

    ``address``: such as ``tcp://10.0.0.1:8786``, or ``tls://10.0.0.1:8786``; ``tls``: what the second of
    these needs, unless Dask's own configuration has it. Raises InputError if nobody answers at this address,
    or not whom ``tls`` trusts, or Dask is not installed; TribodynError if the scheduler is gone.
    """
    try:
        import distributed  # noqa: F401
    except ImportError as error:
        raise InputError(
            "a scheduler needs the package distributed: install tribodyn[cluster], or leave --scheduler out "
            "to compute on this machine",
            key="--scheduler",
        ) from error
    with _client(address, None if tls is None else _security(tls, address)) as client:
        yield from _computed(client, job)


def _security(tls: Tls, address: str) -> Security:
    from distributed import Security

    if not address.startswith(_ENCRYPTED):
        raise InputError(
            f'given "{address}" with certificates; allowed: an address that begins with {_ENCRYPTED}',
            key="--scheduler",
        )
    for option, file in (("--tls-ca", tls.ca), ("--tls-cert", tls.cert), ("--tls-key", tls.key)):
        if file is not None and not Path(file).is_file():
            raise InputError(f'given "{file}"; allowed: a file in PEM format', key=option)
    return Security(
        tls_ca_file=str(tls.ca),
        tls_client_cert=str(tls.cert),
        tls_client_key=str(tls.key or tls.cert),
        require_encryption=True,
    )


@contextmanager
def _client(address: str, security: Security | None) -> Iterator[Client]:
    from distributed import Client

    with _quiet():
        try:
            client = Client(address, timeout=_PATIENCE, security=security, set_as_default=False)
        except (OSError, ValueError, ImportError, TypeError) as error:
            raise InputError(
                f'given "{address}": no scheduler answers there ({error}); allowed: the address that '
                "`dask scheduler` prints, such as tcp://10.0.0.1:8786; one that begins with "
                f"{_ENCRYPTED} needs certificates (--tls-ca, --tls-cert)",
                key="--scheduler",
            ) from None
        with client:
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


def _computed(client: Client, job: SweepJob) -> Finished:
    """Yield points as they finish; what is still to be done when the job stops is called off."""
    run, own = uuid.uuid4().hex[:8], version("tribodyn")
    waiting: dict[str, tuple[Sequence[Point], Future[Any]]] = {}
    done: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
    for block in blocks_of(job.case, job.points, max(sum(client.nthreads().values()), 1)):
        key = f"{block[0].name}-{run}"
        changes = [point.changes for point in block]
        future = client.submit(compute, job.case, changes, own, job.keep_result, key=key, pure=False)
        waiting[key] = (block, future)
        future.add_done_callback(done.put)
    try:
        yield from _arriving(client, waiting, done, job.stop)
    finally:
        with contextlib.suppress(Exception):
            client.cancel([future for _, future in waiting.values()], force=True)


def _arriving(
    client: Client,
    waiting: dict[str, tuple[Sequence[Point], Future[Any]]],
    done: queue.SimpleQueue[Future[Any]],
    stop: Callable[[], bool],
) -> Finished:
    heard = time.monotonic()
    while waiting and not stop():
        try:
            future = done.get(timeout=LISTEN)
        except queue.Empty:
            heard = _demand_connection(client, heard)
            continue
        if future.cancelled():
            raise TribodynError(_GONE)
        block, _ = waiting.pop(str(future.key))
        yield from zip(block, _outcomes(future, len(block)), strict=True)
        # Frees the worker's memory.
        future.release()


def _demand_connection(client: Client, heard: float) -> float:
    """Return the time of the scheduler's last answer; give up after a while without it."""
    if client.status == "running":
        return time.monotonic()
    if client.status == "closed" or time.monotonic() - heard > _PATIENCE:
        raise TribodynError(_GONE)
    return heard


def _outcomes(future: Future[Any], n: int) -> list[PointOutcome]:
    """Return the outcomes of points; reports of Dask are not about the points themselves and not final."""
    from distributed import KilledWorker

    try:
        return list(future.result())
    except KilledWorker:
        return n * [failed("its worker process died at every attempt", final=False)]
    except Exception as error:
        return n * [failed(f"the worker could not compute it: {type(error).__name__}: {error}", final=False)]
