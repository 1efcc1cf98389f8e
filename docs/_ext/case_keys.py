"""Directive ``case-keys``: the keys of a kind of case as tables, made from the models."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList

from tribodyn.cases import Case, Key, keys_of
from tribodyn.cases.keys import ANY_NAME, groups_of
from tribodyn.mechanisms.catalogue import kinds


class CaseKeys(Directive):
    """Argument: the kind of case, such as ``vsv``."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the tables."""
        container = nodes.container()
        lines = StringList(list(_markdown(kinds()[self.arguments[0]])), source="case-keys")
        self.state.nested_parse(lines, self.content_offset, container)
        return container.children


def _markdown(model: type[Case]) -> Iterator[str]:
    for table, keys in groupby(keys_of(model).values(), key=lambda key: key.table):
        title = table.replace(ANY_NAME, "NAME")
        yield f"**`[{title}]`** {_purpose(model, table)}" if table else "**At the top**"
        yield from ("", "| key | default | allowed | meaning | source |", "|---|---|---|---|---|")
        yield from (f"| {' | '.join(_cells(key))} |" for key in keys)
        yield ""


def _purpose(model: Any, table: str) -> str:
    """Return the first line that the class of a table says about itself."""
    steps = table.replace(f".{ANY_NAME}", f"/{ANY_NAME}").split(".")
    for step in steps:
        model = dict(groups_of(model))[step.replace("/", ".")]
    return str(model.__doc__).splitlines()[0]


def _cells(key: Key) -> Iterator[str]:
    """Return the cells of a row; bars would end a cell."""
    yield f"`{key.name}`"
    yield "" if key.default is None else f"`{key.write(key.default)}`"
    yield ", ".join(f"`{name}`" for name in key.choices) if len(key.choices) > 1 else key.limits
    yield key.description.replace("|", "\\|")
    yield f"**{key.source}**" if key.source == "assumed" else key.source


def setup(app: Any) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("case-keys", CaseKeys)
    return {"parallel_read_safe": True}
