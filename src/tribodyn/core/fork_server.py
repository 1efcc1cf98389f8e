"""The fork server of :mod:`multiprocessing`: a process that prepares itself and that others are forked from.

A process that begins from nothing takes seconds to import and load what it needs. Forked from a process that
has done so it begins at once. The server has a single thread, which makes forking safe, and it ends with the
process that started it. Only on Linux: Windows cannot fork, and what macOS brings along does not survive it.
There, processes begin from nothing.

This module imports nothing of weight, so that a command can start the server before all else.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.platforms import METHOD, start_context, uninterrupted

if TYPE_CHECKING:
    from multiprocessing.process import BaseProcess

# The threads of a worker would only take time from the other workers. Without the safe path these processes
# would import modules from the working directory, where a file may have the name of any module.
# What a case frees, the next one needs again: returned to the system it costs a page fault for every 4 kB.
#: Environment variables that the processes need from their beginning.
ENVIRONMENT: Final = {
    name: "1"
    for name in (
        *("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
        "PYTHONSAFEPATH",
    )
} | {"MALLOC_MMAP_THRESHOLD_": str(32 << 20), "MALLOC_TRIM_THRESHOLD_": str(64 << 20)}
#: Modules that the server imports: names, for they are of higher layers. The first one ignores settings.
_MODULES: Final = ("tribodyn.__main__", "tribodyn.studies.template")
_CASE: Final = "TRIBODYN_FORK_SERVER_CASE"  #: Environment variable with what :func:`start` is given, as JSON.
#: Length that fits into an environment variable of Linux. For a longer case the server prepares nothing.
_LONGEST: Final = 100_000


def start(*, name: str = "", toml: str = "", changes: Mapping[str, str] = MappingProxyType({})) -> None:
    """Start the server, unless there is one; return at once.

    ``name``, ``toml``: the case to be prepared for, or one with the same equations: a file or a built-in one,
    or its text; ``changes``: values to change in it, by dotted path.
    """
    if METHOD == "forkserver":
        from multiprocessing import forkserver, resource_tracker

        with _set(ENVIRONMENT):
            # Which the server would start, and which lets signals through again when it has begun.
            resource_tracker.ensure_running()
        given = json.dumps({"name": name, "toml": toml, "changes": dict(changes)})
        forkserver.set_forkserver_preload([*_MODULES])
        with _set(ENVIRONMENT | ({_CASE: given} if len(given) < _LONGEST else {})), uninterrupted():
            forkserver.ensure_running()


def take_case() -> dict[str, Any] | None:
    """Return the server's argument from :func:`start`; None to other processes, and at a second call."""
    given = os.environ.pop(_CASE, None)
    return None if given is None else dict(json.loads(given))


def process(function: Callable[..., None], *arguments: Any) -> BaseProcess:
    """Start a process that ends with this one, by the server where there can be one.

    ``function``, ``arguments``: what it calls: a function of a module, and what that is given.
    """
    made = start_context().Process(target=function, args=arguments, daemon=True)
    with _set(ENVIRONMENT):
        made.start()
    return made


def end_with_parent() -> None:
    """Let this process end when the one that started it has ended, whatever it is doing then."""
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


@contextmanager
def _set(variables: Mapping[str, str]) -> Iterator[None]:
    """Set environment variables for a while."""
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
