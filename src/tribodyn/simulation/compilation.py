"""Equations are compiled by processes of their own, which can be stopped.

Compilation takes minutes and cannot be interrupted inside a process. The process that asked for it loads the
machine code from the cache. Where there are two processors a second process compiles the functions of the
problem, while the first one compiles the core of the solver and what finds the start; none is compiled twice.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING, Any, Final, TypeVar

from tribodyn.cases.write import Choices, choices_of
from tribodyn.core.errors import Stopped
from tribodyn.core.platforms import processors
from tribodyn.core.stopping import ask

if TYPE_CHECKING:
    from tribodyn.cases.case import Case

Steps = Callable[[], Any]
_Result = TypeVar("_Result")

_CHILD: Final = (
    "from tribodyn.core.working_directory import ignore_settings; ignore_settings(); "
    "from tribodyn.simulation import compile_for_parent; compile_for_parent(ahead={})"
)
PROCESSES: Final = 2
"""Processes that compile the equations of a case, at most."""
_LISTEN: Final = 0.1
"""Time between two looks at whether to stop [s]."""
_loaded: Final[set[Choices]] = set()
"""Choices of the cases whose equations this process has loaded."""


class NotCompiled(Exception):
    """Something is not in numba's cache."""


@contextmanager
def loading_only() -> Iterator[None]:
    """Raise :class:`NotCompiled` where numba would compile."""
    from numba.core import event

    class NothingElse(event.Listener):
        def on_start(self, event: Any) -> None:
            raise NotCompiled

        def on_end(self, event: Any) -> None:
            """Never comes."""

    with event.install_listener("numba:compile", NothingElse()):
        yield


def loaded(case: Case, first_steps: Steps) -> bool:
    """Load the equations of a case; False if they are not compiled yet."""
    choices = choices_of(case)
    if choices not in _loaded:
        try:
            with loading_only():
                first_steps()
        except NotCompiled:
            return False
        except Stopped:
            raise
        except Exception:  # the run itself will say
            return True
        _loaded.add(choices)
    return True


def run_loaded(case: Case, run: Callable[[], _Result]) -> _Result:
    """Return the result of a run; where it would compile, another process compiles its equations first.

    Parameters
    ----------
    case
        The case.
    run
        Runs it. Where equations are not compiled it is broken off and called again: it must be repeatable.
    """
    choices = choices_of(case)
    if choices not in _loaded:
        try:
            with loading_only():
                result = run()
        except NotCompiled:
            compile_elsewhere(case)
        else:
            _loaded.add(choices)
            return result
    return run()


def compile_elsewhere(case: Case) -> None:
    """Have another process compile the equations of a case; where that fails, this one will do it.

    So it will where compiled code can be kept nowhere. However this process ends, the other one ends with it.

    Parameters
    ----------
    case
        The case.

    Raises
    ------
    Stopped
        If the caller wanted to stop before they were compiled.
    KeyboardInterrupt
        If the other process was interrupted, as by Ctrl-C, which reaches both.
    """
    from mebdf.compiled.cache import folder
    from tribodyn.kernels.jit import SOURCES

    if folder(SOURCES) is None:
        return
    with suppress(OSError), ExitStack() as stack:
        child, *helping = (
            stack.enter_context(_child(ahead=ahead))
            for ahead in (False, True)[: min(processors(), PROCESSES)]
        )
        for process in (child, *helping):
            assert process.stdin is not None
            process.stdin.write(json.dumps(case.to_toml()).encode() + b"\n")
            process.stdin.flush()
        while child.poll() is None:
            ask()
            with suppress(subprocess.TimeoutExpired):
                child.wait(_LISTEN)
        if child.returncode == -signal.SIGINT:
            raise KeyboardInterrupt


@contextmanager
def _child(*, ahead: bool) -> Iterator[subprocess.Popen[bytes]]:
    """Start a process that compiles, or that helps it ``ahead``; it has ended when the block has."""
    with subprocess.Popen(
        [sys.executable, "-P", "-c", _CHILD.format(ahead)],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as child:
        try:
            yield child
        finally:
            child.kill()


def from_parent() -> str:
    """Return the text of the case that the parent process wants compiled; from then on, end when it ends."""
    toml = str(json.loads(sys.stdin.buffer.readline()))
    threading.Thread(target=_end_with_parent, daemon=True).start()
    return toml


def _end_with_parent() -> None:
    # The parent writes nothing more: what comes is the end of the pipe, when it closes it or is gone.
    sys.stdin.buffer.read()
    os._exit(1)
