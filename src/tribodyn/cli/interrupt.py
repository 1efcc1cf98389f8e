"""Ctrl-C, SIGTERM and SIGHUP: the first ends a run soon and saves it, the second leaves at once.

A signal may come between any two instructions. What its handler raised could get lost in a callback of the
interpreter, or come out of an import as another error. So it raises nothing. Where work is under way whose
results can be saved it leaves word with an :class:`Interruption`, which is asked several times a second;
else, and at the second signal, it ends the process there and then.
"""

import atexit
import os
import shutil
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from types import FrameType
from typing import Final, Self

from tribodyn.core.platforms import HANGUP

_SIGNALS: Final = (
    *(signal.SIGINT, signal.SIGTERM),
    # The end of the terminal; what was started with nohup ignores it, and goes on.
    *(number for number in HANGUP if signal.getsignal(number) is not signal.SIG_IGN),
)
_STANDARD_ERROR: Final = 2
_FAILED: Final = 1
_STOPPING: Final = "stopping, then saving and drawing; interrupt again to leave at once"


class Interruption:
    """Whether the user asked to stop, as a context manager.

    It listens from the first time it is asked: until then there is nothing to save.

    ``message``: shown to the user when a signal arrives.
    """

    def __init__(self, message: str = _STOPPING) -> None:
        self.requested = False
        self.listens = False
        self.message = message

    def __call__(self) -> bool:
        """Tell whether the user asked to stop."""
        self.listens = not self.requested
        return self.requested

    def __enter__(self) -> Self:
        _met.listener = self
        return self

    def __exit__(self, *_: object) -> None:
        _met.listener = None


@dataclass
class _Met:
    """Handling of a signal."""

    listener: Interruption | None = None  #: Whom to leave word with.
    #: Message and exit status where the process ends.
    last_words: str = "aborted; nothing was saved"
    status: int = _FAILED
    tidying: list[Callable[[], None]] = field(default_factory=list)  #: What is done before.


_met = _Met()


def hear_signals() -> None:
    """Let SIGINT and SIGTERM do from now on what this module says."""
    _set(_handle)


def hear_signals_to_the_end() -> None:
    """Do so in a process that is a command, until it is gone.

    Python puts the default back when it shuts down, which would kill a command that has done its work.
    """
    hear_signals()
    # What is registered first is called last.
    atexit.register(_set, signal.SIG_IGN)


def _set(handler: signal.Handlers | Callable[[int, FrameType | None], None]) -> None:
    for number in _SIGNALS:
        signal.signal(number, handler)


@contextmanager
def signals_heard() -> Iterator[None]:
    """Hear signals while a command runs; afterwards too, if this process has nothing else to do."""
    global _met
    handlers, met = {number: signal.getsignal(number) for number in _SIGNALS}, _met
    hear_signals()
    _met = _Met()
    try:
        yield
    finally:
        if any(handler is not _handle for handler in handlers.values()):
            _met = met
            for number, handler in handlers.items():
                signal.signal(number, handler)


def end(status: int) -> None:
    """Let a signal that comes after the work, while Python shuts down, change nothing."""
    _met.last_words, _met.status, _met.tidying = "", status, []


def on_leaving(action: Callable[[], None]) -> None:
    """Have something done before a signal ends the process; what was asked for last is done first."""
    _met.tidying.insert(0, action)


def last_words(text: str) -> None:
    """Show this to the user from now on, where a signal ends the process."""
    _met.last_words = text


def _handle(number: int, frame: FrameType | None) -> None:
    listener = _met.listener
    if listener is None or not listener.listens:
        _leave()
    else:
        listener.requested, listener.listens = True, False
        _tell(f"\ntribodyn: {listener.message}\n")


def _leave() -> None:
    """End the process."""
    # Should anything below hang, the next signal does what it does to any process.
    _set(signal.SIG_DFL)
    for action in (*_met.tidying, _forget_workers, sys.stdout.flush):
        with suppress(Exception):
            action()
    if _met.last_words:
        _tell(f"\ntribodyn: {_met.last_words}\n")
    os._exit(_met.status)


def _forget_workers() -> None:
    """Remove the folder that multiprocessing has for its workers, if it is in use."""
    if util := sys.modules.get("multiprocessing.util"):
        shutil.rmtree(util.get_temp_dir())


def _tell(text: str) -> None:
    """Write to stderr; not by print, for the signal may have come in the middle of one."""
    with suppress(OSError):
        os.write(_STANDARD_ERROR, text.encode(errors="backslashreplace"))
