"""Worker processes: each answers one message at a time, and is started again when it dies.

A worker has one end of a pair of sockets without a name, this process the other: nothing listens that another
user could connect to. A worker starts without the working directory in its import path, and with one thread
(:data:`tribodyn.core.fork_server.ENVIRONMENT`). It leaves Ctrl-C to the command, and ends when this process
ends, whatever it does then. The caller decides which worker gets which task, and how messages are encoded.
"""

import multiprocessing
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Final, TypeAlias

from tribodyn.core import fork_server, platforms
from tribodyn.core.errors import TribodynError

DEATHS: Final = 2  #: Deaths of its worker that a task survives: it is repeated after each.
#: Why a task has no result when its worker has died once more than that.
DIED: Final = "its worker process died at every attempt"
UNREADY: Final = (
    "worker processes die while they get ready: the memory may be short, or a script starts them outside of "
    '`if __name__ == "__main__":`'
)

#: From a message to the reply; None where there is none. It may send more over the connection before.
Answer: TypeAlias = Callable[[bytes, Connection], bytes | None]


@dataclass(frozen=True)
class Service:
    """Task of a worker process; all functions are those of a module."""

    answer: Answer  #: Called with every message.
    prepare: Callable[[], object] | None = None  #: Called once before the first.
    #: Address space that the process may take beyond what it has when it starts [bytes]; kept on Linux. None
    #: for no limit.
    memory: int | None = None
    #: Size of a reply [bytes]; the process is given up if it sends more. None for no limit.
    largest_reply: int | None = None


class WorkerProcess:
    """A process that answers one message at a time.

    ``service``: what it does. Raises TribodynError if no process can be started.
    """

    def __init__(self, service: Service) -> None:
        self._service = service
        self._sending = threading.Lock()
        self._start()

    def _start(self) -> None:
        self.connection, end = multiprocessing.Pipe()
        try:
            with end:
                self.process = fork_server.process(_serve, end, self._service)
        except EOFError:  # the fork server has ended
            raise TribodynError(UNREADY) from None
        except OSError as error:
            raise TribodynError(f"no worker process can be started: {error}") from None

    def send(self, message: bytes) -> None:
        """Send a message, from any thread; :meth:`receive` detects that the process is dead."""
        with self._sending, suppress(OSError):
            self.connection.send_bytes(message)

    def receive(self) -> bytes | None:
        """Return the next message of the process; None if it is dead or sends more than it may."""
        try:
            return self.connection.recv_bytes(self._service.largest_reply)
        except (EOFError, OSError):
            return None

    def restart(self) -> None:
        """Replace the process by a new one.

        Raises TribodynError if no process can be started.
        """
        self.end()
        self._start()

    def end(self) -> None:
        """Kill the process and wait until it has ended."""
        self.process.kill()
        self.process.join()
        self.connection.close()


def _serve(connection: Connection, service: Service) -> None:
    """Answer messages until the other end is closed."""
    # Ctrl-C is for the command, which ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fork_server.end_with_parent()
    if service.memory is not None:
        platforms.limit_memory(service.memory)
    if service.prepare is not None:
        service.prepare()
    with suppress(EOFError, OSError):
        while True:
            if (reply := service.answer(connection.recv_bytes(), connection)) is not None:
                connection.send_bytes(reply)
