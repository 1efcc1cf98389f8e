"""How far a run has come: a bar on a terminal, a line every tenth elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from contextlib import AbstractContextManager
from types import TracebackType
from typing import Final, Protocol

from tribodyn.cli.console import Console, is_terminal

_PARTS: Final = 10
_BAR: Final = "{percentage:3.0f}%|{bar}| {n:.2f} of {total:.2f} s simulated [{elapsed}, {remaining} to go]"


class Progress(AbstractContextManager["Progress"], Protocol):
    """Called with the simulated time [s]; also prints notes without spoiling a bar."""

    def __call__(self, reached: float, /) -> None:
        """Show that the simulation has reached a time [s]."""

    def note(self, text: str, /) -> None:
        """Print a line about the work."""


class Lines:
    """Progress as plain lines, for logs and pipes."""

    def __init__(self, total: float, console: Console) -> None:
        self._total = total
        self._console = console
        self._shown = 0
        self._began = time.monotonic()

    def __enter__(self) -> Lines:
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the lines as they are."""

    def __call__(self, reached: float) -> None:
        """Print a line when another tenth is complete."""
        part = int(_PARTS * (reached / self._total + 1e-9))
        if part > self._shown:
            self._shown = part
            elapsed = time.monotonic() - self._began
            share = 100 * part // _PARTS
            self.note(
                f"{share:3d} %  {reached:.4g} of {self._total:.4g} s simulated, {elapsed:.0f} s elapsed"
            )

    def note(self, text: str) -> None:
        """Print a line about the work."""
        self._console.note(text)


class Bar:
    """Progress as a bar that is redrawn in place; it appears with the first step."""

    def __init__(self, total: float, console: Console) -> None:
        from tqdm import tqdm

        self._console = console
        self._write = tqdm.write
        # Not tqdm's own measure: 0 by 0 where a terminal does not tell its size, and then no bar is drawn.
        columns, rows = shutil.get_terminal_size()
        self._bar = tqdm(
            total=total, bar_format=_BAR, file=sys.stderr, leave=False, delay=1e-3, ncols=columns, nrows=rows
        )

    def __enter__(self) -> Bar:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.close()

    def __call__(self, reached: float) -> None:
        """Move the bar."""
        self._bar.update(reached - self._bar.n)

    def note(self, text: str) -> None:
        """Print a line above the bar."""
        if not self._console.quiet:
            self._write(text, file=sys.stderr)


def progress(total: float, console: Console) -> Progress:
    """Return what shows progress here.

    Parameters
    ----------
    total
        Simulated time at the end [s].
    console
        When quiet, nothing is shown.
    """
    if console.quiet or not is_terminal(sys.stderr):
        return Lines(total, console)
    return Bar(total, console)
