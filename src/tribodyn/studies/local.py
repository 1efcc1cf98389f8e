"""Points computed by worker processes of this machine, see :mod:`tribodyn.core.workers`."""

import pickle
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any, Final

from tribodyn.core import fork_server, platforms
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.platforms import version
from tribodyn.core.workers import DEATHS, DIED, UNREADY, Service, WorkerProcess
from tribodyn.studies.plan import Point
from tribodyn.studies.work import (
    LISTEN,
    Finished,
    SweepJob,
    blocks_of,
    compute,
    failed,
    import_what_points_need,
    stop_while_preparing,
)

LOST: Final = failed(DIED, final=False)  #: Outcome of a task whose worker died at every attempt.
#: Handles of this process for a worker: the connection, and two that detect the end of either process.
_HANDLES: Final = 3
_OTHER_HANDLES: Final = 16  #: Handles that starting a process and writing files take temporarily.


def local(job: SweepJob, workers: int | None) -> Finished:
    """Compute points in processes of this machine, one thread each.

    ``workers``: how many processes; by default one for each processor. Raises InputError if there are too few
    handles for a single process; TribodynError if processes die before they compute anything.
    """
    size = _affordable(min(workers or platforms.processors(), len(job.points)), job.note)
    fork_server.start(toml=job.points[0].toml or job.case.to_toml())

    def task_of(block: Sequence[Point]) -> Task:
        changes = [point.changes for point in block]
        return Task(compute, (job.case, changes, version("tribodyn"), job.keep_result, job.staging), block)

    with started(size) as workforce:
        _prepare(workforce[0], job)
        lost: list[Point] = []
        for task, outcomes in answers(
            workforce, map(task_of, blocks_of(job.case, job.points, size)), job.stop
        ):
            if outcomes is LOST and len(task.points) > 1:
                lost += task.points
            else:
                yield from zip(task.points, [LOST] if outcomes is LOST else outcomes, strict=True)
        # One of a block may have killed the worker of all.
        for task, outcomes in answers(workforce, [task_of([point]) for point in lost], job.stop):
            yield task.points[0], LOST if outcomes is LOST else outcomes[0]


def _affordable(workers: int, note: Callable[[str], None]) -> int:
    """Return the largest number of workers among so many, for each takes handles of this process."""
    free = platforms.free_handles() - _OTHER_HANDLES
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
    """Call of a worker: a function of a module, and its arguments."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    points: Sequence[Point] = ()
    deaths: int = 0


class SweepWorker(WorkerProcess):
    """A worker process that calls functions; tasks and what they return are pickled."""

    def __init__(self) -> None:
        super().__init__(Service(_called, import_what_points_need))

    def give(self, task: Task) -> None:
        """Hand over a task."""
        self.task = task
        self.send(pickle.dumps((task.function, task.arguments)))

    def answer(self) -> Any:
        """Return the result of the task; if the process has died, start another one and return ``LOST``."""
        if (reply := self.receive()) is not None:
            return pickle.loads(reply)
        self.task.deaths += 1
        self.restart()
        return LOST


def _called(message: bytes, connection: Connection) -> bytes:
    """Call the function of a task in the worker process."""
    function, arguments = pickle.loads(message)
    return pickle.dumps(function(*arguments))


@contextmanager
def started(size: int) -> Iterator[list[SweepWorker]]:
    """Provide this many workers; they are killed at the end of the block."""
    with ExitStack() as stack:
        workers = []
        for _ in range(size):
            workers.append(SweepWorker())
            stack.callback(workers[-1].end)
        yield workers


def _prepare(worker: SweepWorker, job: SweepJob) -> None:
    """See whether a worker can work."""
    task = Task(import_what_points_need, ())
    if any(answer is LOST for _, answer in answers([worker], [task], stop_while_preparing(job))):
        raise TribodynError(UNREADY)


def answers(
    workers: Sequence[SweepWorker], tasks: Iterable[Task], stop: Callable[[], bool]
) -> Iterator[tuple[Task, Any]]:
    """Yield tasks and what came of them as they are done.

    ``workers``: who does them, one at a time each; ``tasks``: what is to be done, begun in this order;
    ``stop``: asked several times a second; when true, what has arrived is still yielded.
    """
    waiting = deque(tasks)
    busy: dict[Any, SweepWorker] = {}

    def employ(worker: SweepWorker) -> None:
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
