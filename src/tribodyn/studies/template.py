"""The process that local workers are forked from: all is imported in it, and the equations are loaded.

A worker that begins from nothing takes seconds for that. Forked from this process it begins at once, and so
does the one that takes the place of a worker that died. It is the fork server of :mod:`multiprocessing`: it
has a single thread, which makes forking safe, and it ends with the process that started it. It imports this
module, which is when it prepares itself; :func:`start` says for which case. Only on Linux: Windows cannot
fork, and what macOS brings along does not survive it. There, workers begin from nothing.
"""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Final

METHOD: Final = "forkserver" if sys.platform == "linux" else "spawn"
"""How workers are started, as :mod:`multiprocessing` calls it."""
_CASE: Final = "TRIBODYN_TEMPLATE_CASE"
"""Environment variable with the text of the case whose equations the process loads."""


def start(toml: str, environment: Mapping[str, str]) -> None:
    """Start the process, unless there is one; return at once.

    Parameters
    ----------
    toml
        A case; others with the same equations profit too.
    environment
        Environment variables that workers need from their beginning.
    """
    if METHOD == "forkserver":
        from multiprocessing import forkserver

        multiprocessing.get_context(METHOD).set_forkserver_preload([__name__])
        with _set({**environment, _CASE: toml}):
            forkserver.ensure_running()


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


def _prepare(toml: str) -> None:
    """Import and load what workers need, in the process they are forked from."""
    # Ctrl-C is for the command, which ends its workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    import distributed.nanny  # noqa: F401

    from tribodyn.studies.work import load

    load(toml)
    # Objects that live for ever need not be searched for garbage in every worker.
    gc.freeze()


if _CASE in os.environ:
    _prepare(os.environ.pop(_CASE))
