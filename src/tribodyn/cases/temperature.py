"""Temperatures of a case, and what follows from them for a bushing and its material."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal, cast

from tribodyn.cases.case import Group, demand
from tribodyn.cases.fields import Numbers, choice, quantity, series
from tribodyn.cases.groups import Bushing, Surfaces
from tribodyn.cases.joint import LinerKeys, PlainJoint
from tribodyn.cases.keys import ASSUMED, Value
from tribodyn.cases.materials import between

if TYPE_CHECKING:
    from tribodyn.joints import BushingGeometry
    from tribodyn.joints.expansion import Casing

_FOLLOWING: Final = {
    "young_modulus": "surfaces.bushing.young_modulus",
    "hardness": "surfaces.bushing.hardness",
    "friction_coefficient": "joint.friction_coefficient",
    "specific_wear_rate": "wear.specific_wear_rate",
}
"""What a table over the temperature may hold, and the key that takes the value at that of the bushing."""


class PropertiesKeys(Group):
    """The bushing's material over the temperature; linear between rows; keys that are given go first."""

    temperatures: Numbers | None = series(
        "at which the others are given", "", unit="degC", example='"20, 200, 400 degC"'
    )
    young_modulus: Numbers | None = series(
        "Young's modulus of the bushing", "", unit="GPa", example='"3.2, 2.4, 1.6 GPa"'
    )
    hardness: Numbers | None = series("its hardness", "", unit="MPa", example='"300, 220, 140 MPa"')
    friction_coefficient: Numbers | None = series("of the joint", "", example="[0.3, 0.2, 0.15]")
    specific_wear_rate: Numbers | None = series(
        "of the bushing", "", unit="m^2/N", example='"1e-15, 2e-15, 5e-15 m^2/N"'
    )

    def derived(self) -> dict[str, str]:
        """Return from where the values of keys come that follow from these tables."""
        given = (key for key in _FOLLOWING if getattr(self, key) is not None)
        return {_FOLLOWING[key]: f"temperature.properties.{key}" for key in given}


@dataclass(frozen=True)
class Names:
    """What keys begin with that a refusal names: of the joint, of its temperatures, of its surfaces."""

    clearance: str = "joint.clearance"
    joint: str = "joint."
    temperature: str = "temperature."
    surfaces: str = ""


class Temperatures(Group):
    """Temperatures of assembly and of the run; a part without one stays at that of assembly."""

    assembly: float = quantity("20 degC", "at which clearance and radius are given", ASSUMED, gt=0)
    trunnion: float | None = quantity(None, "of the trunnion in the run", "", gt=0, example="300 degC")
    bushing: float | None = quantity(None, "of the bushing in the run", "", gt=0, example="300 degC")
    casing: float | None = quantity(
        None, "of what the bushing is bonded into, in the run", "", gt=0, example="250 degC"
    )
    fit: Literal["free", "bonded"] = choice(
        "free", "a bushing that expands freely, or a sleeve bonded into a casing", ASSUMED
    )
    casing_expansion: float | None = quantity(
        None, "thermal expansion of the casing", "", ge=0, example="11e-6 1/K"
    )

    @property
    def changes(self) -> bool:
        """Whether a part has a temperature of its own."""
        return (self.trunnion, self.bushing, self.casing) != (None, None, None)

    def strains(self, surfaces: Surfaces, names: Names = Names()) -> tuple[float, float]:
        """Return the free thermal strains αΔT of trunnion and bushing [1]."""
        key = f"{names.surfaces}surfaces.{{}}.thermal_expansion".format
        return (
            self._strain(self.trunnion, surfaces.trunnion.thermal_expansion, key("trunnion")),
            self._strain(self.bushing, surfaces.bushing.thermal_expansion, key("bushing")),
        )

    def hot(
        self, cold: BushingGeometry, surfaces: Surfaces, liner: LinerKeys, names: Names = Names()
    ) -> BushingGeometry:
        """Return the dimensions of a joint at these temperatures.

        Parameters
        ----------
        cold
            Those at assembly.
        surfaces, liner
            Of the joint.
        names
            Of keys that are refused.

        Raises
        ------
        InputError
            A thermal expansion is not given, or no clearance is left.
        """
        from tribodyn.joints.expansion import expanded

        if not self.changes:
            return cold
        trunnion, bushing = self.strains(surfaces, names)
        casing = self._casing(surfaces.bushing, liner, names) if self.fit == "bonded" else None
        return expanded(cold, trunnion=trunnion, bushing=bushing, casing=casing, key=names.clearance)

    def _casing(self, bushing: Bushing, liner: LinerKeys, names: Names) -> Casing:
        from tribodyn.joints.expansion import Casing

        layer = liner.layer(bushing, f"{names.joint}liner")
        if layer is None:
            demand(False, f"{names.joint}liner.thickness", "a bonded sleeve needs its thickness")
            raise AssertionError
        key = f"{names.temperature}casing_expansion"
        strain = self._strain(self.casing, self.casing_expansion, key)
        return Casing(strain, layer.thickness, layer.poisson_ratio)

    def _strain(self, temperature: float | None, expansion: float | None, key: str) -> float:
        """Return αΔT."""
        if temperature is None or temperature == self.assembly:
            return 0.0
        demand(expansion is not None, key, "needed: this part is not as warm as at assembly")
        return (expansion or 0.0) * (temperature - self.assembly)


class Temperature(Temperatures):
    """Temperatures of assembly and of the run, and the material over them."""

    properties: PropertiesKeys = PropertiesKeys()

    @staticmethod
    def resolve(given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the material at the temperature of the bushing, where a table gives it."""
        prefix = "temperature.properties."
        places = given.get(f"{prefix}temperatures")
        columns = {key: given[prefix + key] for key in _FOLLOWING if prefix + key in given}
        if places is None or not columns:
            demand(not columns, f"{prefix}temperatures", "one for each value is needed")
            return {}
        where = given.get("temperature.bushing", given.get("temperature.assembly", 293.15))
        return {
            _FOLLOWING[key]: _between(
                cast("Numbers", places), cast("Numbers", values), cast("float", where), key
            )
            for key, values in columns.items()
        }

    def dimensions(self, joint: PlainJoint, surfaces: Surfaces) -> BushingGeometry:
        """Return the dimensions of the joint of a case at these temperatures, see :meth:`hot`."""
        # Imported here: reading a case needs no compiled code.
        from tribodyn.joints import BushingGeometry

        cold = BushingGeometry(joint.clearance, joint.radius, joint.length)
        return self.hot(cold, surfaces, joint.liner)


def _between(places: Numbers, values: Numbers, at: float, key: str) -> float:
    """Return the value of a table at a temperature [K]."""
    path = f"temperature.properties.{key}"
    demand(len(values) == len(places), path, f"there are {len(values)} values for {len(places)} temperatures")
    demand(
        len(places) > 1 and all(a < b for a, b in itertools.pairwise(places)),
        "temperature.properties.temperatures",
        "two temperatures at least, each above the one before it",
    )
    demand(
        places[0] <= at <= places[-1],
        path,
        f"the table ends at {places[0]:g} K and {places[-1]:g} K, the bushing has {at:g} K",
    )
    return between(places, values, at)
