"""Log of a command's work with times: on stderr with ``-v``, and in a file with ``--log``.

The file holds all that was printed, too, a line each, after its time.
"""

import logging
import platform
import shlex
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Final

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, on_one_line

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
