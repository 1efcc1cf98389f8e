"""The workers as the server sees them: what somebody waits for goes first, then what was asked first."""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import threading
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Final

from tribodyn.core import fork_server
from tribodyn.workbench.visitor import Budget
from tribodyn.workbench.worker import EVENT, FAILURE, GIVEN_UP, RESULT, STOP, Limits, serve

DEATHS: Final = 2
"""How many deaths of its worker a job survives: it is done once more after each."""
_PATIENCE: Final = 2.0
"""Time that a worker has to give up before it is killed [s]."""


class Failed(Exception):
    """A job came to nothing; the message says why."""


class GivenUp(Exception):
    """A job was stopped by who asked for it."""


@dataclass(eq=False)
class Job:
    """One thing for a worker to do.

    Attributes
    ----------
    order
        What is sent: ``work`` and ``case``, and what that work takes.
    seconds
        Time that it may take.
    background
        Whether nobody waits for it.
    heard
        Called with what a worker tells on the way.
    budget
        Of who asked for it.
    """

    order: Mapping[str, Any]
    seconds: float
    background: bool = False
    heard: Callable[[Mapping[str, Any]], None] = lambda event: None
    budget: Budget = field(default_factory=Budget)
    answer: asyncio.Future[bytes] = field(init=False)
    deaths: int = 0
    took: float = 0.0
    """How long the worker was busy with it at last [s]."""
    verdict: Exception | None = None
    """Why it was stopped."""

    def __post_init__(self) -> None:
        self.answer = asyncio.get_running_loop().create_future()

    def settle(self, outcome: bytes | Exception) -> None:
        """Answer, unless that was done."""
        if self.answer.done():
            return
        if isinstance(outcome, bytes):
            self.answer.set_result(outcome)
        else:
            self.answer.set_exception(outcome)
            self.answer.exception()  # whoever asked may have gone


class Worker:
    """A process that does one job at a time, begun again whenever it dies."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self.job: Job | None = None
        self._sending = threading.Lock()
        self._start()

    def _start(self) -> None:
        self.connection, end = multiprocessing.Pipe()
        with end:
            self.process = fork_server.process(serve, end, self.limits)

    def end(self) -> None:
        """Kill the process."""
        self.process.kill()
        self.process.join()
        self.connection.close()

    def begin_again(self) -> None:
        """Put a new process in the place of one that died."""
        self.end()
        self._start()

    def order(self, job: Job) -> bytes | None:
        """Do a job and return the answer with its letter; None if the process died."""
        try:
            self._send(json.dumps(job.order).encode())
            while (answer := self._received())[:1] == EVENT:
                job.answer.get_loop().call_soon_threadsafe(job.heard, json.loads(answer[1:]))
        except (EOFError, OSError):
            return None
        return answer

    def _received(self) -> bytes:
        return self.connection.recv_bytes(self.limits.result + 1)

    def stop(self) -> None:
        """Tell the process to give up."""
        with suppress(OSError):
            self._send(STOP)

    def _send(self, message: bytes) -> None:
        with self._sending:
            self.connection.send_bytes(message)


class Crew:
    """A fixed number of workers and what waits for them.

    Of what is waited for, that of whoever took least of the workers lately is done first; then what came
    first.

    Parameters
    ----------
    size
        How many processes.
    limits
        What each may take.
    each
        How many of the processes one who asks may have at a time; all by default.
    """

    def __init__(self, size: int, limits: Limits, each: int | None = None) -> None:
        self.size, self.limits, self.each = size, limits, each or size
        self.waiting: deque[Job] = deque()
        self.later: deque[Job] = deque()
        self.workers: list[Worker] = []
        self._tasks: list[asyncio.Task[None]] = []
        self._woken = asyncio.Condition()
        self._threads = ThreadPoolExecutor(size, thread_name_prefix="crew")

    async def start(self) -> None:
        """Start the processes."""
        loop = asyncio.get_running_loop()
        for _ in range(self.size):
            worker = await loop.run_in_executor(self._threads, Worker, self.limits)
            self.workers.append(worker)
            self._tasks.append(asyncio.create_task(self._work(worker)))

    async def end(self) -> None:
        """Kill the processes; what is under way or waits is given up."""
        for task in self._tasks:
            task.cancel()
        for worker in self.workers:
            worker.process.kill()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self._threads.shutdown()
        for worker in self.workers:
            worker.end()
        for job in (*self.waiting, *self.later, *(worker.job for worker in self.workers)):
            if job is not None:
                job.settle(GivenUp())

    async def do(self, job: Job) -> bytes:
        """Return what a job comes to.

        Raises
        ------
        Failed
            It came to nothing.
        GivenUp
            It was stopped.
        """
        async with self._woken:
            (self.later if job.background else self.waiting).append(job)
            self._make_room()
            self._woken.notify_all()
        return await job.answer

    def _make_room(self) -> None:
        """Postpone what nobody waits for where it keeps all workers from what somebody does."""
        postponable = [worker for worker in self.workers if worker.job is None or worker.job.background]
        if self.waiting and postponable and all(worker.job is not None for worker in postponable):
            postponable[0].stop()

    def stop(self, job: Job, verdict: Exception | None = None) -> None:
        """Give a job up; a worker that does not listen is killed."""
        job.verdict = verdict or GivenUp()
        for queue in (self.waiting, self.later):
            if job in queue:
                queue.remove(job)
                job.settle(job.verdict)
        for worker in self.workers:
            if worker.job is job:
                worker.stop()
                asyncio.get_running_loop().call_later(_PATIENCE, self._kill, worker, job)

    def _kill(self, worker: Worker, job: Job) -> None:
        if worker.job is job:
            worker.process.kill()

    @property
    def idle(self) -> bool:
        """Whether nobody waits for anything."""
        return not self.waiting and all(
            worker.job is None or worker.job.background for worker in self.workers
        )

    def _next(self) -> Job | None:
        """Return what is to be done next; one worker is kept free of what nobody waits for."""
        busy = [worker.job for worker in self.workers if worker.job is not None]
        budgets = [id(job.budget) for job in busy]
        if able := [job for job in self.waiting if budgets.count(id(job.budget)) < self.each]:
            # Looked at once for each: what was taken counts less with every moment.
            taken = {id(budget): budget.taken for budget in (job.budget for job in able)}
            chosen = min(able, key=lambda job: taken[id(job.budget)])
            self.waiting.remove(chosen)
            return chosen
        if self.later and self.idle and len(busy) < max(1, self.size - 1):
            return self.later.popleft()
        return None

    async def _work(self, worker: Worker) -> None:
        while True:
            async with self._woken:
                while (job := self._next()) is None:
                    await self._woken.wait()
                worker.job = job
            await self._watched(worker, job)
            async with self._woken:
                worker.job = None
                self._woken.notify_all()

    async def _watched(self, worker: Worker, job: Job) -> None:
        """Have a job done within its time, again if the worker dies over it."""
        loop = asyncio.get_running_loop()
        reason = Failed(f"stopped after {job.seconds:g} s, the most that a run may take here")
        late = loop.call_later(job.seconds, self.stop, job, reason)
        try:
            while not job.answer.done():
                began = loop.time()
                answer = await loop.run_in_executor(self._threads, worker.order, job)
                job.took = loop.time() - began
                job.budget.charge(job.took)
                if answer is None:
                    job.deaths += 1
                    await self._replaced(worker, job)
                elif answer == GIVEN_UP and job.verdict is None:
                    self.later.appendleft(job)
                    return
                self._judge(job, answer)
        finally:
            late.cancel()

    async def _replaced(self, worker: Worker, job: Job) -> None:
        """Put a new process in the place of one that died over a job."""
        try:
            await asyncio.get_running_loop().run_in_executor(self._threads, worker.begin_again)
        except (EOFError, OSError):
            job.settle(Failed("no worker process can be started; the memory may be short"))

    def _judge(self, job: Job, answer: bytes | None) -> None:
        """Settle a job by what its worker says; by nothing, if it is to be done once more."""
        if job.verdict is not None:
            job.settle(job.verdict)
        elif answer is None:
            if job.deaths > DEATHS:
                job.settle(Failed("the worker process died at every attempt"))
        elif answer[:1] == RESULT:
            job.settle(answer[1:])
        elif answer[:1] == FAILURE:
            job.settle(Failed(answer[1:].decode("utf-8", "replace")))
