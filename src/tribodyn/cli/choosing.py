"""The options that choose a case and change it."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING, Final

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.cases import Case

ANALYSES: Final = ("static", "kinematic", "vibrations")  #: Analyses that have an option of their own.


def add_case_arguments(parser: ArgumentParser, *, required: bool = True) -> None:
    """Add CASE and the options that change it."""
    parser.add_argument(
        "case",
        metavar="CASE",
        nargs=None if required else "?",
        help="a built-in case (see `tribodyn cases`) or a TOML file"
        + ("" if required else " (default: the first of the built-in ones)"),
    )
    add_changes(parser)


def add_changes(parser: ArgumentParser) -> None:
    """Add the options that change a case."""
    parser.add_argument(
        "--set",
        dest="changes",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        help='change a key, with its unit: --set joint.clearance="25 um"; may be repeated',
    )
    parser.add_argument("--solver", metavar="NAME", help="short for --set solver.name=NAME")
    one = parser.add_mutually_exclusive_group()
    for name in ANALYSES:
        one.add_argument(
            f"--{name}",
            dest="analysis",
            action="store_const",
            const=name,
            help=f"short for --set run.analysis={name} of a user-defined mechanism",
        )


def chosen_case(args: Namespace) -> Case:
    """Return the case that the arguments name, with the changes they ask for."""
    from tribodyn.mechanisms.catalogue import load_case

    options = {"--set": _set(args), "--solver": _solver(args), f"--{args.analysis}": _analysis(args)}
    given = [option for option, keys in options.items() if keys]
    return load_case(args.case, changes(args), source=" and ".join(given))


def changes(args: Namespace) -> dict[str, str]:
    """Return the changes that the arguments ask for, by dotted path."""
    return _set(args) | _solver(args) | _analysis(args)


def _set(args: Namespace) -> dict[str, str]:
    return dict(_change(text) for text in args.changes)


def _solver(args: Namespace) -> dict[str, str]:
    return {} if args.solver is None else {"solver.name": args.solver}


def _analysis(args: Namespace) -> dict[str, str]:
    return {} if args.analysis is None else {"run.analysis": args.analysis}


def typed(text: str) -> str:
    """Return an argument as it was typed: where Python knows no encoding, it is read as UTF-8."""
    try:
        return os.fsencode(text).decode()
    except UnicodeError:
        return text


def without_quotes(value: str) -> str:
    """Return a value without a pair of quotes that was left around it."""
    value = value.strip()
    quoted = len(value) > 1 and value[0] == value[-1] and value[0] in "\"'"
    return value[1:-1].strip() if quoted else value


def _change(text: str) -> tuple[str, str]:
    path, equals, value = typed(text).partition("=")
    if not (equals and path.strip()):
        raise InputError(
            f'{as_given(text)}; allowed: PATH=VALUE, such as joint.clearance="25 um"', key="--set"
        )
    return path.strip(), without_quotes(value)
