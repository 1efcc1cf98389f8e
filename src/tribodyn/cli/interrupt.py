"""Ctrl-C and SIGTERM: the first ends a run after the step under way and saves it, the second aborts."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Final

_SIGNALS: Final = (signal.SIGINT, signal.SIGTERM)
_STANDARD_ERROR: Final = 2
_MESSAGE: Final = b"\ntribodyn: stopping after the step under way, then saving; interrupt again to abort\n"


class Interruption:
    """Whether the user asked to stop, as a context manager that listens while it is open.

    Parameters
    ----------
    message
        Written to stderr when the user asks.
    """

    def __init__(self, message: bytes = _MESSAGE) -> None:
        self.requested = False
        self._message = message
        self._previous: dict[signal.Signals, Any] = {}

    def __call__(self) -> bool:
        """Tell whether the user asked to stop."""
        return self.requested

    def __enter__(self) -> Interruption:
        self._previous = {number: signal.signal(number, self._handle) for number in _SIGNALS}
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True
        # Not print: the signal may have come in the middle of one.
        os.write(_STANDARD_ERROR, self._message)


@contextmanager
def termination_as_interrupt() -> Iterator[None]:
    """Let SIGTERM raise ``KeyboardInterrupt``, as Ctrl-C does."""

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    previous = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, previous)
