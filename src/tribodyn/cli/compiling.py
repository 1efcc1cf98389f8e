"""Telling the user about the compilation at the first run, which takes longer than many runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

_MESSAGE = "compiling the equations for this machine; later runs start at once"


@contextmanager
def announced_compilation(note: Callable[[str], None]) -> Iterator[None]:
    """Say so, once, when numba really compiles; functions read from its cache raise no event.

    Parameters
    ----------
    note
        Prints a line.
    """
    from numba.core import event

    class Announcement(event.Listener):
        told = False

        def on_start(self, event: Any) -> None:
            if not self.told:
                self.told = True
                note(_MESSAGE)

        def on_end(self, event: Any) -> None:
            """Nothing to say: progress follows."""

    with event.install_listener("numba:compile", Announcement()):
        yield
