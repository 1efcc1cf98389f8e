"""Points computed by processes of this machine.

A worker holds one end of a pair of sockets without a name, the sweep holds the other: nothing listens, so
there is nothing that another user could connect to. The fork server listens where only this user may look.
"""

from __future__ import annotations

import multiprocessing
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any, Final

from tribodyn.core import fork_server, machine
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.versions import version
from tribodyn.studies.job import LISTEN, Finished, Job, stop_while_preparing
from tribodyn.studies.plan import Point
from tribodyn.studies.work import compute, failed, import_what_points_need, warm_up

DEATHS: Final = 2
"""How many deaths of its worker a task survives: it is tried once more after each."""
LOST: Final = failed("its worker process died at every attempt", final=False)
"""What comes of a task whose worker died once more than that."""
_UNREADY: Final = (
    "worker processes die while they get ready: the memory may be short, or a script calls sweep outside of "
    '`if __name__ == "__main__":`'
)
_HANDLES: Final = 3
"""Handles that this process holds of a worker: the connection, and two to tell when either has ended."""
_OTHER_HANDLES: Final = 16
"""Those that starting a process and writing files take for a moment."""


def local(job: Job, workers: int | None) -> Finished:
    """Compute points in processes of this machine, one thread each.

    Parameters
    ----------
    job
        The points.
    workers
        How many processes; by default one for each processor.

    Raises
    ------
    InputError
        There are too few handles for a single process.
    TribodynError
        Processes die before they compute anything.
    """
    size = _affordable(min(workers or machine.processors(), len(job.points)), job.note)
    fork_server.start(toml=job.points[0].toml)
    own = version("tribodyn")
    with crew(size) as workforce:
        _prepare(workforce[0], job)
        tasks = [
            Task(compute, (point.toml, own, job.keep_result, job.staging), point) for point in job.points
        ]
        for task, outcome in answers(workforce, tasks, job.stop):
            assert task.point is not None
            yield task.point, outcome


def _affordable(workers: int, note: Callable[[str], None]) -> int:
    """Return how many workers there may be of so many, for each takes handles of this process."""
    free = machine.free_handles() - _OTHER_HANDLES
    room = free // _HANDLES
    if room < 1:
        raise InputError(
            f"the limit of open files (`ulimit -n`) is {_HANDLES - free} too low for one worker; allowed: a "
            "higher limit, or 0 workers: all in this process",
            key="--workers",
        )
    if room < workers:
        note(f"the limit of open files (`ulimit -n`) allows {room} of {workers} workers")
    return int(min(room, workers))


@dataclass
class Task:
    """What a worker is to do: a function of a module, and its arguments."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    point: Point | None = None
    deaths: int = 0


class Worker:
    """A process that does one task at a time."""

    def __init__(self) -> None:
        self._start()

    def _start(self) -> None:
        self.connection, end = multiprocessing.Pipe()
        try:
            with end:
                self.process = fork_server.process(serve, end)
        except EOFError:  # that is how the fork server ends, too
            raise TribodynError(_UNREADY) from None

    def give(self, task: Task) -> None:
        """Hand over a task; where the process is dead, the connection ends instead of giving an answer."""
        self.task = task
        with suppress(OSError):
            self.connection.send((task.function, task.arguments))

    def answer(self) -> Any:
        """Return what came of the task; if the process has died meanwhile, begin another one."""
        try:
            return self.connection.recv()
        except (EOFError, OSError):
            self.task.deaths += 1
            self.end()
            self._start()
            return LOST

    def end(self) -> None:
        """Kill the process."""
        self.process.kill()
        self.process.join()
        self.process.close()
        self.connection.close()


@contextmanager
def crew(size: int) -> Iterator[list[Worker]]:
    """Have so many workers while the block runs."""
    with ExitStack() as stack:
        workers = []
        for _ in range(size):
            workers.append(Worker())
            stack.callback(workers[-1].end)
        yield workers


def _prepare(worker: Worker, job: Job) -> None:
    """Let one worker fill the cache of compiled code, from which the others read it."""
    task = Task(warm_up, (job.points[0].toml,))
    for _, answer in answers([worker], [task], stop_while_preparing(job)):
        if answer is LOST:
            raise TribodynError(_UNREADY)


def answers(
    workers: Sequence[Worker], tasks: Iterable[Task], stop: Callable[[], bool]
) -> Iterator[tuple[Task, Any]]:
    """Yield tasks and what came of them as they are done.

    Parameters
    ----------
    workers
        Who does them, one at a time each.
    tasks
        What is to be done, begun in this order.
    stop
        Asked several times a second; when true, what has arrived is still yielded.
    """
    waiting = deque(tasks)
    busy: dict[Any, Worker] = {}

    def employ(worker: Worker) -> None:
        if waiting:
            worker.give(waiting.popleft())
            busy[worker.connection] = worker

    for worker in workers:
        employ(worker)
    stopping = False
    while busy and not stopping:
        stopping = stop()
        for connection in wait(list(busy), 0.0 if stopping else LISTEN):
            worker = busy.pop(connection)
            task, answer = worker.task, worker.answer()
            if again := answer is LOST and task.deaths <= DEATHS:
                waiting.appendleft(task)
            if not stopping:
                employ(worker)
            if not again:
                yield task, answer


def serve(connection: Connection) -> None:
    """Do what a worker is told, until nobody tells any more.

    Parameters
    ----------
    connection
        Gives functions and their arguments, and takes what they return.
    """
    # Ctrl-C is for the command, which ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fork_server.end_with_parent()
    import_what_points_need()
    with suppress(EOFError, OSError):
        while True:
            function, arguments = connection.recv()
            connection.send(function(*arguments))
