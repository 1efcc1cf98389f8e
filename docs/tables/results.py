"""Tables on results, made from the lists of their mechanisms: variables, key results, figures."""

from __future__ import annotations

from functools import partial
from typing import Final

from tables.markdown import Lines, Table, head, row
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results.summary import EFFORT
from tribodyn.results.variables import COORDINATES, VARIABLES


def variables(kind: str) -> Lines:
    """Give the variables of the results of a kind of cases."""
    yield from head("variable", "unit", "dimensions", "meaning")
    listed = {**(VARIABLES if kind == "vsv" else COORDINATES), **MECHANISMS[kind].variables}
    for name, one in listed.items():
        yield row(f"`{name}`", "name" if one.named else one.units, ", ".join(one.dims), one.long_name)


def key_results(kind: str) -> Lines:
    """Give the key results of a kind of cases that are not of one of its parts."""
    yield from head("name in `summary.json`", "unit", "meaning")
    for name, one in {**MECHANISMS[kind].key_results, **EFFORT}.items():
        yield row(f"`{name}`", one.unit, f"{one.label}. {one.meaning}")


def parts(kind: str) -> Lines:
    """Give the key results of each part, whose name stands at the end of theirs."""
    yield from head("name in `summary.json`", "of", "unit", "meaning")
    for table, numbers in MECHANISMS[kind].by_part.items():
        for name, made in numbers.items():
            one = made("NAME")
            yield row(f"`{name}_NAME`", table, one.unit, f"{one.column or one.label}. {one.meaning}")


def figures(kind: str) -> Lines:
    """Give the figures of a kind of cases."""
    yield from head("file in `figures/`", "shows")
    for name, one in MECHANISMS[kind].figures.items():
        yield row(f"`{name}.png`", f"{one.title}. {one.caption}")


#: Tables by name.
TABLES: Final[dict[str, Table]] = {
    f"{table.__name__} {kind}": partial(table, kind)
    for table in (variables, key_results, parts, figures)
    for kind in ("vsv", "mechanism")
}
