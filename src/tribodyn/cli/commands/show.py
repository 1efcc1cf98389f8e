"""``tribodyn show``: print the whole resolved case, or all keys of a kind of case, as commented TOML."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from tribodyn.cli.console import show_json
from tribodyn.cli.options import add_case_arguments, changes, chosen_case
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

HELP = "print a case with every key explained, as TOML; `show mechanism` lists all keys of such a case"
EXAMPLE = "tribodyn show slider-crank > mine.toml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``show``."""
    add_case_arguments(parser)


def execute(args: Namespace) -> int:
    """Print the case, or the keys of a kind."""
    from tribodyn.mechanisms.catalogue import built_in, kinds

    if args.case in kinds() and args.case not in built_in() and not changes(args):
        return _show_keys(args)
    _refuse_a_table(args.case)
    case = chosen_case(args)
    if args.json:
        show_json(case.model_dump())
    else:
        print(case.to_toml(comments=True), end="")
    return 0


def _refuse_a_table(name: str) -> None:
    """Refuse the name of a table of a case, such as ``bodies``, where no file has it."""
    from tribodyn.mechanisms.catalogue import built_in, kinds

    having = [f"`tribodyn show {kind}`" for kind, model in kinds().items() if name in model.model_fields]
    if having and name not in built_in() and not Path(name).exists():
        words = f"{as_given(name)}; this is a table of a case: {' or '.join(having)} lists its keys"
        raise InputError(words, key="CASE")


def _show_keys(args: Namespace) -> int:
    """Print all keys of a kind of case."""
    from tribodyn.cases.keys import keys_of
    from tribodyn.cases.write import keys_as_toml
    from tribodyn.mechanisms.catalogue import kinds

    model = kinds()[args.case]
    if args.json:
        show_json({path: key.description for path, key in keys_of(model).items()})
    else:
        print(keys_as_toml(model, args.case), end="")
    return 0
