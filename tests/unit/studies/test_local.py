"""Processes of a sweep on this machine, and what a worker does with a point."""

import json
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

import psutil
import pytest

from tribodyn.core import fork_server
from tribodyn.core.workers import DEATHS
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.studies import work
from tribodyn.studies.local import LOST, SweepWorker, Task, answers, started


@pytest.fixture(scope="module")
def workers() -> Iterator[list[SweepWorker]]:
    fork_server.start()
    with started(2) as made:
        yield made


def never() -> bool:
    return False


def test_a_task_that_kills_its_workers_is_lost_and_the_others_are_done(workers: list[SweepWorker]) -> None:
    deadly = Task(signal.raise_signal, (signal.SIGKILL,))
    others = [Task(math.sqrt, (float(number),)) for number in range(4)]
    found = [(task, answer) for task, answer in answers(workers, [deadly, *others], never)]
    assert [answer for task, answer in found if task is deadly] == [LOST]
    assert deadly.deaths == DEATHS + 1
    assert "worker process died" in LOST.failure
    assert not LOST.final
    assert sorted(answer for task, answer in found if task is not deadly) == [math.sqrt(n) for n in range(4)]


def test_a_task_is_tried_again_when_its_worker_dies_by_chance(workers: list[SweepWorker]) -> None:
    task = Task(time.sleep, (0.5,))
    killed = []

    def kill_once() -> bool:
        if not killed:
            killed.append(workers[0].process.pid)
            os.kill(killed[0], signal.SIGKILL)
        return False

    assert list(answers(workers[:1], [task], kill_once)) == [(task, None)]
    assert task.deaths == 1


def test_a_stop_is_heard_at_once_and_keeps_what_has_arrived(workers: list[SweepWorker]) -> None:
    began = time.monotonic()

    def stop() -> bool:
        # By then the first answer waits to be read.
        time.sleep(0.5)
        return True

    tasks = [Task(math.sqrt, (4.0,)), Task(time.sleep, (60.0,)), Task(math.sqrt, (9.0,))]
    assert [answer for _, answer in answers(workers, tasks, stop)] == [2.0]
    assert time.monotonic() - began < 30.0
    with started(1) as fresh:
        assert [answer for _, answer in answers(fresh, [Task(math.sqrt, (9.0,))], never)] == [3.0]


def test_workers_leave_ctrl_c_to_the_command(workers: list[SweepWorker]) -> None:
    (found,) = answers(workers[:1], [Task(signal.getsignal, (signal.SIGINT,))], never)
    assert found[1] == signal.SIG_IGN


CASE = load_case("vsv")


def computed(*more: Any, made_by: str = "", clearance: str = "20 um") -> work.PointOutcome:
    """Compute one point."""
    (found,) = work.compute(CASE, [{"joint.clearance": clearance}], made_by or version("tribodyn"), *more)
    return found


def test_another_version_computes_nothing_and_that_is_not_final(simulated: list[Any]) -> None:
    outcome = computed(True, made_by="99")
    assert "the sweep was planned by 99" in outcome.failure
    assert not outcome.final
    assert simulated == []


def test_lack_of_memory_is_the_fault_of_the_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    def exhausted(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(work, "_simulated", exhausted)
    assert not computed(True).final


TOML = load_case("vsv").to_toml()
# In a process of its own: the fork server of this one may have been started by another test.
ASKED = """
import json, os, sys

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.core import fork_server


def tell() -> None:
    from tribodyn.kernels.vsv.functions import rhs

    about = {"threads": os.environ["OMP_NUM_THREADS"], "loaded": rhs._listed is not None}
    print(json.dumps(about | {"left": fork_server._CASE in os.environ}))


if __name__ == "__main__":
    before = dict(os.environ)
    fork_server.start(**json.loads(sys.argv[1]))
    assert dict(os.environ) == before
    fork_server.process(tell).join()
    assert dict(os.environ) == before
"""


@pytest.mark.skipif(fork_server.METHOD != "forkserver", reason="workers begin from nothing here")
@pytest.mark.parametrize(
    "given",
    [{"toml": TOML}, {"name": "vsv", "changes": {"solver.name": "mebdf", "joint.clearance": "31 um"}}],
)
def test_a_worker_has_the_equations_from_its_birth(given: dict[str, object], tmp_path: Path) -> None:
    (script := tmp_path / "asked.py").write_text(ASKED, encoding="utf-8")
    asked = [sys.executable, str(script), json.dumps(given)]
    done = subprocess.run(asked, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {"threads": "1", "loaded": True, "left": False}


def test_a_worker_that_died_between_tasks_is_replaced(workers: list[SweepWorker]) -> None:
    victim = workers[0].process
    victim.kill()
    victim.join()
    (answer,) = answers(workers[:1], [Task(os.getpid, ())], never)
    assert answer[1] == workers[0].process.pid


def test_workers_are_gone_with_the_block() -> None:
    with started(2) as made:
        pids = [worker.process.pid for worker in made]
        assert all(psutil.pid_exists(pid) for pid in pids)
    assert not any(psutil.pid_exists(pid) for pid in pids)
