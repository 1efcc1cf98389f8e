"""``tribodyn materials``: what the library of materials knows, and where it stands."""

from argparse import ArgumentParser, Namespace
from dataclasses import asdict

from tribodyn.cli.console import show_json
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant

HELP = "list the materials that a case can name, or the properties of some with their sources"
EXAMPLE = "tribodyn materials ptfe-liner bronze-c93200"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``materials``."""
    parser.add_argument("names", metavar="NAME", nargs="*", help="show every property of this material")


def execute(args: Namespace) -> int:
    """Print one line for each material, or all of those that are named."""
    from tribodyn.cases.materials import MATERIALS

    for name in args.names:
        if name not in MATERIALS:
            allowed = f"{as_given(name)}; allowed: {', '.join(MATERIALS)}{meant(name, MATERIALS)}"
            raise InputError(allowed, key="NAME")
    shown = {name: MATERIALS[name] for name in args.names or MATERIALS}
    if args.json:
        show_json({name: asdict(material) for name, material in shown.items()})
        return 0
    width = max(map(len, shown))
    for name, material in shown.items():
        print(material if args.names else f"{name:<{width}}  {material.title}")
    return 0
