"""``tribodyn new``: write a case file to start from."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from tribodyn.cli.console import Console, show_json
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

HELP = "write a case file to start from; without a name, list the templates"
EXAMPLE = "tribodyn new slider-crank mine.toml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``new``."""
    parser.add_argument("template", metavar="TEMPLATE", nargs="?", help="what to copy, such as slider-crank")
    parser.add_argument("file", metavar="FILE", nargs="?", help="where to (default: TEMPLATE.toml)")


def execute(args: Namespace) -> int:
    """List the templates, or write one."""
    console = Console.of(args)
    if args.template is None:
        return _list(args)
    from tribodyn.mechanisms.catalogue import template

    path = Path(args.file or f"{args.template}.toml")
    text = template(args.template)
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        words = f"{as_given(str(path))}: this file exists; allowed: a new name"
        raise InputError(words, key="FILE") from None
    console.say(f"{path} written; edit it, then: tribodyn check {path}; tribodyn run {path}")
    if args.json:
        show_json({"template": args.template, "file": str(path)})
    return 0


def _list(args: Namespace) -> int:
    """Print one line for each template."""
    from tribodyn.mechanisms.catalogue import templates

    found = templates()
    if args.json:
        show_json(found)
        return 0
    width = max(map(len, found))
    for name, title in found.items():
        print(f"{name:<{width}}  {title}")
    print("\nexample: tribodyn new slider-crank mine.toml")
    return 0
