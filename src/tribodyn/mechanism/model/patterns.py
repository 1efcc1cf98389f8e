"""Patterns: bodies that stand several times about an axis or along a line, with all that names them.

A description with patterns stands for the one in which copies ``vane[1]``, ``vane[2]`` and so on have taken
the place of body ``vane``. Joints, springs, elements, loads, drives and outputs that name a repeated body or
joint are repeated with it. Points and directions move with the copies; the first copy is as drawn.
"""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from statistics import NormalDist
from typing import Any, ClassVar, Final, Literal, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup, demand, demand_known, group_at, unit
from tribodyn.cases.fields import (
    Entry,
    Vector,
    choice,
    count,
    file,
    name,
    names,
    quantity,
    read_entry,
    switch,
    vector,
)
from tribodyn.cases.keys import Key, Value
from tribodyn.core.errors import below
from tribodyn.kernels import dense
from tribodyn.mechanism.frames import frame
from tribodyn.mechanism.model.beam import BeamBodyKeys
from tribodyn.mechanism.model.parts import POINT

PATTERN, SCATTER = "pattern", "scatter"
_SAME: Final = 1.0e-9  #: Part of a turn up to which two copies are at one place.
_MOST_COPIES: Final = 1000
_OF_JOINTS: Final = ("joint", "joints", "along", "follows")
_OF_BODIES: Final = ("between", "body", "reference", "socket")  #: Keys that name joints, and bodies.
_SIZE: Final = "size"  #: Key that holds three lengths and no place.
_WAY: Final = "deviation"  #: Key that holds a way and no place.
_PLACES: Final = ("points", "facets")  #: Keys that hold the coordinates of several points.


class AboutKeys(NamedGroup):
    """The axis that copies stand around."""

    point: Vector = vector("0, 0, 0 mm", "a point of it", "assumed", unit="mm", example=POINT)
    axis: Vector = vector(None, "its direction", example="[1, 0, 0]", required=True)
    step: float | None = quantity(
        None, "angle from copy to copy; by default a turn over their number", unit="deg", example="3 deg"
    )


class PatternKeys(NamedGroup):
    """Bodies that stand several times."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("about.axis", "step"),)

    count: int = count(
        None, "number of copies, the one as drawn included", ge=2, le=_MOST_COPIES, example="40"
    )
    bodies: tuple[str, ...] = names("the bodies that are repeated", length=0, example='["vane", "lever"]')
    about: AboutKeys | None = None
    step: Vector | None = vector(
        None, "way from copy to copy along a line", unit="mm", example='["20 mm", "0 mm", "0 mm"]'
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that copies stand apart."""
        demand(self.count is not None, "count", "a pattern needs the number of copies")
        words = "copies stand about an axis or along a line: give about = { axis = [1, 0, 0] }, or step"
        demand((self.about is None) != (self.step is None), "about", words)
        if self.about is not None:
            unit(self.about.axis, "about.axis")
        for copy in range(2, self.count + 1):
            turn, way = self._moved(copy)
            apart = abs(math.remainder(turn, 2.0 * math.pi)) > _SAME or bool(np.any(way))
            words = f"the pattern overlaps itself: copies 1 and {copy} are at one place"
            demand(apart, "step" if self.about is None else "about.step", words)

    def _moved(self, copy: int) -> tuple[float, FloatArray]:
        """Return by which angle and way a copy is moved, counted from 1."""
        if self.about is None:
            return 0.0, (copy - 1) * np.array(self.step)
        whole = 2.0 * math.pi
        return (copy - 1) * (whole / self.count if self.about.step is None else self.about.step), np.zeros(3)

    def placed(self, copy: int, point: Sequence[float]) -> tuple[float, ...]:
        """Return points of a copy, three numbers each."""
        turn, way = self._turned(copy)
        about = np.zeros(3) if self.about is None else np.array(self.about.point)
        found = dense.product(np.array(point).reshape(-1, 3) - about, turn.T) + about + way
        return tuple(found.ravel().tolist())

    def directed(self, copy: int, direction: Sequence[float]) -> tuple[float, ...]:
        """Return a direction of a copy."""
        return tuple(dense.product(self._turned(copy)[0], np.array(direction)).tolist())

    def as_first(self, copy: int, direction: Sequence[float]) -> tuple[float, ...]:
        """Return a direction of a copy as the first copy has it."""
        return tuple(dense.product(np.array(direction), self._turned(copy)[0]).tolist())

    def add_copy(
        self, key: str, copy: int, own: FloatArray, at: Callable[[str], Any], columns: dict[str, FloatArray]
    ) -> None:
        """Add values of a key at a copy to those by path; those of a component turn with the copy.

        ``at`` returns the value of a path where all copies are equal.
        """
        path, axis = _component(key)
        if axis is None:
            columns[_of_copy(path, copy)] = own
            return
        change, held = own - at(_of_copy(path, 1))[axis], at(_of_copy(path, copy))
        for letter, part, value in zip("xyz", self.directed(copy, np.eye(3)[axis]), held, strict=True):
            name = f"{_of_copy(path, copy)}.{letter}"
            columns[name] = columns.get(name, value) + part * change

    def _turned(self, copy: int) -> tuple[FloatArray, FloatArray]:
        """Return the matrix of rotation and the way of a copy; the first one stays exactly where it is."""
        angle, way = self._moved(copy)
        if copy == 1 or self.about is None:
            return np.eye(3), way
        axis = np.array(unit(self.about.axis, "about.axis"))
        across = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
        sine, cosine = math.sin(angle), math.cos(angle)
        return np.eye(3) + sine * across + (1.0 - cosine) * dense.product(across, across), way


class ScatterKeys(NamedGroup):
    """Values of a key that differ from copy to copy."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("values", "distribution"), ("values", "csv"))

    pattern: str = name(None, "whose copies", example="vanes", required=True)
    key: str = name(
        None, "which key of a repeated part", example="joints.trunnion.clearance.radial", required=True
    )
    values: tuple[str, ...] | None = names(
        "a value for each copy", length=0, example='["20 um", "22 um"]', required=False
    )
    csv: str | None = file(
        "CSV file with a value for each copy, a row each, under a header with units", "vanes.csv"
    )
    column: str | None = name(None, "its column; by default the first", example="radial")
    distribution: Literal["normal", "uniform"] | None = choice(
        None, "what values are drawn from", example="normal"
    )
    arguments: tuple[str, ...] | None = names(
        "mean and standard deviation, or both ends", length=2, example='["20 um", "2 um"]', required=False
    )
    seed: int = count(1, "of the numbers that are drawn, other ones for each key", "assumed", ge=0, le=2**31)
    added: bool = switch(False, "add them to the value of the key instead", "assumed")

    def drawn(self, key: Key, number: int, place: int) -> list[float]:
        """Return a value for each of some copies [SI]; ``place`` is that among all that scatters."""
        if self.distribution is None:
            words = f"the pattern has {number} copies, and here are {len(self.values or ())} values"
            demand(len(self.values or ()) == number, "values", words)
            return self.at_shares(key, [(copy + 0.5) / number for copy in range(number)])
        chance = np.random.default_rng([self.seed, place] if place else self.seed)
        return self.at_shares(key, chance.random(number).tolist())

    def at_shares(self, key: Key, shares: Sequence[float]) -> list[float]:
        """Return the values [SI] below which shares of all copies lie; of a list, those at shares of it."""
        if self.distribution is None:
            given = [self._read(key, "values", one) for one in self.values or ()]
            return [given[int(share * len(given))] for share in shares]
        words = "a distribution has two arguments: mean and standard deviation, or both ends"
        demand(self.arguments is not None, "arguments", words)
        first, second = (self._read(key, "arguments", one) for one in self.arguments or ())
        words = "a standard deviation is above zero, and the upper end above the lower one"
        demand(second > (0.0 if self.distribution == "normal" else first), "arguments", words)
        if self.distribution == "uniform":
            return [first + (second - first) * share for share in shares]
        return [first + second * NormalDist().inv_cdf(share) for share in shares]

    def _read(self, key: Key, own: str, value: str) -> float:
        """Return a value of the key that is meant."""
        found = read_entry(key.at(own), Entry(value, "", text=True))
        demand(isinstance(found, float), own, "these are numbers")
        return float(found)  # type: ignore[arg-type]


def with_copies(
    values: dict[str, Value], tables: list[str], keys: Mapping[str, Key]
) -> tuple[dict[str, Value], list[str]]:
    """Return the values and tables of a case in which copies have taken the place of what patterns repeat.

    ``values``: by dotted path [SI]; ``tables``: paths of tables that are there; ``keys``: all keys that there
    are with these. Raises InputError if a pattern overlaps itself or another one, or repeats what is not
    there.
    """
    patterns = {name: group_at(PatternKeys, f"{PATTERN}.{name}", values) for name in _names(values, PATTERN)}
    scatter = scatter_in(values)
    for label, one in scatter.items():
        demand_known(one.pattern, patterns, f"{SCATTER}.{label}.pattern", "pattern")
    for label, pattern in patterns.items():
        own = {key: (place, one) for place, (key, one) in enumerate(scatter.items()) if one.pattern == label}
        bodies = _names(values, "bodies")
        for other, before in patterns.items():
            both = [body for body in pattern.bodies if other != label and body in before.bodies]
            words = f"the patterns {other} and {label} overlap: both repeat {', '.join(both)}"
            demand(not both, f"{PATTERN}.{label}.bodies", words)
        # An elastic body is written as its nodes.
        written = {body.partition(":")[0] for body in bodies}
        if all(f"{body}[1]" in written and body not in written for body in pattern.bodies):
            # These are the values of a case that was written with its copies.
            held = sum(f"{pattern.bodies[0]}[{copy}]" in written for copy in range(1, _MOST_COPIES + 1))
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


def scatter_in(values: Mapping[str, Value]) -> dict[str, ScatterKeys]:
    """Return the scatter of copies among the values of a case, by its names."""
    return {name: group_at(ScatterKeys, f"{SCATTER}.{name}", values) for name in _names(values, SCATTER)}


def _names(values: Mapping[str, Value], table: str) -> list[str]:
    """Return the names of the tables below a table."""
    return list(dict.fromkeys(path.split(".")[1] for path in values if path.startswith(f"{table}.")))


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
        for path in (path for path, axis in map(_component, drawn) if axis is not None):
            self._values.setdefault(path, self._keys[path].default or (0.0,) * 3)  # of which a part scatters
        found: dict[str, Value] = {}
        for path, value in self._values.items():
            if _part(path) not in self._parts:
                found[path] = value
                continue
            for copy in numbers:
                own = self._scattered(path, value, copy, drawn)
                found.setdefault(_of_copy(path, copy), self._moved(path, own, copy))
        for part in sorted(self._parts):
            for path, value in self._assumed(".".join(part)):
                for copy in numbers:
                    found.setdefault(_of_copy(path, copy), self._moved(path, value, copy))
        for path, given in drawn.items():
            if path not in self._values and path in self._keys:
                found |= {_of_copy(path, copy): given[copy - 1] for copy in numbers}
        copied = [
            one if _part(path) not in self._parts else _of_copy(one, copy)
            for path in tables
            for one in [path]
            for copy in (numbers if _part(path) in self._parts else (1,))
        ]
        return found, list(dict.fromkeys(copied))

    def _drawn(self, name: str, place: int, one: ScatterKeys) -> list[float]:
        """Return the values of a key for all copies."""
        path, axis = _component(one.key)
        key = self._keys.get(path)
        words = f'"{one.key}" is no key of what the pattern {one.pattern} repeats'
        demand(key is not None and _part(path) in self._parts, f"{SCATTER}.{name}.key", words)
        assert key is not None
        kind = "quantity" if key.unit else "number"
        with below(f"{SCATTER}.{name}"):
            given = one.drawn(_as(key, kind), self._pattern.count, place)
            held = self._values.get(path, key.default)
            base: object = held[axis] if isinstance(held, tuple) and axis is not None else held
            words = "this key has no value that they could be added to"
            demand(not one.added or isinstance(base, float), "added", words)
        return [value + base if one.added and isinstance(base, float) else value for value in given]

    @staticmethod
    def _scattered(path: str, value: Value, copy: int, drawn: Mapping[str, Sequence[float]]) -> Value:
        """Return the value of a copy before it is moved."""
        if path in drawn:
            return drawn[path][copy - 1]
        if isinstance(value, tuple):
            parts = [drawn.get(f"{path}.{axis}") for axis in "xyz"]
            if any(parts) and len(value) == 3:
                return tuple(
                    one if own is None else own[copy - 1] for one, own in zip(value, parts, strict=True)
                )  # type: ignore[return-value]
        return value

    def _moved(self, path: str, value: Value, copy: int) -> Value:
        """Return the value of a key at a copy: names with its number, places and directions moved."""
        kind = _named_by(path)
        if kind is not None and (isinstance(value, str) or self._keys[path].kind == "names"):
            given = (value,) if isinstance(value, str) else value
            found = [f"{one}[{copy}]" if (kind, one) in self._parts else one for one in given]  # type: ignore[union-attr]
            return found[0] if isinstance(value, str) else tuple(found)  # type: ignore[return-value]
        key, last = self._keys[path], path.rpartition(".")[2]
        if not isinstance(value, tuple) or key.kind not in ("vector", "series"):
            return value
        if (key.unit == "mm" and key.kind == "vector" and last not in (_SIZE, _WAY)) or last in _PLACES:
            return self._pattern.placed(copy, value)  # type: ignore[arg-type]
        directs = key.kind == "vector" and (not key.unit or last == _WAY)
        return self._pattern.directed(copy, value) if directs else value  # type: ignore[arg-type]

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


def _of_copy(path: str, copy: int) -> str:
    """Return the path of the same key of a copy."""
    kind, name, *rest = path.split(".")
    return ".".join([kind, f"{name}[{copy}]", *rest])


def _component(path: str) -> tuple[str, int | None]:
    """Return the path of a vector and the number of the component that a path names; None for a whole key."""
    before, _, last = path.rpartition(".")
    return (before, "xyz".index(last)) if re.fullmatch("[xyz]", last) else (path, None)


def _as(key: Key, kind: str) -> Key:
    """Return a key of one number instead of several."""
    made = key.at(key.path)
    made.__dict__.update(kind=kind, length=0)
    return made
