"""Processes: memory, processors, servers that fork, versions of packages."""

import os
import platform
import sys
from multiprocessing.connection import Connection

import numpy as np
import pytest

from tribodyn.core import fork_server, platforms
from tribodyn.core.workers import Service, WorkerProcess


def faults_of_arrays(message: bytes, connection: Connection) -> bytes:
    """Fill arrays as large as those of a run and give them up; return how many page faults this took."""
    import resource

    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    arrays = [np.full(1_000_000, 1.0) for _ in range(5)]
    del arrays
    return str(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before).encode()


@pytest.mark.skipif(
    sys.platform != "linux" or platform.libc_ver()[0] != "glibc", reason="another memory allocator"
)
def test_memory_that_a_task_gave_up_is_there_for_the_next_one() -> None:
    worker = WorkerProcess(Service(faults_of_arrays))
    try:
        faults = []
        for _ in range(3):
            worker.send(b"")
            reply = worker.receive()
            assert reply is not None
            faults.append(int(reply))
    finally:
        worker.end()
    # 40 MB are 9,800 pages of 4 kB.
    assert faults[-1] < 1000


@pytest.mark.parametrize(
    ("said", "allowed"),
    [("max 100000", 8), ("nonsense", 8), ("1000 100000", 1), ("250000 100000", 3), ("900000 100000", 8)],
)
def test_a_container_may_use_less_than_the_machine_has(said, allowed, monkeypatch, tmp_path):
    monkeypatch.setattr("os.sched_getaffinity", lambda _: range(8), raising=False)
    monkeypatch.setattr("os.cpu_count", lambda: 8)
    quota = tmp_path / "cpu.max"
    monkeypatch.setattr(platforms, "_QUOTA", quota)
    assert platforms.processors() == 8
    quota.write_text(f"{said}\n", encoding="ascii")
    assert platforms.processors() == allowed


def test_where_processes_cannot_be_forked_nothing_is_started(monkeypatch: pytest.MonkeyPatch) -> None:
    def never() -> None:
        raise AssertionError

    monkeypatch.setattr(fork_server, "METHOD", "spawn")
    monkeypatch.setattr("multiprocessing.forkserver.ensure_running", never)
    fork_server.start(name="vsv")
    assert fork_server._CASE not in os.environ


def test_the_case_is_taken_once_and_found_by_nobody_else(monkeypatch: pytest.MonkeyPatch) -> None:
    assert fork_server.take_case() is None
    monkeypatch.setenv(fork_server._CASE, '{"name": "vsv"}')
    assert fork_server.take_case() == {"name": "vsv"}
    assert fork_server.take_case() is None


def test_an_error_that_nobody_foresaw_is_to_be_reported() -> None:
    assert platforms.unexpected(KeyError("a")) == "internal error, please report it: KeyError: 'a'"


@pytest.mark.parametrize(
    ("required", "said"),
    [
        ("numpy>=99", '"numpy>=99"; install that one'),
        ("no-such-package", 'no no-such-package is installed, tribodyn needs "no-such-package"'),
        ("numpy>=99; sys_platform == 'elsewhere'", ""),
        ("numpy>=99; extra == 'all'", ""),
        ("numpy>=1", ""),
    ],
)
def test_packages_that_are_too_old_are_named_instead(monkeypatch, required, said):
    monkeypatch.setattr("importlib.metadata.requires", lambda name: [required])
    message = platforms.unexpected(AttributeError("trapezoid"))
    assert said in message
    assert message.startswith("internal error") == (not said)
