"""Keys of patterns: bodies that stand several times about an axis or along a line, and values that scatter.

Points and directions move with the copies; the first copy is as drawn.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from statistics import NormalDist
from typing import ClassVar, Final, Literal, cast

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case, NamedGroup, demand, group_at, unit
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
from tribodyn.cases.tables import keys_in
from tribodyn.cases.units import AXES
from tribodyn.kernels import dense
from tribodyn.mechanism.frames import rotation
from tribodyn.mechanism.model.parts import OFF_DRAWING, POINT

PATTERN, SCATTER = "pattern", "scatter"
_SAME: Final = 1.0e-9  #: Part of a turn up to which two copies are at one place.
MOST_COPIES: Final = 1000
_SIZE: Final = "size"  #: Key that holds three lengths and no place.
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
        None, "number of copies, the one as drawn included", ge=2, le=MOST_COPIES, example="40"
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
        """Return directions of a copy, three numbers each."""
        found = dense.product(np.array(direction).reshape(-1, 3), self._turned(copy)[0].T)
        return tuple(found.ravel().tolist())

    def moved(self, copy: int, key: Key, value: Value) -> Value:
        """Return the value of a key at a copy: places and directions move with it, sizes and names do not."""
        if not isinstance(value, tuple) or key.kind not in ("vector", "series"):
            return value
        one = key.kind == "vector"
        if (one and key.unit == "mm" and key.name not in (_SIZE, *OFF_DRAWING)) or key.name in _PLACES:
            return self.placed(copy, value)  # type: ignore[arg-type]
        turns = one and (not key.unit or key.name in OFF_DRAWING)
        return self.directed(copy, value) if turns else value  # type: ignore[arg-type]

    def as_first(self, copy: int, direction: Sequence[float]) -> tuple[float, ...]:
        """Return a direction of a copy as the first copy has it."""
        return tuple(dense.product(np.array(direction), self._turned(copy)[0]).tolist())

    def of_copies(self, drawn: Mapping[str, FloatArray], case: Case) -> dict[str, FloatArray]:
        """Return values of keys at all copies, by path of shape (n,).

        ``drawn``: what first copies have by key, shape (n, n_copies); ``case``: that with equal copies.
        """
        keys, found = keys_in(case), dict[str, FloatArray]()
        for copy in range(1, self.count + 1):
            rows = np.array([of[:, copy - 1] for of in drawn.values()]).T.tolist()
            for path in dict.fromkeys(component(key)[0] for key in drawn):
                name, first = of_copy(path, copy), cast(Value, case.at(of_copy(path, 1)))
                own = (of_first(path, first, dict(zip(drawn, row, strict=True))) for row in rows)
                values = np.array([self.moved(copy, keys[name], one) for one in own])
                parts = zip(AXES, values.T, strict=True) if values.ndim > 1 else ()
                found |= {f"{name}.{axis}": part for axis, part in parts} or {name: values}
        return found

    def _turned(self, copy: int) -> tuple[FloatArray, FloatArray]:
        """Return the matrix of rotation and the way of a copy; the first one stays exactly where it is."""
        angle, way = self._moved(copy)
        if copy == 1 or self.about is None:
            return np.eye(3), way
        return rotation(np.array(unit(self.about.axis, "about.axis")), angle), way


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


def scatter_in(values: Mapping[str, Value]) -> dict[str, ScatterKeys]:
    """Return the scatter of copies among the values of a case, by its names."""
    return {name: group_at(ScatterKeys, f"{SCATTER}.{name}", values) for name in names_in(values, SCATTER)}


def names_in(values: Iterable[str], table: str) -> list[str]:
    """Return the names of the tables below a table."""
    return list(dict.fromkeys(path.split(".")[1] for path in values if path.startswith(f"{table}.")))


def of_copy(path: str, copy: int) -> str:
    """Return the path of the same key of a copy."""
    kind, name, *rest = path.split(".")
    return ".".join([kind, f"{name}[{copy}]", *rest])


def component(path: str) -> tuple[str, int | None]:
    """Return the path of a vector and the number of the component that a path names; None for a whole key."""
    before, _, last = path.rpartition(".")
    return (before, AXES.index(last)) if re.fullmatch(f"[{AXES}]", last) else (path, None)


def of_first(path: str, value: Value, drawn: Mapping[str, float]) -> Value:
    """Return the value of a key at the first copy if that had what another one draws."""
    own = [f"{path}.{axis}" for axis in AXES]
    if not isinstance(value, tuple) or drawn.keys().isdisjoint(own):
        return drawn.get(path, value)
    return tuple(drawn.get(part, one) for part, one in zip(own, value, strict=True))  # type: ignore[return-value]
