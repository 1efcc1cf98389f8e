"""Directives on cases, made from the models: all keys of a kind, those that are assumed, sizes of joints."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from itertools import groupby
from typing import Any, Final

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList

from tribodyn.cases import Case, Key, keys_of
from tribodyn.cases.keys import ANY_NAME, groups_of
from tribodyn.mechanisms.catalogue import kinds, load_case
from tribodyn.mechanisms.general.elements import ELEMENTS
from tribodyn.mechanisms.general.joints import JOINTS
from tribodyn.mechanisms.general.joints.base import words_of


class Tables(Directive):
    """Tables about a case."""

    required_arguments = 1

    def lines(self, about: str) -> Iterator[str]:
        """Give the Markdown."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Return the tables."""
        container = nodes.container()
        lines = StringList(list(self.lines(self.arguments[0])), source=self.name)
        self.state.nested_parse(lines, self.content_offset, container)
        return container.children


class CaseKeys(Tables):
    """Argument: the kind of case, such as ``vsv``."""

    def lines(self, about: str) -> Iterator[str]:
        """Give a table for each group of keys."""
        return _markdown(kinds()[about])


class AssumedKeys(Tables):
    """Argument: the kind of case. Every key whose value is assumed."""

    def lines(self, about: str) -> Iterator[str]:
        """Give one table."""
        yield "| key | value | meaning |"
        yield "|---|---|---|"
        for name, key in keys_of(kinds()[about]).items():
            if key.source == "assumed":
                value = "" if key.default is None else f"`{key.write(key.default)}`"
                path, meaning = name.replace(ANY_NAME, "NAME"), key.description.replace("|", BAR)
                yield f"| `{path}` | {value} | {meaning} |"


class JointSizes(Tables):
    """Argument: a built-in case of bodies and joints. The sizes of the clearance of each joint."""

    def lines(self, about: str) -> Iterator[str]:
        """Give one table."""
        joints = tomllib.loads(load_case(about).to_toml())["joints"]
        yield "| joint | type | sizes |"
        yield "|---|---|---|"
        for name, joint in joints.items():
            given = joint.get("clearance", {})
            sizes = (f"{key.replace('_', ' ')} {given[key]}" for key in SIZES if key in given)
            yield f"| {name} | {joint['type']} | {', '.join(sizes)} |"


class Elements(Directive):
    """What elements need and transmit, from the list of all kinds."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        lines = [
            "| element | table | method | keys | `element_force` | `element_moment` |",
            "|---|---|---|---|---|---|",
        ]
        for kind in ELEMENTS:
            keys = ", ".join(f"`{key}`" for key in kind.model_fields)
            names = f"`[{kind.TABLE}.NAME]` | `{kind.METHOD}`"
            lines.append(f"| {kind.__name__} | {names} | {keys} | {kind.FORCE} | {kind.MOMENT} |")
        container = nodes.container()
        self.state.nested_parse(StringList(lines, source=self.name), self.content_offset, container)
        return container.children


class Joints(Tables):
    """Argument: ``use`` or ``equations``. What the types of joints do, or hold, from their list."""

    def lines(self, about: str) -> Iterator[str]:
        """Give one table."""
        yield from _EQUATIONS if about == "equations" else _USE
        for name, kind in JOINTS.items():
            if about == "use":
                driven = ", ".join(f"`{coordinate}`" for coordinate in kind.COORDINATES)
                yield f"| `{name}` | {kind.MEANING} | {driven} | {kind.CLEARANCE} |"
            elif kind.ROWS:
                yield f"| {name} | {' | '.join(words_of(kind.ROWS))} |"


BAR: Final = "\\|"
_USE: Final = ("| type | what moves | driven by | with clearance |", "|---|---|---|---|")
_EQUATIONS: Final = (
    "| joint | coordinates of the origin | directions at right angles |",
    "|---|---|---|",
)
SIZES: Final = (
    "radius",
    "radial",
    "length",
    "axial",
    "axial_upper",
    "axial_lower",
    "gap",
    "friction_coefficient",
)
"""Keys of a joint's clearance that are sizes, or its friction."""


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
    app.add_directive("assumed-keys", AssumedKeys)
    app.add_directive("joint-sizes", JointSizes)
    app.add_directive("elements", Elements)
    app.add_directive("joints", Joints)
    return {"parallel_read_safe": True}
