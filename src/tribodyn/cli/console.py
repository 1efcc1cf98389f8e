"""Output of commands: results on stdout, everything about the work on stderr."""

from __future__ import annotations

import contextlib
import os
import sys
import warnings
from argparse import Namespace
from dataclasses import dataclass
from typing import Any, TextIO

from tribodyn.cli.log import printed
from tribodyn.core.quoting import on_one_line, without_controls


@dataclass(frozen=True)
class Console:
    """Destinations of messages.

    Attributes
    ----------
    quiet
        Whether nothing but errors and warnings is printed.
    json
        Whether stdout belongs to one JSON document.
    """

    quiet: bool = False
    json: bool = False

    @classmethod
    def of(cls, args: Namespace) -> Console:
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
