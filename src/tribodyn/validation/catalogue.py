"""The list of validation sets, what the files of a set hold, and what assumed inputs change."""

import csv
import importlib
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.resources import as_file, files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, cast

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si, is_number, si_unit, to_si, unit_of
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.validation.base import Band, Kind, Outcome, Sides

if TYPE_CHECKING:
    import xarray as xr

#: Every set by its folder in ``sets``.
NAMES: Final = (
    "servo_friction_models",
    "ball_drop",
    "journal_peak_pressure",
    "journal_stribeck",
    "oblique_impact",
    "screw_drive_friction",
    "rack_pinion_friction",
    "servo_play",
    "servo_gear_friction",
    "dry_liners",
    "vsv_practice",
    "published_statements",
    "friction_damper_backlash",
    "hip_simulator_wear",
    "cycloid_reducer_play",
    "pin_on_disc_pps",
    "published_statements_2",
)
#: Data under licences of their own: in the repository, in no package.
OUTSIDE: Final = Path(__file__).parents[3] / "data"


@dataclass(frozen=True)
class Input:
    """An input of a computation: a value, the band of its uncertainty and where both come from."""

    name: str  #: Its key in ``set.toml``.
    #: Value and ends of its band, SI units; both ends equal the value where there is no band.
    value: float
    low: float
    high: float
    text: str  #: The value as written, with its unit.
    source: str  #: Text of the source that gives it, empty if it is assumed.
    assumed: str  #: Reason of an assumed value, empty if a source gives it.

    @property
    def band_text(self) -> str:
        """The band as text; empty where there is none."""
        if self.low == self.high:
            return ""
        unit = unit_of(self.text) if not is_number(self.text) else ""
        low, high = (from_si(end, unit) if unit else f"{end:g}" for end in (self.low, self.high))
        return f"{low} to {high}"


@dataclass(frozen=True)
class ValidationSet:
    """A set: its folder, title, inputs and bands."""

    name: str

    @property
    def folder(self) -> Traversable:
        """The folder with its files."""
        return files(__package__) / "sets" / self.name

    @property
    def data(self) -> Traversable:
        """The folder with its README and tables: its own, or one of another licence outside the package."""
        licence = self.table.get("licence")
        return self.folder if licence is None else OUTSIDE / str(licence) / self.name

    @property
    def missing(self) -> str:
        """Why there are no data, in a sentence; empty where they are there."""
        licence = self.table.get("licence")
        if licence is None or self.data.is_dir():
            return ""
        return f"{self.name}: its data, under {licence}, are in the repository and not in this package."

    @cached_property
    def table(self) -> Mapping[str, Any]:
        """Content of ``set.toml``."""
        return tomllib.loads((self.folder / "set.toml").read_text(encoding="utf-8"))

    @property
    def title(self) -> str:
        """Measured quantity in a few words."""
        return str(self.table["title"])

    @property
    def kind(self) -> Kind:
        """Kind of check."""
        return Kind(self.table["kind"])

    @cached_property
    def inputs(self) -> dict[str, Input]:
        """Inputs by name."""
        return {name: _input(name, entry) for name, entry in self.table.get("inputs", {}).items()}

    @cached_property
    def bands(self) -> dict[str, Band]:
        """Acceptance bands by name."""
        return {name: _band(name, entry) for name, entry in self.table.get("bands", {}).items()}

    def value(self, name: str) -> float:
        """Return the value of an input [SI]."""
        return self.inputs[name].value

    def explanation(self, row: str) -> str:
        """Return why the compared number of this name misses its band; empty if nothing is written."""
        return str(self.table.get("explanations", {}).get(row, ""))

    def rows(self, file: str) -> list[dict[str, str]]:
        """Return the rows of a CSV file of the set by the names of its columns."""
        text = (self.data / file).read_text(encoding="utf-8")
        return list(csv.DictReader(text.splitlines()))

    def columns(
        self, file: str, *names: str, where: tuple[str, str] | None = None, every: int = 1
    ) -> list[FloatArray]:
        """Return columns of numbers of a CSV file of the set.

        ``file``, ``names``: the file and the names of the columns; ``where``: name of another column and the
        text that it must hold; ``every``: every so many of the rows is taken.
        """
        rows = [row for row in self.rows(file) if where is None or row[where[0]] == where[1]]
        return [np.array([float(row[name]) for row in rows[::every]]) for name in names]

    def simulated(self, file: str, changes: Mapping[str, object]) -> "xr.Dataset":
        """Return the run of a model file of the set with changed keys."""
        from tribodyn.simulation import simulate

        with as_file(self.folder / file) as model:
            return simulate(load_case(str(model)).replace(changes))

    def readme(self) -> str:
        """Return the README of the set."""
        return (self.data / "README.md").read_text(encoding="utf-8")

    def run(self) -> Outcome:
        """Compute the measured quantity."""
        module = importlib.import_module(f"{__package__}.sets.{self.name}")
        return cast("Callable[[ValidationSet], Outcome]", module.compare)(self)


def load(name: str) -> ValidationSet:
    """Return a set by name.

    Raises InputError if there is no set of this name.
    """
    if name not in NAMES:
        raise InputError(f"{as_given(name)}; allowed: {', '.join(NAMES)}{meant(name, NAMES)}", key="NAME")
    return ValidationSet(name)


def chosen(names: list[str]) -> Iterator[ValidationSet]:
    """Return the sets of these names, all without names, each once and in the order of the list."""
    wanted = [load(name).name for name in names] or NAMES
    return (ValidationSet(name) for name in NAMES if name in wanted)


def index() -> str:
    """Return the index of the data, which holds the rule and the bands of all sets."""
    return (files(__package__) / "README.md").read_text(encoding="utf-8")


def _si(value: str | float) -> float:
    return to_si(value, si_unit(unit_of(value))) if isinstance(value, str) else float(value)


def _input(name: str, entry: Mapping[str, Any]) -> Input:
    value = _si(entry["value"])
    low, high = map(_si, entry.get("band", (entry["value"], entry["value"])))
    return Input(
        name,
        value,
        low,
        high,
        str(entry["value"]),
        str(entry.get("source", "")),
        str(entry.get("assumed", "")),
    )


def _band(name: str, entry: Mapping[str, Any]) -> Band:
    given = dict(entry)
    if "covers" in given:
        low, high = given["covers"]
        given["covers"] = (float(low), float(high))
    return Band(name=name, **given)


@dataclass(frozen=True)
class Varied:
    """Values at the inputs and at the ends of their bands."""

    values: FloatArray  #: At the inputs as given, shape (n,).
    #: By input: values at the lower and the upper end of its band, shape (2, n).
    ends: Mapping[str, FloatArray]

    @property
    def sides(self) -> FloatArray:
        """Widths of the intervals below and above the values, shape (2, n); see :func:`sides_of`."""
        return sides_of(self.values, self.ends.values())

    def sides_at(self, k: int) -> Sides:
        """Return the widths of the interval of one value, below and above it."""
        below, above = self.sides[:, k]
        return float(below), float(above)

    def spread(self, *names: str) -> FloatArray:
        """Return the lowest and highest values over the bands of some inputs, shape (2, n)."""
        values = np.vstack([self.values, *(self.ends[name] for name in names)])
        return np.array([values.min(axis=0), values.max(axis=0)])


def sides_of(values: FloatArray, ends: Iterable[FloatArray]) -> FloatArray:
    """Return the root sum of squares of the largest changes by each input, below and above the values.

    An input that only lowers a value widens its interval below and not above.

    ``values``: shape (n,); ``ends``: for each input the values at other inputs, shape (m, n). Returns shape
    (2, n).
    """
    squares = np.zeros((2, *values.shape))
    for found in ends:
        change = found - values
        squares += np.square([np.minimum(change, 0.0).min(axis=0), np.maximum(change, 0.0).max(axis=0)])
    return np.asarray(np.sqrt(squares))


def varied(compute: Callable[[Mapping[str, float]], FloatArray], inputs: Iterable[Input]) -> Varied:
    """Return values of a function at inputs and at the ends of their bands, one input at a time.

    ``compute``: from inputs by name [SI] to values, shape (n,); ``inputs``: the inputs; those without a band
    keep their value.
    """
    known = list(inputs)
    given = {one.name: one.value for one in known}
    ends = {
        one.name: np.array([compute(given | {one.name: end}) for end in (one.low, one.high)])
        for one in known
        if one.low != one.high
    }
    return Varied(compute(given), ends)
