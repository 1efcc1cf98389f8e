"""Workers that are real processes, with tasks from the standard library."""

import math
import os
import signal
import time
from collections.abc import Iterator

import pytest

from tribodyn.core import fork_server
from tribodyn.core.workers import DEATHS
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
    assert time.monotonic() - began < 5.0
    with started(1) as fresh:
        assert [answer for _, answer in answers(fresh, [Task(math.sqrt, (9.0,))], never)] == [3.0]


def test_workers_leave_ctrl_c_to_the_command(workers: list[SweepWorker]) -> None:
    (found,) = answers(workers[:1], [Task(signal.getsignal, (signal.SIGINT,))], never)
    assert found[1] == signal.SIG_IGN
