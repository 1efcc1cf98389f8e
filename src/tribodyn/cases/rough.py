"""Common parts of cases with one pair of rough surfaces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from tribodyn.cases import materials
from tribodyn.cases.beyond import FollowedTable, of_tables
from tribodyn.cases.case import Case, demand
from tribodyn.cases.groups import AsperityKeys, Contact, Surfaces
from tribodyn.cases.joint import PlainJoint
from tribodyn.cases.keys import Value, keys_of
from tribodyn.cases.messages import Remarks
from tribodyn.cases.remarks import of_surfaces
from tribodyn.cases.temperature import Temperature

if TYPE_CHECKING:
    from tribodyn.contact import SurfacePair


class RoughCase(Case):
    """A case with one pair of rough surfaces."""

    surfaces: Surfaces = Surfaces()
    asperities: AsperityKeys = AsperityKeys()
    contact: Contact = Contact()

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from the materials and from the contact law."""
        return materials.resolve(given, keys_of(cls)) | Contact.resolve(given)

    def followed(self) -> Iterable[FollowedTable]:
        """Return the tables that loads, drives and temperatures follow; by default there are none."""
        return ()

    def remarks(self) -> Remarks:
        """Return remarks on the two surfaces and on tables."""
        return super().remarks() + of_surfaces(self) + of_tables(self.followed())

    def rough_clearances(self) -> dict[str, float]:
        """Return the combined rms roughness σ of bushing and trunnion [m] by the path of their clearance."""
        return {"joint.clearance": self.surface_pair.roughness_rms}

    @property
    def surface_pair(self) -> SurfacePair:
        """The two surfaces in contact, as contact laws take them."""
        return self.surfaces.pair(self.asperities)

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the checks of the contact law."""
        return (lambda: self.contact.check(self.surface_pair),)


class BushingCase(RoughCase):
    """A case with one clearance joint, between these surfaces."""

    joint: PlainJoint = PlainJoint()
    temperature: Temperature = Temperature()

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from materials, the contact law and temperatures."""
        at_temperature = Temperature.resolve(given)
        for path in at_temperature.keys() - keys_of(cls).keys():
            key = f"temperature.properties.{path.rpartition('.')[2]}"
            demand(False, key, f"a case of this kind has no {path}")
        return super().resolve(given) | at_temperature

    def derived(self) -> dict[str, str]:
        """Return the properties of the material that follow from the temperature."""
        return self.temperature.properties.derived()

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the checks of contact law, liner and clearance."""
        return (*super().checks(), self._check_liner, self._check_clearance)

    def _check_liner(self) -> None:
        self.joint.liner.layer(self.surfaces.bushing)

    def _check_clearance(self) -> None:
        if self.temperature.changes:
            self.temperature.dimensions(self.joint, self.surfaces)
