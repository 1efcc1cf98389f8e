"""Pairs of surfaces that joints name: their keys."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tribodyn.cases.case import Group, NamedGroup
from tribodyn.cases.fields import number, quantity
from tribodyn.cases.groups import AsperityKeys, Contact, Surfaces
from tribodyn.cases.keys import ASSUMED

if TYPE_CHECKING:
    from tribodyn.contact import SurfacePair


def friction_of(which: str) -> Any:
    """Return the key of the coefficient of friction of some joints."""
    return number(
        0.1, f"coefficient of friction mu_f of {which}, unless a joint says otherwise", ASSUMED, ge=0, le=2
    )


class PairWear(Group):
    """Wear of the surfaces of a pair; that of the case without a material of their own."""

    specific_wear_rate: float = quantity(
        "1.1e-15 m^2/N", "specific wear rate C_w of the bushing", "paper, section 2.4", ge=0
    )
    partner_wear_rate: float = quantity(
        "0 m^2/N", "specific wear rate of what slides in it; both wear in proportion", ASSUMED, ge=0
    )
    final_roughness: float | None = quantity(
        None,
        "rms roughness that the bushing runs in to; that of the trunnion without it",
        ASSUMED,
        gt=0,
        example="0.4 um",
    )


class PairKeys(NamedGroup):
    """Surfaces, contact law, friction and wear of joints that name them."""

    surfaces: Surfaces = Surfaces()
    asperities: AsperityKeys = AsperityKeys()
    contact: Contact = Contact()
    friction_coefficient: float = friction_of("the joints of this pair")
    wear: PairWear = PairWear()

    @property
    def surface_pair(self) -> SurfacePair:
        """The two surfaces in contact, as contact laws take them."""
        return self.surfaces.pair(self.asperities)

    def model_post_init(self, context: object, /) -> None:
        """Check keys against each other."""
        self.contact.check(self.surface_pair)
