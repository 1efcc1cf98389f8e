"""Output of commands: results on stdout; remarks, progress and a log of the work on stderr."""

import contextlib
import logging
import os
import platform
import shlex
import shutil
import sys
import time
import warnings
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Final, Protocol, Self, TextIO

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, on_one_line, without_controls


@dataclass(frozen=True)
class Console:
    """Destinations of messages."""

    quiet: bool = False  #: Whether nothing but errors and warnings is printed.
    json: bool = False  #: Whether stdout belongs to one JSON document.

    @classmethod
    def of(cls, args: Namespace) -> Self:
        """Return the console that the options ask for."""
        return cls(quiet=args.quiet, json=args.json)

    def say(self, text: str) -> None:
        """Print the result."""
        printed(text)
        if not (self.quiet or self.json):
            print(without_controls(text))

    def note(self, text: str) -> None:
        """Print the progress of the work."""
        printed(text)
        if not self.quiet:
            _on_stderr(without_controls(text))


def escape_warnings() -> None:
    """Print warnings of libraries, which may quote any title, without characters that move a cursor."""

    def show(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
        _on_stderr(without_controls(f"{category.__name__}: {message}"))

    warnings.showwarning = show


def show_json(document: Any) -> None:
    """Print one JSON document on stdout."""
    import json

    print(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False))


def complain(text: str) -> None:
    """Print one error or warning on stderr, on one line, whatever it quotes."""
    printed(text)
    _on_stderr(f"tribodyn: {on_one_line(text)}")


def _on_stderr(text: str) -> None:
    try:
        print(text, file=sys.stderr, flush=True)
    except OSError:
        # Nothing can be printed; what was done, and the exit status, stay. Python would try again at its end,
        # and make the status its own.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def forgive_encodings() -> None:
    """Let streams that cannot show a character show its code instead of failing; none may be closed."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  # until the end
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="backslashreplace")


def silence_matplotlib() -> None:
    """Keep Matplotlib from telling where it puts its own files when the home folder cannot be written to.

    It takes a private temporary folder then, and removes it.
    """
    import logging

    logging.getLogger("matplotlib").setLevel(logging.ERROR)


def is_terminal(stream: TextIO) -> bool:
    """Tell whether a person watches the stream."""
    with contextlib.suppress(ValueError, AttributeError):
        return stream.isatty()
    return False


_PARTS: Final = 10


@dataclass(frozen=True)
class Measure:
    """Counted quantity."""

    bar: str  #: How far the work is, for a bar (fields ``n`` and ``total``).
    line: str  #: The same for a line (fields ``reached`` and ``total``).


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

    def __enter__(self) -> Self:
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

    def __enter__(self) -> Self:
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

    ``total``: how far the work goes: by default the simulated time at the end [s]; ``console``: when quiet,
    nothing is shown; ``measure``: what is counted.
    """
    if console.quiet or not is_terminal(sys.stderr):
        return ProgressLines(total, console, measure)
    return Bar(total, console, measure)


LOGGER: Final = logging.getLogger("tribodyn")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the options of every command that are about its log."""
    parser.add_argument("-v", "--verbose", action="store_true", help="say what is done and how long it takes")
    parser.add_argument("--log", metavar="FILE", help="add what is done, printed and refused to this file")


@contextmanager
def logged(args: Namespace, arguments: Sequence[str]) -> Iterator[None]:
    """Keep a log as the options of a command ask for it."""
    handlers = list(_handlers(args))
    LOGGER.setLevel(logging.DEBUG if handlers else logging.CRITICAL)
    LOGGER.propagate = False
    for handler in handlers:
        LOGGER.addHandler(handler)
    began = time.perf_counter()
    try:
        if handlers:
            import tribodyn

            LOGGER.debug("tribodyn %s", shlex.join(arguments))
            about = (tribodyn.__version__, platform.python_version(), platform.platform())
            LOGGER.debug("version %s, Python %s, %s", *about)
        yield
    finally:
        LOGGER.debug("%.2f s in all", time.perf_counter() - began)
        for handler in handlers:
            LOGGER.removeHandler(handler)
            handler.close()


def _handlers(args: Namespace) -> Iterator[logging.Handler]:
    if args.verbose:
        shown = logging.StreamHandler(sys.stderr)
        # The rest is printed as it is.
        shown.addFilter(lambda record: record.levelno == logging.DEBUG)
        yield shown
    if args.log is not None:
        try:
            file = _LogFile(args.log)
        except OSError as error:
            raise InputError(f"{as_given(args.log)}: {error.strerror}", key="--log") from None
        file.setFormatter(logging.Formatter("%(asctime)s %(message)s"))
        yield file


class _LogFile(logging.FileHandler):
    """A log file whose loss, as on a full disk, is reported once and ends nothing."""

    def __init__(self, path: str) -> None:
        super().__init__(path, encoding="utf-8")
        self._lost = False

    def handleError(self, record: logging.LogRecord) -> None:
        """Report that the file cannot be written."""
        if not self._lost:
            self._lost = True
            print(f"tribodyn: --log: {on_one_line(self.baseFilename)} cannot be written", file=sys.stderr)

    def close(self) -> None:
        """Close the file."""
        with suppress(OSError):
            super().close()


@contextmanager
def stage(name: str) -> Iterator[None]:
    """Log the time of a part of the work."""
    began = time.perf_counter()
    yield
    LOGGER.debug("%s: %.2f s", name, time.perf_counter() - began)


def printed(text: str) -> None:
    """Log printed text."""
    LOGGER.info("%s", on_one_line(text))
