"""Tables on cases, made from the models: keys of a kind, assumed ones, joints, elements."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from functools import partial
from itertools import groupby
from typing import Any, Final

from tables.markdown import BAR, Lines, Table, head, row
from tribodyn.cases import Case, Key, keys_of
from tribodyn.cases.keys import ANY_NAME, groups_of
from tribodyn.kernels.mechanism.data import DIRECTION, POINT
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanisms.catalogue import kinds, load_case


def assumed(kind: str) -> Lines:
    """Give every key of a kind of cases whose value is assumed."""
    yield from head("key", "value", "meaning")
    for name, key in keys_of(kinds()[kind]).items():
        if key.source == "assumed":
            value = "" if key.default is None else f"`{key.write(key.default)}`"
            yield row(f"`{name.replace(ANY_NAME, 'NAME')}`", value, key.description.replace("|", BAR))


def sizes(case: str) -> Lines:
    """Give the sizes of the clearance of each joint of a built-in case of bodies and joints."""
    yield from head("joint", "type", "sizes")
    for name, joint in tomllib.loads(load_case(case).to_toml())["joints"].items():
        given = joint.get("clearance", {})
        values = (f"{key.replace('_', ' ')} {given[key]}" for key in SIZES if key in given)
        yield row(name, joint["type"], ", ".join(values))


def elements() -> Lines:
    """Give keys and transmitted loads of every kind of element."""
    yield from head("element", "table", "method", "keys", "`element_force`", "`element_moment`")
    for kind in ELEMENTS:
        keys = ", ".join(f"`{key}`" for key in kind.model_fields)
        yield row(
            *(kind.__name__, f"`[{kind.TABLE}.NAME]`", f"`{kind.METHOD}`", keys, kind.FORCE, kind.MOMENT)
        )


def joints() -> Lines:
    """Give motion, drives and clearance of every type of joint."""
    yield from head("type", "what moves", "driven by", "with clearance")
    for name, kind in JOINTS.items():
        driven = ", ".join(f"`{coordinate}`" for coordinate in kind.COORDINATES)
        yield row(f"`{name}`", kind.MEANING, driven, kind.CLEARANCE)


def equations() -> Lines:
    """Give the constraint equations of every type of joint."""
    yield from head("joint", "coordinates of the origin", "directions at right angles")
    for name, kind in JOINTS.items():
        if kind.ROWS:
            places = ("xyz"[axis] for row_kind, axis, _ in kind.ROWS if row_kind == POINT)
            pairs = (
                f"{'xyz'[axis]}–{'xyz'[other]}'"
                for row_kind, axis, other in kind.ROWS
                if row_kind == DIRECTION
            )
            yield row(name, ", ".join(places), ", ".join(pairs))


#: Keys of a joint's clearance that are sizes, or its friction.
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


def keys(kind: str) -> Lines:
    """Give a table for each group of keys of a kind of cases."""
    model: type[Case] = kinds()[kind]
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
    yield key.description.replace("|", BAR)
    yield f"**{key.source}**" if key.source == "assumed" else key.source


#: Tables by name.
TABLES: Final[dict[str, Table]] = {
    **{f"keys {kind}": partial(keys, kind) for kind in ("mechanism", "vsv")},
    "assumed vsv": partial(assumed, "vsv"),
    "sizes vsv-joints": partial(sizes, "vsv-joints"),
    "elements": elements,
    "joints": joints,
    "equations": equations,
}
