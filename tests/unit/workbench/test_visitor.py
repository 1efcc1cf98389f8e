"""What one visitor may take of the server, and that the others notice nothing of it."""

from __future__ import annotations

import asyncio
import difflib
import threading
import time

import pytest
from tests.unit.workbench.host import Pretending, hosting, in_loop
from tests.unit.workbench.test_sessions import admitted, opened

from tribodyn.core.errors import MOST_HINTS, InputError
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.workbench.sessions import Sessions
from tribodyn.workbench.variant import Origin
from tribodyn.workbench.visitor import Budget, Visitor
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import Job, WorkerPool


def test_of_many_unknown_keys_the_meaning_of_few_is_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[str] = []
    found = difflib.get_close_matches

    def counted(word: str, words: list[str], **more: float) -> list[str]:
        looked.append(word)
        return found(word, words, **more)

    monkeypatch.setattr(difflib, "get_close_matches", counted)
    origin = Origin(load_case("vsv"), "vsv")
    with pytest.raises(InputError, match="unknown key"):
        origin.varied({f"joint.{k:03d}clearance": "1" for k in range(200)})
    assert 0 < len(looked) <= 2 * MOST_HINTS
    looked.clear()
    with pytest.raises(InputError, match="unknown key"):
        origin.varied({"joint.clearance" * 100: "1"})
    assert looked == []


def test_a_page_waits_for_no_other_whose_case_takes_long_to_read(monkeypatch: pytest.MonkeyPatch) -> None:
    varied, begun, done = Origin.varied, threading.Event(), threading.Event()

    def slow(origin: Origin, values: dict[str, str]) -> object:
        if values.get("title") == "slow":
            begun.set()
            assert done.wait(20.0)
        return varied(origin, values)

    @in_loop
    async def test() -> None:
        async with hosting(Pretending(), sessions=Sessions(10**6)) as host:
            hog = await opened(host, *await admitted(host))
            other = await opened(host, *await admitted(host))
            await asyncio.wait_for(host.state.ready.wait(), 20.0)
            for kind in ("run", "sweep", "slope"):
                begun.clear()
                done.clear()
                more = {"key": "joint.clearance", "from": "20 um", "to": "40 um"} if kind == "sweep" else {}
                more |= {"key": "joint.clearance"} if kind == "slope" else {}
                await hog.say(kind, number=1, values={"title": "slow"}, **more)
                await asyncio.to_thread(begun.wait, 20.0)
                await other.run(2, {"joint.clearance": f"{30 + len(kind)} um"}, rest=True)
                assert (await other.picture()).number == 2, "before the first one is read"
                done.set()

    monkeypatch.setattr(Origin, "varied", slow)
    test()


@in_loop
async def test_a_visitor_has_one_case_read_at_a_time_and_pauses_as_long_as_it_took() -> None:
    visitor, at_once, most = Visitor(0), 0, 0

    def work() -> None:
        nonlocal at_once, most
        at_once += 1
        most = max(most, at_once)
        time.sleep(0.05)
        at_once -= 1

    began = time.monotonic()
    waiting = [asyncio.ensure_future(visitor.read(work)) for _ in range(4)]
    await asyncio.sleep(0.01)
    # Whoever leaves does not get another go sooner.
    waiting[0].cancel()
    await asyncio.gather(*waiting[1:])
    assert most == 1
    assert time.monotonic() - began > 7 * 0.05


def test_who_took_least_of_the_workers_is_served_first() -> None:
    async def test() -> None:
        pool = WorkerPool(3, Limits(), each=2)
        heavy, light = Budget(), Budget()
        heavy.charge(60.0)
        jobs = [
            Job({"work": name}, 1.0, budget=who) for name, who in (("a", heavy), ("b", heavy), ("c", light))
        ]
        pool.waiting.extend(jobs)
        assert [pool._next() for _ in jobs] == [jobs[2], jobs[0], jobs[1]]
        pool._threads.shutdown()

    asyncio.run(test())


def test_one_visitor_never_has_all_workers() -> None:
    class Busy:
        def __init__(self, job: Job | None) -> None:
            self.job = job

    async def test() -> None:
        pool = WorkerPool(3, Limits(), each=2)
        heavy, light = Budget(), Budget()
        pool.workers = [Busy(Job({}, 1.0, budget=heavy)), Busy(Job({}, 1.0, budget=heavy)), Busy(None)]  # type: ignore[list-item]
        pool.waiting.append(Job({}, 1.0, budget=heavy))
        assert pool._next() is None
        pool.waiting.append(other := Job({}, 1.0, budget=light))
        assert pool._next() is other
        pool._threads.shutdown()

    asyncio.run(test())


def test_what_was_taken_long_ago_counts_less() -> None:
    budget = Budget(_seconds=8.0, _since=time.monotonic() - 120.0)
    assert budget.taken == pytest.approx(2.0, rel=1e-3)
    budget.charge(1.0)
    assert budget.taken == pytest.approx(3.0, rel=1e-3)
