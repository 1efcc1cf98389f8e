"""Worker pool of the server: runs that a person waits for come first, then the order of requests."""

import asyncio
import json
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Final

from tribodyn.core.errors import TribodynError
from tribodyn.core.workers import DEATHS, DIED, Service, WorkerProcess
from tribodyn.workbench.work import EVENT, FAILURE, GIVEN_UP, RESULT, STOP, Limits, reply

_PATIENCE: Final = 2.0  #: Time that a worker has to stop before it is killed [s].


class Failed(Exception):
    """A job has no result; the message says why."""


class GivenUp(Exception):
    """A job was stopped by the page that requested it."""


@dataclass(eq=False)
class Job:
    """One task for a worker."""

    order: Mapping[str, Any]  #: What is sent: ``work`` and ``case``, and what that work takes.
    seconds: float  #: Time that it may take.
    background: bool = False  #: Whether nobody waits for it.
    #: Called with the progress that a worker reports.
    on_event: Callable[[Mapping[str, Any]], None] = lambda event: None
    answer: asyncio.Future[bytes] = field(init=False)
    deaths: int = 0
    took: float = 0.0  #: Time that the worker needed at the last attempt [s].
    verdict: Exception | None = None  #: Why it was stopped.

    def __post_init__(self) -> None:
        self.answer = asyncio.get_running_loop().create_future()

    def settle(self, outcome: bytes | Exception) -> None:
        """Set the answer, unless there is one."""
        if self.answer.done():
            return
        if isinstance(outcome, bytes):
            self.answer.set_result(outcome)
        else:
            self.answer.set_exception(outcome)
            self.answer.exception()  # whoever requested it may have gone


class PoolWorker(WorkerProcess):
    """A worker process that makes frames and files of cases.

    ``limits``: what it may take.
    """

    def __init__(self, limits: Limits) -> None:
        self.job: Job | None = None
        # A reply begins with a letter.
        super().__init__(
            Service(partial(reply, limits), memory=limits.memory, largest_reply=limits.result + 1)
        )

    def do(self, job: Job) -> bytes | None:
        """Return the reply to a job, which begins with a letter; None if the process died."""
        self.send(json.dumps(job.order).encode())
        while (answer := self.receive()) is not None and answer[:1] == EVENT:
            job.answer.get_loop().call_soon_threadsafe(job.on_event, json.loads(answer[1:]))
        return answer

    def stop(self) -> None:
        """Ask the process to stop the job that is under way."""
        self.send(STOP)


class WorkerPool:
    """A fixed number of workers and the jobs that wait for them.

    ``size``: number of processes; ``limits``: what each may take.
    """

    def __init__(self, size: int, limits: Limits) -> None:
        self.size, self.limits = size, limits
        self.waiting: deque[Job] = deque()
        self.later: deque[Job] = deque()
        self.workers: list[PoolWorker] = []
        self._tasks: list[asyncio.Task[None]] = []
        self._woken = asyncio.Condition()
        self._threads = ThreadPoolExecutor(size, thread_name_prefix="pool")

    async def start(self) -> None:
        """Start the processes.

        Raises TribodynError if a process cannot be started.
        """
        loop = asyncio.get_running_loop()
        for _ in range(self.size):
            worker = await loop.run_in_executor(self._threads, PoolWorker, self.limits)
            self.workers.append(worker)
            self._tasks.append(asyncio.create_task(self._work(worker)))

    async def end(self) -> None:
        """Kill the processes; all jobs are given up."""
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
        """Return the result of a job.

        Raises Failed if it has none; GivenUp if it was stopped.
        """
        async with self._woken:
            (self.later if job.background else self.waiting).append(job)
            self._make_room()
            self._woken.notify_all()
        return await job.answer

    def _make_room(self) -> None:
        """Postpone a background job if no worker is free for a job that a person waits for."""
        postponable = [worker for worker in self.workers if worker.job is None or worker.job.background]
        if self.waiting and postponable and all(worker.job is not None for worker in postponable):
            postponable[0].stop()

    def stop(self, job: Job, verdict: Exception | None = None) -> None:
        """Give up a job; a worker that does not stop in time is killed."""
        job.verdict = verdict or GivenUp()
        for queue in (self.waiting, self.later):
            if job in queue:
                queue.remove(job)
                job.settle(job.verdict)
        for worker in self.workers:
            if worker.job is job:
                worker.stop()
                asyncio.get_running_loop().call_later(_PATIENCE, self._kill, worker, job)

    def _kill(self, worker: PoolWorker, job: Job) -> None:
        if worker.job is job:
            worker.process.kill()

    @property
    def idle(self) -> bool:
        """Whether nobody waits for a job."""
        return not self.waiting and all(
            worker.job is None or worker.job.background for worker in self.workers
        )

    def _next(self) -> Job | None:
        """Return the next job; one worker is kept free of background jobs."""
        if self.waiting:
            return self.waiting.popleft()
        busy = sum(worker.job is not None for worker in self.workers)
        if self.later and self.idle and busy < max(1, self.size - 1):
            return self.later.popleft()
        return None

    async def _work(self, worker: PoolWorker) -> None:
        while True:
            async with self._woken:
                while (job := self._next()) is None:
                    await self._woken.wait()
                worker.job = job
            await self._attempt(worker, job)
            async with self._woken:
                worker.job = None
                self._woken.notify_all()

    async def _attempt(self, worker: PoolWorker, job: Job) -> None:
        """Have a job done within its time, and repeat it if the worker dies."""
        loop = asyncio.get_running_loop()
        reason = Failed(f"stopped after {job.seconds:g} s, the most that a run may take here")
        late = loop.call_later(job.seconds, self.stop, job, reason)
        try:
            while not job.answer.done():
                began = loop.time()
                answer = await loop.run_in_executor(self._threads, worker.do, job)
                job.took = loop.time() - began
                if answer is None:
                    job.deaths += 1
                    await self._restart(worker, job)
                elif answer == GIVEN_UP and job.verdict is None:
                    self.later.appendleft(job)
                    return
                self._judge(job, answer)
        finally:
            late.cancel()

    async def _restart(self, worker: PoolWorker, job: Job) -> None:
        """Replace the process of a worker that died during a job."""
        try:
            await asyncio.get_running_loop().run_in_executor(self._threads, worker.restart)
        except TribodynError as error:
            job.settle(Failed(str(error)))

    def _judge(self, job: Job, answer: bytes | None) -> None:
        """Settle a job by the reply of its worker; leave it open if it is repeated."""
        if job.verdict is not None:
            job.settle(job.verdict)
        elif answer is None:
            if job.deaths > DEATHS:
                job.settle(Failed(DIED))
        elif answer[:1] == RESULT:
            job.settle(answer[1:])
        elif answer[:1] == FAILURE:
            job.settle(Failed(answer[1:].decode("utf-8", "replace")))
