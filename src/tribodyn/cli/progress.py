"""Progress of a run: a bar on a terminal, a line every tenth elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from contextlib import AbstractContextManager
from dataclasses import dataclass
from types import TracebackType
from typing import Final, Protocol

from tribodyn.cli.console import Console, is_terminal
from tribodyn.core.quoting import without_controls

_PARTS: Final = 10


@dataclass(frozen=True)
class Measure:
    """Counted quantity.

    Attributes
    ----------
    bar
        How far the work is, for a bar (fields ``n`` and ``total``).
    line
        The same for a line (fields ``reached`` and ``total``).
    """

    bar: str
    line: str


SIMULATED: Final = Measure("{n:.2f} of {total:.2f} s simulated", "{reached:.4g} of {total:.4g} s simulated")
CYCLES: Final = Measure(
    "{n:.0f} of {total:.0f} cycles of wear", "{reached:.0f} of {total:.0f} cycles of wear"
)
POINTS: Final = Measure("{n:.0f} of {total:.0f} points", "{reached:.0f} of {total:.0f} points")


class Progress(AbstractContextManager["Progress"], Protocol):
    """Called with how far the work is; also prints notes without spoiling a bar."""

    def __call__(self, reached: float, /) -> None:
        """Show that the work has come so far."""

    def note(self, text: str, /) -> None:
        """Print a line about the work."""


class ProgressLines:
    """Progress as plain lines, for logs and pipes."""

    def __init__(self, total: float, console: Console, measure: Measure) -> None:
        self._total = total
        self._measure = measure
        self._console = console
        self._shown = 0
        self._began = time.monotonic()

    def __enter__(self) -> ProgressLines:
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the lines as they are."""

    def __call__(self, reached: float) -> None:
        """Print a line when another tenth is complete."""
        part = int(_PARTS * (reached / self._total + 1e-9))
        if part > self._shown:
            self._shown = part
            elapsed = time.monotonic() - self._began
            left = elapsed * max(self._total / reached - 1.0, 0.0)
            done = self._measure.line.format(reached=reached, total=self._total)
            share = 100 * part // _PARTS
            self.note(f"{share:3d} %  {done}, {elapsed:.0f} s elapsed, about {left:.0f} s to go")

    def note(self, text: str) -> None:
        """Print a line about the work."""
        self._console.note(text)


class Bar:
    """Progress as a bar that is redrawn in place; it appears with the first step."""

    def __init__(self, total: float, console: Console, measure: Measure) -> None:
        from tqdm import tqdm

        self._console = console
        self._write = tqdm.write
        # Not tqdm's own measure: 0 by 0 where a terminal does not report its size, and then no bar is drawn.
        columns, rows = shutil.get_terminal_size()
        self._bar = tqdm(
            total=total,
            bar_format=f"{{percentage:3.0f}}%|{{bar}}| {measure.bar} [{{elapsed}}, {{remaining}} to go]",
            file=sys.stderr,
            leave=False,
            delay=1e-3,
            ncols=columns,
            nrows=rows,
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
            self._write(without_controls(text), file=sys.stderr)


def progress(total: float, console: Console, measure: Measure = SIMULATED) -> Progress:
    """Return the right display of progress.

    Parameters
    ----------
    total
        How far the work goes: by default the simulated time at the end [s].
    console
        When quiet, nothing is shown.
    measure
        What is counted.
    """
    if console.quiet or not is_terminal(sys.stderr):
        return ProgressLines(total, console, measure)
    return Bar(total, console, measure)
