"""The library of materials: typical properties with their sources, and what a case takes from them.

A case names a material, as in ``surfaces.bushing.material = "ptfe-liner"``. Keys beside it, and a table over
the temperature, go before it. Keys that the library does not have keep
their defaults; both are reported.
"""

import math
import tomllib
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final

from tribodyn.cases.keys import Key, Value
from tribodyn.cases.units import from_si, to_si

MATERIAL: Final = "material"
#: Properties that a surface takes, with the units they are shown in; the trunnion has no hardness.
OF_SURFACE: Final = {
    "young_modulus": "GPa",
    "poisson_ratio": "",
    "hardness": "MPa",
    "thermal_expansion": "1/K",
    "loss_factor": "",
}
#: Properties of sliding against steel: unit, and keys, if a case has them, that take those of the bushing.
OF_PAIR: Final = {
    "friction_coefficient": ("", ("joint.friction_coefficient", "friction_coefficient")),
    "specific_wear_rate": ("m^2/N", ("wear.specific_wear_rate",)),
    "wear_scatter": ("", ()),
}
SURFACES: Final = ("trunnion", "bushing")
_UNITS: Final = OF_SURFACE | {name: unit for name, (unit, _) in OF_PAIR.items()}
_WEAR_RATE: Final = "specific_wear_rate"
_SCATTER: Final = "wear_scatter"
#: Whose range of wear rates and whose scatter hold for a liner without a name or without data of its own.
_UNNAMED: Final = "ptfe-liner"
_ROOM: Final = 293.15
_FAR: Final = 50.0  #: Distance [K] from the temperatures of a property from which on it is reported.


@dataclass(frozen=True)
class Property:
    """One property of a material."""

    values: tuple[float, ...]  #: One, or as many as there are temperatures; SI units.
    temperatures: tuple[float, ...]  #: At which they hold [K].
    #: Ends of the range that the value is the middle of; SI units; None for a single value.
    spread: tuple[float, float] | None
    #: Where it stands, and what it holds for.
    source: str
    validity: str

    def at(self, temperature: float = _ROOM) -> float:
        """Return the value [SI] at a temperature [K]; beyond the table that of its end."""
        if len(self.values) == 1:
            return self.values[0]
        inside = min(max(temperature, self.temperatures[0]), self.temperatures[-1])
        return between(self.temperatures, self.values, inside)

    def is_far(self, temperature: float) -> bool:
        """Tell whether a temperature [K] is far from those the property is known at."""
        known = self.temperatures or (_ROOM,)
        return not known[0] - _FAR <= temperature <= known[-1] + _FAR


@dataclass(frozen=True)
class Material:
    """A material of the library."""

    #: What a case calls it, and what it is.
    name: str
    title: str
    properties: Mapping[str, Property]  #: By the names of keys.

    def __getattr__(self, name: str) -> float:
        """Return the value of a property at room temperature [SI]."""
        known: Mapping[str, Property] = self.__dict__.get("properties", {})
        if name in known:
            return known[name].at()
        raise AttributeError(f"{self.__dict__.get('name')}: no source gives {name}")

    def __str__(self) -> str:
        """Return the material with every property and its source, a line each, and what is not known."""
        lines = [f"{self.name}: {self.title}"]
        for name, known in self.properties.items():
            lines.append(f"  {name:<22} {written(name, known):<28} {known.validity}; {known.source}")
        if self.unknown:
            lines.append(f"  not known: {', '.join(self.unknown)}")
        return "\n".join(lines)

    @property
    def unknown(self) -> tuple[str, ...]:
        """Properties that no source gives, by the names of keys."""
        return tuple(name for name in _UNITS if name not in self.properties and name != _SCATTER)


def wear_scatter(given: object, material: str | None, at: float) -> tuple[float, float]:
    """Return the interval of the wear of equal parts, over that at the rate of a case [1].

    It contains the scatter of equal parts and, for the middle of a range of published rates, that range.

    ``given``: specific wear rate as the case gives it, None if nobody wrote it down; ``material``: material
    of the bushing, None without a name; ``at``: specific wear rate that the case holds [m²/N].
    """
    known = MATERIALS[material or _UNNAMED].properties
    scatter, rate = (
        known.get(_SCATTER, MATERIALS[_UNNAMED].properties[_SCATTER]).spread,
        known.get(_WEAR_RATE),
    )
    assert scatter is not None
    published = given is None if material is None else rate is not None and rate.at() == at
    middle = 1.0 if rate is None else rate.at()
    ends = rate.spread if rate is not None and rate.spread is not None and published else (middle, middle)
    return min(scatter[0], ends[0] / middle), max(scatter[1], ends[1] / middle)


def between(places: Sequence[float], values: Sequence[float], at: float) -> float:
    """Return the value of a table at a place inside it, linear between rows."""
    upper = max(1, bisect_left(places, at))
    share = (at - places[upper - 1]) / (places[upper] - places[upper - 1])
    return values[upper - 1] + share * (values[upper] - values[upper - 1])


def written(name: str, known: Property) -> str:
    """Return a property as a person writes it: a value, a range, or the ends of a table."""
    unit = _UNITS[name]
    many = known.spread or known.values
    rounded = dict.fromkeys(f"{value:.6g}" for value in (many[0], many[-1]))
    return " to ".join(from_si(float(number), unit) if unit else number for number in rounded)


def _read(name: str, table: Mapping[str, Any], sources: Mapping[str, str]) -> Property:
    given = table.get("range", table.get("value"))
    many = given if isinstance(given, list) else [given]
    values = tuple(to_si(one, _UNITS[name]) if _UNITS[name] else float(one) for one in many)
    spread = (values[0], values[1]) if "range" in table else None
    if spread is not None:
        mean = math.sqrt(spread[0] * spread[1]) if name == "specific_wear_rate" else 0.5 * sum(spread)
        values = (mean,)
    places = tuple(to_si(text, "K") for text in table.get("temperatures", ()))
    return Property(values, places, spread, sources[table["source"]], table["validity"])


def _library() -> dict[str, Material]:
    tables = tomllib.loads(files("tribodyn.cases").joinpath("materials.toml").read_text(encoding="utf-8"))
    sources = tables.pop("sources")
    return {
        name: Material(
            name, table.pop("title"), {key: _read(key, inside, sources) for key, inside in table.items()}
        )
        for name, table in tables.items()
    }


MATERIALS: Final[Mapping[str, Material]] = _library()  #: Every material by its name.


def resolve(given: Mapping[str, Value], keys: Mapping[str, Key], prefix: str = "") -> dict[str, Value]:
    """Return the values that named materials give to a set of surfaces.

    ``given``: what was given, by dotted path; ``keys``: those of the case: of what it has none, nothing is
    returned; ``prefix``: what stands before the paths of this set of surfaces.
    """
    found: dict[str, Value] = {}
    for surface in SURFACES:
        name = given.get(f"{prefix}surfaces.{surface}.{MATERIAL}")
        if name not in MATERIALS:
            continue
        for key, path in taken(surface, prefix):
            known = MATERIALS[str(name)].properties.get(key)
            if known is not None and path in keys:
                found[path] = known.at(warmth(given, surface))
    return found


def warmth(values: Mapping[str, Value | None], surface: str) -> float:
    """Return the temperature [K] of a surface, given those of a case."""
    found = values.get(f"temperature.{surface}") or values.get("temperature.assembly") or _ROOM
    assert isinstance(found, float)
    return found


def taken(surface: str, prefix: str = "") -> Iterator[tuple[str, str]]:
    """Yield the properties that a surface takes of its material, each with the path of its key."""
    for key in OF_SURFACE:
        yield key, f"{prefix}surfaces.{surface}.{key}"
    if surface == "bushing":
        yield from ((key, prefix + path) for key, (_, paths) in OF_PAIR.items() for path in paths)
