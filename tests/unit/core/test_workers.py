"""Worker processes, whatever they do."""

import platform
import sys
from multiprocessing.connection import Connection

import numpy as np
import pytest

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
