"""Limits of a process on this machine: processors and handles."""

from __future__ import annotations

import math
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

_QUOTA: Final = Path("/sys/fs/cgroup/cpu.max")
"""Files of Linux with a container's limits: time on all processors together, and its period [µs]."""


def processors() -> int:
    """Return on how many processors this process may run, as its affinity and its container say."""
    count = len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
    with suppress(OSError, ValueError):  # no container, or one without a limit
        used, period = map(int, _QUOTA.read_text(encoding="ascii").split())
        count = min(count, math.ceil(used / period))
    return max(count, 1)


def free_handles() -> int:
    """Return the number of further files, pipes and sockets that this process may open."""
    if sys.platform == "win32":
        return sys.maxsize
    import resource

    limit, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    if limit == resource.RLIM_INFINITY:
        return sys.maxsize
    # Looking takes one itself.
    return limit - len(os.listdir("/dev/fd")) + 1
