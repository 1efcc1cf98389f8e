"""``tribodyn export``: write columns of a stored result as a table for spreadsheets and other programs."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from tribodyn.cli.console import Console, show_json
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

HELP = "write forces, outputs and other columns of a result as a table (CSV)"
EXAMPLE = "tribodyn export results-slider-crank --csv forces,outputs --over main"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``export``."""
    parser.add_argument("directory", metavar="DIR", help="directory that `tribodyn run` wrote to")
    parser.add_argument(
        "--csv",
        metavar="NAMES",
        required=True,
        help="with commas between them: outputs, motion, forces, moments, pressures, energies, powers; or "
        "variables of the result, with or without labels, as reaction_force.wrist.x",
    )
    parser.add_argument(
        "--over", metavar="JOINT", help="begin with the angle of this joint, or with a variable"
    )
    parser.add_argument(
        "--decimal", choices=("point", "comma"), default="point", help="comma: fields end with semicolons"
    )
    parser.add_argument("-o", "--output", metavar="FILE", help="file to write; DIR/NAMES.csv by default")


def execute(args: Namespace) -> int:
    """Write the table."""
    from tribodyn.mechanisms.results import read
    from tribodyn.results.columns import table
    from tribodyn.results.store import write_bytes

    names = [name.strip() for name in args.csv.split(",") if name.strip()]
    if not names:
        raise InputError(f"{as_given(args.csv)}; allowed: names of columns, as forces,outputs", key="--csv")
    columns = table(read(args.directory), names, over=args.over, keys=("--csv", "--over"))
    comma = args.decimal == "comma"
    # Spreadsheets know UTF-8 by its mark.
    text = columns.to_csv(index=False, sep=";" if comma else ",", decimal="," if comma else ".")
    path = Path(args.output) if args.output else Path(args.directory) / f"{'-'.join(names)}.csv"
    if not path.parent.is_dir() or path.is_dir():
        raise InputError(f"{as_given(str(path))}; allowed: a file in a folder that is there", key="--output")
    write_bytes(path, text.encode("utf-8-sig"))
    console = Console.of(args)
    console.say(f"{path} has {len(columns)} rows of {len(columns.columns)} columns")
    if console.json:
        show_json({"file": str(path), "rows": len(columns), "columns": [*map(str, columns.columns)]})
    return 0
