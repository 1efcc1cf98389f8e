"""What happens before the first picture."""

from __future__ import annotations

import pytest
from tests.unit.workbench.host import Pretending, hosting, in_loop

from tribodyn.core import fork_server
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import Failed, Job, WorkerPool


class Noting(Pretending):
    """A pool that remembers what was asked for."""

    def __init__(self, **options: bool) -> None:
        super().__init__(**options)
        self.asked: list[str] = []

    async def do(self, job: Job) -> bytes:
        self.asked.append(str(job.order["work"]))
        return await super().do(job)


class Slow(Pretending):
    """A pool whose runs are stopped after ten seconds, a twentieth of the way."""

    async def do(self, job: Job) -> bytes:
        if job.order["work"] != "picture":
            return await super().do(job)
        job.on_event({"reached": 0.05 * 4.0 * 3.141592653589793})
        job.took, job.verdict = 10.0, Failed("stopped")
        raise job.verdict


@in_loop
async def test_what_a_long_case_takes_is_known_without_running_it_to_its_end() -> None:
    async with hosting(Slow()) as host:
        page = await host.greeted()
        await page.run(1, {"joint.clearance": "30 um"}, rest=True)
        assert (await page.until("ask"))["seconds"] == pytest.approx(200.0, rel=1e-6)


@in_loop
async def test_a_case_that_fails_says_so_and_the_page_stays() -> None:
    class Failing(Pretending):
        async def do(self, job: Job) -> bytes:
            if job.order["work"] == "picture" and not job.order["header"]["values"]:
                raise Failed("the start cannot be found")
            return await super().do(job)

    async with hosting(Failing()) as host:
        page = await host.greeted()
        while (await page.until("state"))["state"] != "failed":
            pass
        await page.run(1, {"joint.clearance": "30 um"}, rest=True)
        assert (await page.picture()).number == 1


def test_workers_that_cannot_be_started_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    def dead(*_: object) -> None:
        raise EOFError

    @in_loop
    async def test() -> None:
        async with hosting(WorkerPool(1, Limits())) as host:
            page = await host.open()
            while (found := await page.until("state"))["state"] == "loading":
                pass
            assert found["state"] == "failed"
            assert "worker processes die while they get ready" in found["message"]

    monkeypatch.setattr(fork_server, "process", dead)
    test()
