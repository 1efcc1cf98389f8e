"""Descriptions in which the copies of patterns stand for what they repeat.

A description with patterns stands for the one in which copies ``vane[1]``, ``vane[2]`` and so on have taken
the place of body ``vane``. Joints, springs, elements, loads, drives and outputs that name a repeated body or
joint are repeated with it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import chain
from typing import Final, TypeAlias

import numpy as np

from tribodyn.cases.case import demand, demand_known, group_at
from tribodyn.cases.keys import Key, Value
from tribodyn.core.errors import below
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.model.beam import BeamBodyKeys
from tribodyn.mechanism.model.patterns import (
    MOST_COPIES,
    PATTERN,
    SCATTER,
    PatternKeys,
    ScatterKeys,
    component,
    names_in,
    of_copy,
    of_first,
    scatter_in,
)

_OF_JOINTS: Final = ("joint", "joints", "along", "follows")
_OF_BODIES: Final = ("between", "body", "reference", "socket")  #: Keys that name joints, and bodies.


def with_copies(
    values: dict[str, Value], tables: list[str], keys: Mapping[str, Key]
) -> tuple[dict[str, Value], list[str]]:
    """Return the values and tables of a case in which copies have taken the place of what patterns repeat.

    ``values``: by dotted path [SI]; ``tables``: paths of tables that are there; ``keys``: all keys that there
    are with these. Raises InputError if a pattern overlaps itself or another one, or repeats what is not
    there.
    """
    patterns = {one: group_at(PatternKeys, f"{PATTERN}.{one}", values) for one in names_in(values, PATTERN)}
    scatter = scatter_in(values)
    for label, one in scatter.items():
        demand_known(one.pattern, patterns, f"{SCATTER}.{label}.pattern", "pattern")
    for label, pattern in patterns.items():
        own = {key: (place, one) for place, (key, one) in enumerate(scatter.items()) if one.pattern == label}
        bodies = names_in(values, "bodies")
        for other, before in patterns.items():
            both = [body for body in pattern.bodies if other != label and body in before.bodies]
            words = f"the patterns {other} and {label} overlap: both repeat {', '.join(both)}"
            demand(not both, f"{PATTERN}.{label}.bodies", words)
        # An elastic body is written as its nodes.
        written = {body.partition(":")[0] for body in bodies}
        if all(f"{body}[1]" in written and body not in written for body in pattern.bodies):
            # These are the values of a case that was written with its copies.
            held = sum(f"{pattern.bodies[0]}[{copy}]" in written for copy in range(1, MOST_COPIES + 1))
            words = (
                f"this case was written with its {held} copies; their number is that of the file before it"
            )
            demand(held == pattern.count, f"{PATTERN}.{label}.count", words)
            words = "this case was written with its copies; what scatters stands in the file before it"
            demand(not own, f"{SCATTER}.{next(iter(own), '')}", words)
            continue
        for body in pattern.bodies:
            demand_known(body, bodies, f"{PATTERN}.{label}.bodies", "body")
        values, tables = _Repeated(pattern, values, keys).copies(own, tables)
    if not scatter:
        return values, tables
    # What scatters has its values now, and draws no other ones where they are written.
    left = {path: value for path, value in values.items() if not path.startswith(f"{SCATTER}.")}
    return left, [table for table in tables if not table.startswith(f"{SCATTER}.")]


Part: TypeAlias = tuple[str, str]  #: Kind and name of a part of a case.


def parts_that_name(values: Mapping[str, Value]) -> dict[Part, set[Part]]:
    """Return the bodies and joints that parts of a case name."""
    named: dict[Part, set[Part]] = {}
    for path, value in values.items():
        if (kind := _named_by(path)) and path.count(".") > 1:
            given = (value,) if isinstance(value, str) else value
            named.setdefault(_part(path), set()).update((kind, str(one)) for one in given)  # type: ignore[union-attr]
    return named


def repeated(pattern: PatternKeys, named: Mapping[Part, set[Part]]) -> set[Part]:
    """Return the parts that a pattern repeats: its bodies, and what names them or each other."""
    parts = {("bodies", body) for body in pattern.bodies}
    before = 0
    while before < len(parts):
        before = len(parts)
        parts |= {part for part, others in named.items() if others & parts}
    return parts


class _Repeated:
    """The parts of a case that a pattern repeats."""

    def __init__(self, pattern: PatternKeys, values: dict[str, Value], keys: Mapping[str, Key]) -> None:
        self._pattern, self._values, self._keys = pattern, values, keys
        self._parts = repeated(pattern, parts_that_name(values))

    def copies(
        self, scatter: Mapping[str, tuple[int, ScatterKeys]], tables: list[str]
    ) -> tuple[dict[str, Value], list[str]]:
        """Return values and tables with copies in the place of the parts."""
        numbers = range(1, self._pattern.count + 1)
        drawn = {one.key: self._drawn(name, place, one) for name, (place, one) in scatter.items()}
        of_copies = [{path: given[copy - 1] for path, given in drawn.items()} for copy in numbers]
        for path, _ in map(component, drawn):
            self._values.setdefault(path, self._keys[path].default or (0.0,) * 3)  # which draws replace
        for part in sorted(self._parts):
            for path, value in [*self._assumed(".".join(part))]:
                self._values.setdefault(path, value)
        found: dict[str, Value] = {}
        for path, value in self._values.items():
            if _part(path) not in self._parts:
                found[path] = value
                continue
            for copy, own in zip(numbers, of_copies, strict=True):
                found.setdefault(of_copy(path, copy), self._moved(path, of_first(path, value, own), copy))
        copied = (
            [of_copy(path, copy) for copy in numbers] if _part(path) in self._parts else [path]
            for path in tables
        )
        return found, list(dict.fromkeys(chain.from_iterable(copied)))

    def _drawn(self, name: str, place: int, one: ScatterKeys) -> list[float]:
        """Return the values of a key for all copies."""
        path, axis = component(one.key)
        key = self._keys.get(path)
        words = f'"{one.key}" is no key of what the pattern {one.pattern} repeats'
        demand(key is not None and _part(path) in self._parts, f"{SCATTER}.{name}.key", words)
        assert key is not None
        of_one = replace(key, kind="quantity" if key.unit else "number", length=0)
        with below(f"{SCATTER}.{name}"):
            given = one.drawn(of_one, self._pattern.count, place)
            held = self._values.get(path, key.default)
            base: object = held[axis] if isinstance(held, tuple) and axis is not None else held
            words = "this key has no value that they could be added to"
            demand(not one.added or isinstance(base, float), "added", words)
        return [value + base if one.added and isinstance(base, float) else value for value in given]

    def _moved(self, path: str, value: Value, copy: int) -> Value:
        """Return the value of a key at a copy: names with its number, places and directions moved."""
        kind = _named_by(path)
        if kind is not None and (isinstance(value, str) or self._keys[path].kind == "names"):
            given = (value,) if isinstance(value, str) else value
            found = [f"{one}[{copy}]" if (kind, one) in self._parts else one for one in given]  # type: ignore[union-attr]
            return found[0] if isinstance(value, str) else tuple(found)  # type: ignore[return-value]
        return self._pattern.moved(copy, self._keys[path], value)

    def _assumed(self, part: str) -> Iterator[tuple[str, Value]]:
        """Yield directions that a part has by default and that must move with its copies."""
        given = self._values
        if (
            part.startswith("bodies.")
            and f"{part}.shape" in given
            and given[f"{part}.shape"] in ("cylinder", "box")
        ) or f"{part}.inertia" in given:
            yield from ((f"{part}.first_axis", (1.0, 0.0, 0.0)), (f"{part}.second_axis", (0.0, 1.0, 0.0)))
        elif f"{part}.beam.points" in given:
            line = group_at(BeamBodyKeys, f"{part}.beam", given).line
            yield f"{part}.beam.height_axis", tuple(frame(line[1] - line[0], np.zeros(3))[:, 0].tolist())
        elif f"{part}.axis" in given and part.startswith("joints."):
            axis = np.array(given[f"{part}.axis"])
            yield (
                f"{part}.second_axis",
                tuple(frame(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])[:, 0].tolist()),
            )


def _part(path: str) -> Part:
    """Return kind and name of the part that a path belongs to."""
    kind, _, rest = path.partition(".")
    return kind, rest.partition(".")[0]


def _named_by(path: str) -> str | None:
    """Return the kind of parts that the value of a key names; None for none."""
    last = path.rpartition(".")[2]
    if path.startswith((f"{PATTERN}.", f"{SCATTER}.")):
        return None
    return "joints" if last in _OF_JOINTS else "bodies" if last in _OF_BODIES else None
