"""Differences between operating systems, and versions of packages and of Python.

Linux is what the tests run on. Windows and macOS are run as if: a test takes from Python what they lack.
"""

from __future__ import annotations

import math
import os
import platform
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext


# In Python 3.11.0 other users can talk to the server (CVE-2022-42919).
#: Start method of processes, as :mod:`multiprocessing` calls it; libraries of macOS do not survive a fork.
METHOD: Final = "forkserver" if sys.platform == "linux" and sys.version_info >= (3, 11, 1) else "spawn"
FORKS: Final = sys.platform == "linux"  #: Whether a process may be forked from one with libraries loaded.
#: Whether browsers take every name in ``.localhost`` for this machine; on macOS they ask the system.
KNOWS_LOCAL_NAMES: Final = sys.platform != "darwin"
HANGUP: Final = () if sys.platform == "win32" else (signal.SIGHUP,)  #: Signals at the end of a terminal.
#: File of Linux with a container's limits: time on all processors together, and its period [µs].
_QUOTA: Final = Path("/sys/fs/cgroup/cpu.max")
_MOST_MEMORY: Final = Path("/sys/fs/cgroup/memory.max")  #: File of Linux with a container's memory [B].
_LOCK: Final = ".lock"  #: File that is locked where folders cannot be.
#: Parameter of ``mallopt``: the size from which a block comes from the system and goes back there.
_MMAP_THRESHOLD: Final = -3
_LARGE: Final = 131_072  #: The size that glibc begins with [bytes].


def processors() -> int:
    """Return on how many processors this process may run, as its affinity and its container say."""
    count = len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
    with suppress(OSError, ValueError):  # no container, or one without a limit
        used, period = map(int, _QUOTA.read_text(encoding="ascii").split())
        count = min(count, math.ceil(used / period))
    return max(count, 1)


def memory() -> float:
    """Return the memory of this machine, or of its container [B]; infinite where the system does not say."""
    if sys.platform == "win32":
        return math.inf
    size = float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    with suppress(OSError, ValueError):  # no container, or one without a limit
        size = min(size, int(_MOST_MEMORY.read_text(encoding="ascii")))
    return size


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


def limit_memory(more: int) -> None:
    """Let the address space of this process grow by so many bytes and no further, where the system can."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + more
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or most < hard:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def give_back_large_blocks() -> None:
    """Have every large block of this process taken from the system, and given back when it is free.

    glibc raises this size to that of the largest block that was ever freed. From then on pictures share its
    heap, where those of other sizes do not fit into the gaps that forgotten ones leave: of 100 MB that are
    kept it made 190 MB. Elsewhere than with glibc nothing is done.
    """
    if sys.platform == "linux":
        import ctypes

        with suppress(AttributeError, OSError):
            ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, _LARGE)


def give_back_memory() -> None:
    """Have glibc give the system back what is free; it keeps most of what many small arrays took."""
    if sys.platform == "linux":
        import ctypes

        with suppress(OSError, AttributeError):  # another C library has no such function
            ctypes.CDLL(None).malloc_trim(0)


def start_context() -> ForkServerContext | SpawnContext:
    """Return the way in which processes start."""
    import multiprocessing

    if METHOD == "forkserver":
        return multiprocessing.get_context("forkserver")
    return multiprocessing.get_context("spawn")


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold back Ctrl-C, which is for the command: a process started meanwhile never hears it."""
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def flush_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk, where folders can be opened."""
    if sys.platform == "win32":
        return
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


@contextmanager
def locked(folder: Path) -> Iterator[bool | None]:
    """Lock a folder while the block runs; a killed process keeps nobody out.

    Yields
    ------
    bool or None
        Whether this process has it: False when another one does, None where the file system has no locks.
    """
    if sys.platform != "win32":
        handle = os.open(folder, os.O_RDONLY)
    else:
        try:
            # Removed by the system when it is closed, and refused while another process removes it.
            handle = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | getattr(os, "O_TEMPORARY", 0))
        except PermissionError:
            yield False
            return
    try:
        yield _lock(handle)
    finally:
        os.close(handle)


def _lock(handle: int) -> bool | None:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        return None
    return True


_PACKAGES: Final = ("tribodyn", "numpy", "scipy")


# Looked up in files each time, which takes as long as some of what asks for it.
@cache
def version(package: str) -> str:
    """Return the version of an installed package."""
    from importlib import metadata  # which `--help` does without

    return metadata.version(package)


def provenance() -> dict[str, str]:
    """Return the versions of Python and of the packages that made the numbers."""
    versions = {f"{name}_version": version(name) for name in _PACKAGES}
    return versions | {"python_version": platform.python_version()}


def unexpected(error: BaseException) -> str:
    """Return words for an error that nobody foresaw, or for packages with versions that are too old."""
    from importlib import metadata

    fault = f"internal error, please report it: {type(error).__name__}: {error}"
    return "; ".join(_not_as_declared(metadata.requires("tribodyn") or ())) or fault


def _not_as_declared(requirements: Iterable[str]) -> Iterator[str]:
    """Yield a sentence for each package that is not installed as required."""
    from importlib import metadata

    from packaging.requirements import Requirement  # where something failed, and nowhere else

    for needed in map(Requirement, requirements):
        if needed.marker is None or needed.marker.evaluate({"extra": ""}):
            installed = next((each.version for each in metadata.distributions(name=needed.name)), None)
            if installed is None or not needed.specifier.contains(installed, prereleases=True):
                there = f"{needed.name} {installed}" if installed else f"no {needed.name}"
                yield f'{there} is installed, tribodyn needs "{needed}"; install that one'
