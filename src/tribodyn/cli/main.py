"""Entry of the command ``tribodyn``."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from collections.abc import Sequence
from typing import Any, Final, NoReturn, Protocol

from tribodyn.cli import bounce, cases, check, compare, report, reproduce, run, show, surface, sweep
from tribodyn.cli.console import complain, forgive_encodings, silence_matplotlib
from tribodyn.cli.interrupt import end, signals_heard
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.quoting import LONGEST, brief

DONE, FAILED, BAD_INPUT = 0, 1, 2


class Command(Protocol):
    """A module that is one sub-command."""

    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser, /) -> None:
        """Declare what follows the name of the command."""

    def execute(self, args: argparse.Namespace, /) -> int:
        """Do it and return the exit status."""


COMMANDS: Final[dict[str, Command]] = {
    "run": run,
    "cases": cases,
    "show": show,
    "check": check,
    "sweep": sweep,
    "report": report,
    "compare": compare,
    "reproduce": reproduce,
    "surface": surface,
    "bounce": bounce,
}
"""All sub-commands: a new one is a module beside this one and a line here."""

_EPILOG: Final = """\
examples:
  tribodyn run vsv
  tribodyn run vsv --set joint.clearance="25 um" -o wide
  tribodyn show vsv > mine.toml && tribodyn run mine.toml
  tribodyn sweep vsv --vary joint.clearance="20 um:40 um:5 um" --vary mechanism.formulation=exact,paper

exit status: 0 done; 1 the run failed, what was computed is saved; 2 bad input, nothing is written
"""


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line, like all others."""

    def error(self, message: str) -> NoReturn:
        complain(f"{brief(message, 2 * LONGEST)}; see `{self.prog} --help`")
        raise SystemExit(BAD_INPUT)


class _Version(argparse.Action):
    """Print the version; it is looked up only here because that takes time."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any, **__: Any) -> None:
        import tribodyn

        print(f"tribodyn {tribodyn.__version__}")
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="tribodyn",
        description="Tribo-dynamics of mechanisms with dry, rough, worn clearance joints.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, command in COMMANDS.items():
        below = commands.add_parser(name, help=command.HELP, description=command.HELP, allow_abbrev=False)
        command.add_arguments(below)
        below.add_argument("--quiet", action="store_true", help="print errors and warnings only")
        below.add_argument("--json", action="store_true", help="print the outcome as JSON on stdout")
        below.add_argument("--debug", action="store_true", help="show where in the program an error arose")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments
        What follows ``tribodyn``; by default that of this process.

    Returns
    -------
    int
        Exit status: 0 done, 1 failed, 2 bad input.
    """
    with signals_heard():
        forgive_encodings()
        silence_matplotlib()
        status = _executed(_parser().parse_args(arguments))
        end(status)
    return status


def _executed(args: argparse.Namespace) -> int:
    """Execute a command; say what went wrong."""
    try:
        return COMMANDS[args.command].execute(args)
    except BrokenPipeError:
        # Whoever read our output has gone; there is nobody left to tell.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except (Exception, KeyboardInterrupt) as error:
        if args.debug:
            traceback.print_exc()
        complain(_in_words(error))
        return BAD_INPUT if isinstance(error, InputError) else FAILED


def _in_words(error: BaseException) -> str:
    """Return what a user needs to know of an error."""
    if isinstance(error, TribodynError):
        return str(error)
    if isinstance(error, KeyboardInterrupt):
        return "aborted; nothing was saved"
    if isinstance(error, OSError):
        return f"writing or reading failed: {brief(error, 2 * LONGEST)}"
    if isinstance(error, MemoryError):
        return "there is not enough memory for this run"
    return f"internal error, please report it: {type(error).__name__}: {error} (--debug shows where it arose)"
