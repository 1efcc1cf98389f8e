"""A worker process: it does one thing at a time, and says so in bytes.

What comes in is JSON. What goes out begins with a letter: an event, the result, a failure in words, or that
the work was given up. Nothing is unpickled on either side.
"""

from __future__ import annotations

import json
import signal
import sys
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Final

from tribodyn.core import fork_server
from tribodyn.core.errors import Stopped, TribodynError
from tribodyn.workbench.picture import WORK, Interrupted

EVENT, RESULT, FAILURE, GIVEN_UP = b"e", b"r", b"f", b"s"
STOP: Final = b"{}"
"""What is sent to a worker that shall give up; to one that has finished meanwhile it means nothing."""
_EVENTS_APART: Final = 0.5
"""Least time between two events [s]."""
_GB: Final = 1e9


@dataclass(frozen=True)
class Limits:
    """What a worker may take.

    Attributes
    ----------
    memory
        Address space beyond what it has when it begins [bytes]; kept on Linux.
    result
        Size of a result [bytes].
    """

    memory: int = 4_000_000_000
    result: int = 100_000_000


def serve(connection: Connection, limits: Limits) -> None:
    """Do what is asked, until nobody asks any more.

    Parameters
    ----------
    connection
        Gives orders and takes answers.
    limits
        What this process may take.
    """
    # Ctrl-C is for the command, which ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fork_server.end_with_parent()
    _limit_memory(limits.memory)
    with suppress(EOFError, OSError):
        while True:
            order = connection.recv_bytes()
            if order != STOP:
                connection.send_bytes(_answer(json.loads(order), connection, limits))


def _answer(order: Mapping[str, Any], connection: Connection, limits: Limits) -> bytes:
    """Do one thing; no exception leaves this function but those that end processes."""
    try:
        content = _done(order, connection)
    except (Interrupted, Stopped):
        return GIVEN_UP
    except TribodynError as error:
        return FAILURE + str(error).encode("utf-8", "replace")
    except MemoryError:
        reason = f"this takes more memory than a worker may have, {limits.memory / _GB:g} GB"
        return FAILURE + reason.encode()
    except Exception as error:
        return FAILURE + f"internal error: {type(error).__name__}: {error}".encode("utf-8", "replace")
    if len(content) > limits.result:
        return FAILURE + f"the result is larger than {limits.result / 1e6:g} MB".encode()
    return RESULT + content


def _done(order: Mapping[str, Any], connection: Connection) -> bytes:
    from tribodyn.mechanisms.catalogue import parse_case

    case = parse_case(order["case"], "workbench")
    told = time.monotonic()

    def progress(reached: float) -> None:
        nonlocal told
        if time.monotonic() - told > _EVENTS_APART:
            told = time.monotonic()
            connection.send_bytes(EVENT + json.dumps({"reached": reached}).encode())

    return WORK[order["work"]](case, order, progress, connection.poll)


def _limit_memory(more: int) -> None:
    """Let the address space of this process grow by so many bytes and no further."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + more
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or most < hard:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
