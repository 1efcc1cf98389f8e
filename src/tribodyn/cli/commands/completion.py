"""``tribodyn completion``: let a shell complete commands, options, cases, keys and their values.

The shell asks the command itself, which answers by argcomplete from its parser.
"""

from __future__ import annotations

import importlib
import os
from argparse import ArgumentParser, Namespace, _SubParsersAction
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.errors import InputError

if TYPE_CHECKING:
    from tribodyn.cases.keys import Key

HELP = 'print what lets a shell complete commands, keys and values: eval "$(tribodyn completion bash)"'
EXAMPLE = "tribodyn completion bash"
SHELLS: Final = ("bash", "zsh", "fish")
ASKING: Final = "_ARGCOMPLETE"  #: In the environment of a command that a shell asks for completions.


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``completion``."""
    parser.add_argument("shell", metavar="SHELL", choices=SHELLS, help=" or ".join(SHELLS))


def execute(args: Namespace) -> int:
    """Print the lines for a shell."""
    print(_library("argcomplete.shell_integration").shellcode(["tribodyn"], True, args.shell))
    return 0


def answer(parser: ArgumentParser) -> None:
    """Answer a shell that asks for completions, and leave."""
    if ASKING not in os.environ:
        return
    for action in parser._actions:
        if isinstance(action, _SubParsersAction):
            for below in action.choices.values():
                for option in below._actions:
                    if option.dest in COMPLETERS:
                        option.completer = COMPLETERS[option.dest]
    _library("argcomplete").autocomplete(parser)


def _library(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise InputError(
            "completion needs argcomplete: pip install 'tribodyn[completion]'", key="completion"
        ) from None


def _cases(prefix: str, **_: object) -> list[str]:
    from tribodyn.mechanisms.catalogue import built_in

    files: list[str] = importlib.import_module("argcomplete.completers").FilesCompleter(("toml",))(prefix)
    return [*built_in(), *files]


def _templates(**_: object) -> list[str]:
    from tribodyn.mechanisms.catalogue import templates

    return list(templates())


def _keys(parsed_args: Namespace) -> dict[str, Key]:
    """Return the keys of the case that stands on the command line so far."""
    from tribodyn.cases.tables import keys_in, with_components
    from tribodyn.mechanisms.catalogue import load_case

    return with_components(keys_in(load_case(parsed_args.case)))


def _paths(prefix: str, parsed_args: Namespace, **_: object) -> list[str]:
    """Return keys, or the values of the one that is there."""
    path, equals, _value = prefix.partition("=")
    keys = _keys(parsed_args)
    return [f"{path}={value}" for value in _values(keys.get(path))] if equals else [f"{key}=" for key in keys]


def _values(key: Key | None) -> Iterator[str]:
    if key is None:
        return
    if key.kind == "switch":
        yield from ("true", "false")
    elif key.choices:
        yield from key.choices
    elif key.example:
        yield key.example.strip('"')


def _names(module: str, attribute: str) -> Callable[..., list[str]]:
    """Return a completer of the names of a family."""

    def names(**_: object) -> list[str]:
        return list(getattr(importlib.import_module(module), attribute))

    return names


#: Completers of arguments, by their names in the parser; choices and files complete themselves.
COMPLETERS: Final[dict[str, Callable[..., list[str]]]] = {
    "case": _cases,
    "changes": _paths,
    "vary": _paths,
    "solver": _names("tribodyn.integrate", "SOLVERS"),
    "law": _names("tribodyn.contact", "LAWS"),
    "names": _names("tribodyn.cases.materials", "MATERIALS"),
    "template": _templates,
    "shell": _names("tribodyn.cli.commands.completion", "SHELLS"),
}
