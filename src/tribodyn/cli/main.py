"""Entry of the command ``tribodyn``."""

import argparse
import importlib
import os
import re
import sys
import traceback
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final, NoReturn, Protocol, cast

from tribodyn.cli import console
from tribodyn.cli.commands import completion
from tribodyn.cli.console import complain, forgive_encodings, show_json, silence_matplotlib
from tribodyn.cli.interrupt import end, signals_heard
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.quoting import LONGEST, as_given, brief, closest

DONE, FAILED, BAD_INPUT = 0, 1, 2


class Command(Protocol):
    """A module that is one sub-command."""

    HELP: str
    EXAMPLE: str  #: End of its help.

    def add_arguments(self, parser: argparse.ArgumentParser, /) -> None:
        """Declare the arguments after the name of the command."""

    def execute(self, args: argparse.Namespace, /) -> int:
        """Do it and return the exit status."""


class _Modules(Mapping[str, Command]):
    """Modules in ``commands``, each imported when it is first asked for."""

    def __init__(self, *names: str) -> None:
        self._names = names

    def __getitem__(self, name: str) -> Command:
        if name not in self._names:
            raise KeyError(name)
        return cast(Command, importlib.import_module(f"tribodyn.cli.commands.{name}"))

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


#: All sub-commands: a new one is a module in ``commands`` and a name here.
COMMANDS: Final = _Modules(
    *(
        "run",
        "cases",
        "new",
        "show",
        "check",
        "sweep",
        "find",
        "slopes",
        "allocate",
        "builds",
        "contributions",
        "fit",
        "workbench",
    ),
    *("report", "export", "compare", "reproduce", "validate", "surface", "materials", "stribeck"),
    "bounce",
    "completion",
)

_EPILOG: Final = """\
examples:
  tribodyn run slider-crank
  tribodyn run slider-crank --set joints.wrist.clearance.radial="25 um" -o wide
  tribodyn new slider-crank mine.toml && tribodyn run mine.toml
  tribodyn sweep slider-crank --vary joints.wrist.clearance.radial="20 um:40 um:5 um"

exit status: 0 done; 1 the run failed, what was computed is saved; 2 bad input, nothing is written
"""


#: Likeness of a command to one that was probably meant, at least: "rum" for "run", but no other verb.
_NEAR_COMMAND: Final = 0.65
_NEAR: Final = 0.7  #: Likeness of an option to one that was probably meant, at least.


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are errors like all others."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{brief(message, 2 * LONGEST)}; see `{self.prog} --help`")

    def understood(self, arguments: Sequence[str]) -> argparse.Namespace:
        """Return the parsed arguments, or raise their error, with a suggestion."""
        name = next((argument for argument in arguments if not argument.startswith("-")), None)
        if name is not None and name not in COMMANDS:
            near = "--help" if name == "help" else closest(name, COMMANDS, cutoff=_NEAR_COMMAND)
            hint = f"; did you mean `tribodyn {near}`?" if near else ""
            raise InputError(f"{as_given(name)}; allowed: {', '.join(COMMANDS)}{hint}", key="COMMAND")
        args, unknown = self.parse_known_args(arguments)
        if unknown:
            self._refuse(unknown, args.parser)
        return args

    def _refuse(self, unknown: Sequence[str], below: argparse.ArgumentParser) -> NoReturn:
        """Complain about arguments that a command does not have."""
        options = re.findall(r"--[a-z][a-z-]*", below.format_help())
        first = unknown[0].partition("=")[0]
        near = closest(first, options, cutoff=_NEAR)
        hint = "; values of the case are changed by --set PATH=VALUE" if "--set" in options else ""
        if near:
            hint = f"; {near} follows the command" if near == first else f"; did you mean {near}?"
        elif hint and not first.startswith("-"):
            hint = "; the command takes one case, and PATH=VALUE follows --set"
        below.error(f"unrecognized arguments: {brief(' '.join(unknown))}{hint}")


class _Version(argparse.Action):
    """Print the version; it is looked up only here because that takes time."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any, **__: Any) -> None:
        import tribodyn

        print(f"tribodyn {tribodyn.__version__}")
        parser.exit()


def _parser(names: Iterable[str]) -> _Parser:
    """Return the parser of some commands."""
    parser = _Parser(
        prog="tribodyn",
        description="Tribo-dynamics of mechanisms with dry, rough, worn clearance joints.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name in names:
        command = COMMANDS[name]
        below = commands.add_parser(
            name,
            help=command.HELP,
            description=command.HELP,
            epilog=f"example: {command.EXAMPLE}",
            allow_abbrev=False,
        )
        below.set_defaults(parser=below)
        command.add_arguments(below)
        below.add_argument("--quiet", action="store_true", help="print errors and warnings only")
        below.add_argument("--json", action="store_true", help="print the outcome as JSON on stdout")
        console.add_arguments(below)
        below.add_argument("--debug", action="store_true", help="show where in the program an error arose")
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    ``arguments``: what follows ``tribodyn``; by default that of this process. Returns exit status: 0 done, 1
    failed, 2 bad input.
    """
    with signals_heard():
        forgive_encodings()
        silence_matplotlib()
        status = _executed(sys.argv[1:] if arguments is None else list(arguments))
        end(status)
    return status


def _executed(arguments: Sequence[str]) -> int:
    """Execute a command; say what went wrong."""
    # Of the command that they begin with; where they begin with none, of all.
    parser = _parser(arguments[:1] if arguments and arguments[0] in COMMANDS else COMMANDS)
    try:
        completion.answer(parser)
        if not arguments:
            parser.print_help()
            return DONE
        args = parser.understood(arguments)
        with console.logged(args, arguments):
            return _logged(args)
    except BrokenPipeError:
        # Whoever read our output has gone; nobody reads it any more.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except (Exception, KeyboardInterrupt) as error:
        if "--debug" in arguments:
            traceback.print_exc()
        status = BAD_INPUT if isinstance(error, InputError) else FAILED
        _complain(error, as_json="--json" in arguments)
        return status


def _logged(args: argparse.Namespace) -> int:
    """Execute a command, and log what goes wrong."""
    try:
        return COMMANDS[args.command].execute(args)
    except Exception as error:
        console.LOGGER.info("%s", _in_words(error), exc_info=args.debug)
        raise


def _complain(error: BaseException, *, as_json: bool) -> None:
    """Report errors on stderr, a line for each fault, and with ``--json`` on stdout, too."""
    faults = error.faults if isinstance(error, InputError) else (error,)
    for fault in faults:
        complain(_in_words(fault))
    if as_json:
        about = [{name: getattr(fault, name, None) for name in ("source", "key")} for fault in faults]
        shown = [{**where, "message": _in_words(fault)} for where, fault in zip(about, faults, strict=True)]
        show_json({"status": "refused" if isinstance(error, InputError) else "failed", "faults": shown})


def _in_words(error: BaseException) -> str:
    """Return the message of an error for a user."""
    if isinstance(error, TribodynError):
        return str(error)
    if isinstance(error, KeyboardInterrupt):
        return "aborted; nothing was saved"
    if isinstance(error, OSError):
        return f"writing or reading failed: {brief(error, 2 * LONGEST)}"
    if isinstance(error, MemoryError):
        return "there is not enough memory for this run"
    from tribodyn.core.platforms import unexpected

    return f"{unexpected(error)} (--debug shows where it arose)"
