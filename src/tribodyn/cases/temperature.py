"""Temperatures of a case, and what follows from them for a bushing and its material."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Final, Literal, Protocol, cast

from tribodyn.cases.case import Group, demand
from tribodyn.cases.fields import Numbers, choice, quantity, series
from tribodyn.cases.groups import Surfaces
from tribodyn.cases.joint_keys import LinerKeys, PlainJoint
from tribodyn.cases.keys import ASSUMED, Value
from tribodyn.cases.materials import between
from tribodyn.cases.signals import TemperatureTable

if TYPE_CHECKING:
    from tribodyn.core.signals import Signal
    from tribodyn.joints.expansion import Casing
    from tribodyn.joints.shapes import Cylinder

PARTS: Final = ("trunnion", "bushing", "casing")
OVER_TIME: Final = "temperature.over_time"
#: Properties of a table over the temperature, and the key that takes the value at that of the bushing.
_FOLLOWING: Final = {
    "young_modulus": "surfaces.bushing.young_modulus",
    "hardness": "surfaces.bushing.hardness",
    "friction_coefficient": "joint.friction_coefficient",
    "specific_wear_rate": "wear.specific_wear_rate",
}


class InCycles(Protocol):
    """A case whose wear campaign takes cycles."""

    @property
    def duration(self) -> float: ...  # noqa: D102

    @property
    def period(self) -> float | None: ...  # noqa: D102

    @property
    def campaign_cycles(self) -> int: ...  # noqa: D102

    @property
    def settling_cycles(self) -> int: ...  # noqa: D102


def time_followed(case: InCycles) -> float:
    """Return the time over which temperatures are followed [s]: the run, or all cycles of its campaign."""
    if not case.campaign_cycles or case.period is None:
        return case.duration
    return (case.settling_cycles + case.campaign_cycles + 1) * case.period


def times_of(tables: Iterable[TemperatureTable]) -> tuple[float, ...]:
    """Return the times of the rows of some tables [s], increasing."""
    return tuple(sorted({time for table in tables for time in table.knots}))


class PropertiesKeys(Group):
    """The bushing's material over the temperature; linear between rows; keys that are given go first."""

    temperatures: Numbers | None = series(
        "at which the others are given", unit="degC", example='"20, 200, 400 degC"'
    )
    young_modulus: Numbers | None = series(
        "Young's modulus of the bushing", unit="GPa", example='"3.2, 2.4, 1.6 GPa"'
    )
    hardness: Numbers | None = series(
        "hardness at these temperatures", unit="MPa", example='"300, 220, 140 MPa"'
    )
    friction_coefficient: Numbers | None = series("of the joint", example="[0.3, 0.2, 0.15]")
    specific_wear_rate: Numbers | None = series(
        "of the bushing", unit="m^2/N", example='"1e-15, 2e-15, 5e-15 m^2/N"'
    )

    def values_at(self, first: float, second: float) -> dict[str, tuple[float, float]]:
        """Return the values at two temperatures of the bushing [K], by keys; of tables that hold both."""
        places = self.temperatures or ()
        if not places or min(first, second) < places[0] or max(first, second) > places[-1]:
            return {}
        tables = {path: getattr(self, key) for key, path in _FOLLOWING.items()}
        return {
            path: (between(places, values, first), between(places, values, second))
            for path, values in tables.items()
            if values
        }

    def at(self, temperature: float, prefix: str) -> dict[str, float]:
        """Return the values at a temperature of the bushing [K], by the keys that take them.

        ``prefix`` is what the keys of this table begin with. Raises ``InputError`` outside of the table.
        """
        given = {key: getattr(self, key) for key in _FOLLOWING if getattr(self, key) is not None}
        return _values_at(self.temperatures, given, temperature, prefix)

    def derived(self) -> dict[str, str]:
        """Return from where the values of keys come that follow from these tables."""
        given = (key for key in _FOLLOWING if getattr(self, key) is not None)
        return {_FOLLOWING[key]: f"temperature.properties.{key}" for key in given}


@dataclass(frozen=True)
class Names:
    """Prefixes of keys in messages: of the joint, of its temperatures, of its surfaces."""

    clearance: str = "joint.clearance"
    joint: str = "joint."
    temperature: str = "temperature."
    surfaces: str = ""


class OverTime(Group):
    """Temperatures that follow time, from the start of a run on."""

    trunnion: TemperatureTable | None = None
    bushing: TemperatureTable | None = None
    casing: TemperatureTable | None = None


class Temperature(Group):
    """Temperatures of assembly and of the run, constant or over time."""

    assembly: float = quantity("20 degC", "at which clearance and radius are given", ASSUMED, gt=0)
    trunnion: float | None = quantity(None, "of the trunnion in the run", gt=0, example="300 degC")
    bushing: float | None = quantity(None, "of the bushing in the run", gt=0, example="300 degC")
    casing: float | None = quantity(
        None, "of what the bushing is bonded into, in the run", gt=0, example="250 degC"
    )
    fit: Literal["free", "bonded"] = choice(
        "free", "a bushing that expands freely, or a sleeve bonded into a casing", ASSUMED
    )
    casing_expansion: float | None = quantity(
        None, "thermal expansion of the casing", ge=0, example="11e-6 1/K"
    )
    properties: PropertiesKeys = PropertiesKeys()
    over_time: OverTime = OverTime()

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = tuple(
        (part, f"over_time.{part}.{key}") for part in PARTS for key in TemperatureTable.model_fields
    )

    @property
    def changes(self) -> bool:
        """Whether a part has a temperature of its own."""
        return any(temperature is not None for temperature in self.at_start.values())

    def strains(self, surfaces: Surfaces, names: Names = Names()) -> tuple[float, float]:
        """Return the free thermal strains αΔT of trunnion and bushing [1]."""
        return self._strain("trunnion", surfaces, names), self._strain("bushing", surfaces, names)

    def hot(self, cold: Cylinder, surfaces: Surfaces, liner: LinerKeys, names: Names = Names()) -> Cylinder:
        """Return the dimensions of a joint at these temperatures, those where a run begins.

        ``cold``: those at assembly; ``surfaces``, ``liner``: of the joint; ``names``: of keys that are
        refused. Raises InputError if a thermal expansion is not given, or no clearance is left.
        """
        from tribodyn.joints.expansion import expanded

        if not self.changes:
            return cold
        trunnion, bushing = self.strains(surfaces, names)
        casing = self._casing(surfaces, liner, names)
        return expanded(cold, trunnion=trunnion, bushing=bushing, casing=casing, key=names.clearance)

    def _casing(self, surfaces: Surfaces, liner: LinerKeys, names: Names) -> Casing | None:
        if self.fit == "free":
            return None
        from tribodyn.joints.expansion import Casing

        layer = liner.layer(surfaces.bushing, f"{names.joint}liner")
        if layer is None:
            demand(False, f"{names.joint}liner.thickness", "a bonded sleeve needs its thickness")
            raise AssertionError
        return Casing(self._strain("casing", surfaces, names), layer.thickness, layer.poisson_ratio)

    def _strain(self, part: str, surfaces: Surfaces, names: Names) -> float:
        """Return αΔT of a part where a run begins."""
        temperature = self.at_start[part]
        if temperature is None or temperature == self.assembly:
            return 0.0
        return self._expansion(part, surfaces, names) * (temperature - self.assembly)

    def _expansion(self, part: str, surfaces: Surfaces, names: Names) -> float:
        """Return α of a part [1/K]."""
        if part == "casing":
            key, expansion = f"{names.temperature}casing_expansion", self.casing_expansion
        else:
            key = f"{names.surfaces}surfaces.{part}.thermal_expansion"
            expansion = getattr(surfaces, part).thermal_expansion
        demand(expansion is not None, key, "needed: this part is not as warm as at assembly")
        return float(expansion or 0.0)

    @staticmethod
    def resolve(given: Mapping[str, Value], prefix: str = "temperature.") -> dict[str, Value]:
        """Return the material at the temperature of the bushing, where a table gives it.

        ``prefix`` is what the keys of these temperatures begin with.
        """
        properties = f"{prefix}properties."
        columns = {key: given[properties + key] for key in _FOLLOWING if properties + key in given}
        at_assembly = given.get(f"{prefix}assembly", 293.15)
        table = cast("Numbers | None", given.get(f"{prefix}over_time.bushing.values"))
        where = table[0] if table else given.get(f"{prefix}bushing", at_assembly)
        places = cast("Numbers | None", given.get(f"{properties}temperatures"))
        values = cast("Mapping[str, Numbers]", columns)
        return dict(_values_at(places, values, cast("float", where), properties))

    def material(self, prefix: str = "temperature.") -> dict[str, float]:
        """Return the properties at the start of a run, by the keys that take them; ``prefix`` as for keys."""
        return self.properties.at(self.at_start["bushing"] or self.assembly, f"{prefix}properties.")

    @property
    def properties_at_start(self) -> dict[str, tuple[float, float]]:
        """Properties at assembly and at the start of a run, by keys; of tables that hold both."""
        return self.properties.values_at(self.assembly, self.at_start["bushing"] or self.assembly)

    def dimensions(self, joint: PlainJoint, surfaces: Surfaces) -> Cylinder:
        """Return the dimensions of the joint of a case at these temperatures, see :meth:`hot`."""
        return self.hot(cold_geometry(joint), surfaces, joint.liner)

    @property
    def tables(self) -> dict[str, TemperatureTable]:
        """Temperatures that follow time, by the part."""
        found = {part: getattr(self.over_time, part) for part in PARTS}
        return {part: table for part, table in found.items() if table is not None}

    @property
    def at_start(self) -> dict[str, float | None]:
        """Temperature of each part where a run begins [K]."""
        constant = {part: getattr(self, part) for part in PARTS}
        return constant | {part: table.curve().at_start for part, table in self.tables.items()}

    def opening(
        self, cold: Cylinder, surfaces: Surfaces, liner: LinerKeys, names: Names = Names()
    ) -> Signal | None:
        """Return the growth of the clearance since the start, over time [m, s]; None where it is constant.

        Arguments as for :meth:`hot`.

        Raises InputError if a table does not begin with the run, or a thermal expansion is not given.
        """
        if not self.tables:
            return None
        from tribodyn.joints.expansion import clearance_rates

        rates = clearance_rates(cold, self._casing(surfaces, liner, names))
        for part, table in self.tables.items():
            key = f"{names.temperature}over_time.{part}"
            words = 'a free bushing follows no casing: temperature.fit = "bonded" is needed'
            demand(part in rates, key, words)
            demand(table.knots[0] == 0.0, key, f"the table begins at {table.knots[0]:g} s, a run at 0 s")
        return self._change(rates, surfaces, names)

    def play_opening(
        self, length: float, play: float, surfaces: Surfaces, names: Names = Names()
    ) -> Signal | None:
        """Return the growth of the play along the axis since the start, over time [m, s]; None if constant.

        ``length``, ``play``: of the bore, and what the shaft has more between its flanges, at assembly [m];
        ``surfaces``, ``names``: as for :meth:`hot`.
        """
        bore = "bushing" if self.fit == "free" else "casing"
        return self._change({"trunnion": length + play, bore: -length}, surfaces, names)

    def _change(self, rates: Mapping[str, float], surfaces: Surfaces, names: Names) -> Signal | None:
        """Return Σ rate αΔT [m] over time, zero at the start, of those parts whose temperature changes."""
        from tribodyn.core.signals import summed

        tables = {part: table for part, table in self.tables.items() if part in rates}
        if not tables:
            return None
        factors = {part: rates[part] * self._expansion(part, surfaces, names) for part in tables}
        whole = summed([(table.curve(), factors[part]) for part, table in tables.items()])
        return replace(whole, coefficients=whole.coefficients - [[0.0], [0.0], [0.0], [whole.at_start]])

    def check(
        self, cold: Cylinder, surfaces: Surfaces, liner: LinerKeys, duration: float, names: Names = Names()
    ) -> None:
        """Refuse temperatures that leave no clearance in a run of ``duration`` [s]."""
        opening = self.opening(cold, surfaces, liner, names)
        if opening is None:
            return
        clearance = self.hot(cold, surfaces, liner, names).clearance
        when, least = opening.least(duration)
        words = (
            f"the joint would seize: {when:.4g} s after the start the trunnion is "
            f"{-1e6 * (clearance + least):.3g} um larger in radius than its bushing"
        )
        demand(clearance + least > 0.0, f"{names.temperature}over_time", words)


def cold_geometry(joint: PlainJoint) -> Cylinder:
    """Return the dimensions of a joint at assembly."""
    # Imported here: reading a case needs no compiled code.
    from tribodyn.joints.shapes import Cylinder

    return Cylinder(joint.radius, joint.clearance, joint.length)


def _values_at(
    places: Numbers | None, columns: Mapping[str, Numbers], at: float, prefix: str
) -> dict[str, float]:
    """Return the values of tables at a temperature [K], by the keys that take them."""
    demand(places is not None or not columns, f"{prefix}temperatures", "one for each value is needed")
    return {
        _FOLLOWING[key]: _between(places or (), values, at, f"{prefix}{key}", f"{prefix}temperatures")
        for key, values in columns.items()
    }


def _between(places: Numbers, values: Numbers, at: float, path: str, key: str) -> float:
    """Return the value of a table at a temperature [K]; ``key`` is that of its places."""
    demand(len(values) == len(places), path, f"there are {len(values)} values for {len(places)} temperatures")
    demand(
        len(places) > 1 and all(a < b for a, b in itertools.pairwise(places)),
        key,
        "two temperatures at least, each above the one before it",
    )
    demand(
        places[0] <= at <= places[-1],
        path,
        f"the table ends at {places[0]:g} K and {places[-1]:g} K, the bushing has {at:g} K",
    )
    return between(places, values, at)
