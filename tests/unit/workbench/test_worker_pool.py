"""Workers that are real processes: what becomes of a run when its worker dies, hangs, or takes too much."""

import asyncio
import os
import signal
import sys
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any

import psutil
import pytest
from tests.unit.workbench.host import SOON, own_loop

from tribodyn.core import fork_server
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.workbench import messages
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import Failed, GivenUp, Job, WorkerPool

SHORT = load_case("vsv").replace({"run.duration": "0.3 s"})
LONG = load_case("vsv").replace({"run.cycles": "200"})
EFFORT = {"wall_time_s", "real_time_factor"}
Test = Callable[[Callable[[WorkerPool], Coroutine[Any, Any, None]]], None]


def job(case=SHORT, seconds=SOON, **more):
    return Job({"work": "picture", "case": case.to_toml(), "header": {"run": "x"}}, seconds, **more)


@contextmanager
def worker_pool(**limits: int) -> Iterator[Test]:
    """Have one worker, and what runs tests with it."""
    fork_server.start(name="vsv")
    with own_loop() as run:
        made = WorkerPool(1, Limits(**limits))
        run(made.start())
        yield lambda test: run(test(made))
        (pid,) = (worker.process.pid for worker in made.workers)
        run(made.end())
    assert not psutil.pid_exists(pid)


@pytest.fixture(scope="module")
def with_pool() -> Iterator[Test]:
    with worker_pool() as run:
        yield run


async def at_work(made: WorkerPool) -> int:
    """Wait until the worker is at it, and return its process."""
    while made.workers[0].job is None:
        await asyncio.sleep(0.01)
    await asyncio.sleep(0.3)
    pid = made.workers[0].process.pid
    assert pid is not None
    return pid


def numbers(content: bytes) -> dict[str, Any]:
    """Return what a frame shows, without what the run took."""
    header = messages.header(content)
    return {"sections": header["sections"]} | {k: v for k, v in header["results"].items() if k not in EFFORT}


def test_a_worker_killed_in_mid_run_goes_unnoticed_but_for_the_time(with_pool: Test) -> None:
    async def test(made: WorkerPool) -> None:
        first = await made.do(job())
        again = asyncio.create_task(made.do(job(LONG.replace({"run.cycles": "12"}))))
        victim = await at_work(made)
        os.kill(victim, signal.SIGKILL)
        assert messages.header(await again)["failure"] == ""
        assert made.workers[0].process.pid != victim
        # The same case is the same frame from any worker.
        assert numbers(await made.do(job())) == numbers(first)

    with_pool(test)


def test_a_run_that_takes_too_long_is_stopped_and_one_that_hangs_is_killed(with_pool: Test) -> None:
    async def test(made: WorkerPool) -> None:
        with pytest.raises(Failed, match=r"stopped after 0\.5 s"):
            await made.do(job(LONG, seconds=0.5))
        long = job(LONG)
        waiting = asyncio.create_task(made.do(long))
        hung = await at_work(made)
        os.kill(hung, signal.SIGSTOP)
        made.stop(long)
        with pytest.raises(GivenUp):
            await waiting
        await made.do(job())
        assert made.workers[0].process.pid != hung

    with_pool(test)


def test_what_nobody_waits_for_makes_room_and_is_done_later(with_pool: Test) -> None:
    async def test(made: WorkerPool) -> None:
        later = asyncio.create_task(made.do(job(LONG.replace({"run.cycles": "12"}), background=True)))
        await at_work(made)
        assert await made.do(job())
        assert not later.done()
        assert messages.header(await later)["failure"] == ""

    with_pool(test)


def test_what_is_too_large_or_wrong_is_told_in_words() -> None:
    async def test(made: WorkerPool) -> None:
        with pytest.raises(Failed, match=r"larger than 0\.001 MB"):
            await made.do(job())
        with pytest.raises(Failed, match="not valid TOML"):
            await made.do(Job({"work": "picture", "case": "?", "header": {}}, SOON))
        if sys.platform == "linux":
            # 1,200,000 rows of some sixty numbers.
            rows = {"run.output_interval": "1 us", "run.duration": "1.2 s"}
            with pytest.raises(Failed, match="more memory than a worker may have"):
                await made.do(job(load_case("vsv").replace(rows)))

    # Modules that a worker imports for its first job count, too.
    with worker_pool(memory=400_000_000, result=1000) as run:
        run(test)
