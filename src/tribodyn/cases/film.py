"""The oil film between two rough surfaces: its keys."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.fields import choice, count, number, quantity, switch
from tribodyn.cases.keys import ASSUMED

if TYPE_CHECKING:
    from tribodyn.cases.groups import Surfaces
    from tribodyn.joints import BushingGeometry
    from tribodyn.lubrication import Film

SECTION_4 = "paper, section 4.2"


class FilmGridKeys(NamedGroup):
    """Cells of the film."""

    theta: int = count(96, "cells around the bushing", ASSUMED, ge=8, le=4096)
    z: int = count(16, "cells along the bushing, an even number", ASSUMED, ge=4, le=1024)

    def model_post_init(self, context: object, /) -> None:
        """Check that there is a middle row of nodes."""
        demand(self.z % 2 == 0, "z", "the film needs an even number of cells along the bushing")


class FilmKeys(Group):
    """The oil film: average Reynolds equation."""

    viscosity: float = quantity("0.01 Pa s", "viscosity eta", SECTION_4, gt=0)
    cavitation: Literal["reynolds", "half-sommerfeld", "none"] = choice(
        "reynolds", "p >= 0 solved as such, negative pressures cut off, or negative pressures kept", SECTION_4
    )
    boundary: Literal["periodic", "groove"] = choice(
        "periodic", "film unbroken around the bushing, or p = 0 on the line of maximum gap", ASSUMED
    )
    peklenik_journal: float = number(
        1.0, "Peklenik number gamma_1 of the shaft's surface; 1 is isotropic", ASSUMED, ge=1 / 9, le=9
    )
    peklenik_bushing: float = number(
        1.0, "Peklenik number gamma_2 of the bushing's surface", ASSUMED, ge=1 / 9, le=9
    )
    rough_flow: bool = switch(
        True, "whether flow, shear and contact factors of rough surfaces act", "paper, Eq. 52"
    )
    grid: FilmGridKeys = FilmGridKeys()

    def film(self, size: BushingGeometry, surfaces: Surfaces) -> Film:
        """Return the film in a bushing of a size between two rough surfaces."""
        from tribodyn.lubrication import Film, FilmGrid, Roughness

        rms = (surfaces.trunnion.roughness, surfaces.bushing.roughness) if self.rough_flow else (0.0, 0.0)
        return Film(
            viscosity=self.viscosity,
            clearance=size.clearance,
            radius=size.radius,
            length=size.length,
            roughness=Roughness(rms, (self.peklenik_journal, self.peklenik_bushing)),
            cavitation=self.cavitation,
            boundary=self.boundary,
            grid=FilmGrid(self.grid.theta, self.grid.z),
        )


class OptionalFilmKeys(FilmKeys):
    """The oil film of a case that is dry unless its keys say otherwise."""

    lubricated: bool = switch(False, "whether there is oil in the clearance", SECTION_4)
