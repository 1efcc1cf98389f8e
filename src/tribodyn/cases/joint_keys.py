"""Tables of keys of a clearance joint: a shaft in a bushing, its sleeve, its form, its oil film, its wear."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Final, Literal

from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.fields import Numbers, choice, count, number, quantity, series, switch
from tribodyn.cases.groups import TABLE_1, Bushing
from tribodyn.cases.keys import ASSUMED
from tribodyn.cases.signals import BoreMap, ProfileTable

if TYPE_CHECKING:
    from tribodyn.cases.groups import Surfaces
    from tribodyn.contact import Liner
    from tribodyn.joints import Form
    from tribodyn.joints.shapes import Cylinder
    from tribodyn.lubrication import Film


#: The contact over the surface, by its name in :data:`tribodyn.joints.CONTACTS`, which is slow to import.
SURFACE: Final = "surface"


class LinerKeys(Group):
    """An elastic sleeve in a rigid bore; without a thickness the bushing is rigid below its asperities."""

    thickness: float | None = quantity(None, "thickness t", ASSUMED, gt=0, example="1.5 mm")
    young_modulus: float | None = quantity(
        None, "Young's modulus; by default that of the bushing", ASSUMED, gt=0, example="7.17 GPa"
    )
    poisson_ratio: float | None = number(
        None, "Poisson's ratio; by default that of the bushing", ASSUMED, gt=0, lt=0.5, example="0.34"
    )

    def check_contact(self, contact: str, joint: str = "joint.") -> None:
        """Refuse a liner below a contact at points; ``joint`` is what keys of the joint begin with."""
        demand(
            contact == SURFACE or self.thickness is None,
            f"{joint}liner.thickness",
            f'a contact at points stands on no liner: {joint}contact = "surface" is needed',
        )

    def layer(self, bushing: Bushing, key: str = "joint.liner") -> Liner | None:
        """Return the layer, or None where the bushing is rigid below its asperities; ``key`` is its table."""
        from tribodyn.contact import Liner

        if self.thickness is None:
            return None
        modulus = bushing.young_modulus if self.young_modulus is None else self.young_modulus
        ratio = bushing.poisson_ratio if self.poisson_ratio is None else self.poisson_ratio
        demand(
            ratio < 0.5,
            f"{key}.poisson_ratio",
            "a thin layer that cannot change its volume does not yield: below 0.5 is needed",
        )
        demand(
            modulus >= bushing.hardness,
            f"{key}.young_modulus",
            f"a sleeve of {1e-6 * modulus:.4g} MPa yields before asperities of the hardness "
            f"{1e-6 * bushing.hardness:.4g} MPa do: give a stiffer sleeve, or the hardness of its material",
        )
        return Liner(self.thickness, modulus, ratio)


class FormKeys(Group):
    """Deviations of trunnion and bushing from cylinders; the clearance is that in the middle."""

    crown: float = quantity(
        "0 um", "drop of a parabola at the ends, of both surfaces together", ASSUMED, ge=0
    )
    chamfer_length: float | None = quantity(
        None, "straight run-out at both ends", ASSUMED, gt=0, example="0.5 mm"
    )
    chamfer_depth: float | None = quantity(
        None, "depth of the run-out at the end", ASSUMED, gt=0, example="20 um"
    )
    bushing: BoreMap | None = None
    trunnion: ProfileTable | None = None

    def form(self) -> Form:
        """Return the form of the joint."""
        from tribodyn.joints.rows import Bore, Form

        bore = self.bushing
        return Form(
            self.crown,
            self.chamfer_length or 0.0,
            self.chamfer_depth or 0.0,
            None if bore is None else Bore(bore.angles or (), bore.positions or (), bore.values or ()),
            None if self.trunnion is None else self.trunnion.curve(),
        )

    def check(self, contact: str, length: float, joint: str = "joint.") -> None:
        """Refuse a form that a joint cannot have.

        ``length``: of the bushing [m]; ``joint``: what keys of the joint begin with.
        """
        demand(
            (self.chamfer_length is None) == (self.chamfer_depth is None),
            f"{joint}form.chamfer_depth",
            "a chamfer has a length and a depth: give both or neither",
        )
        demand(
            contact == SURFACE or self == FormKeys(),
            f"{joint}form",
            f'a contact at points has no form: {joint}contact = "surface" is needed',
        )
        for name, measured in (("bushing", self.bushing), ("trunnion", self.trunnion)):
            places = () if measured is None else measured.positions or ()
            demand(
                not places or (places[0] <= -0.5 * length and 0.5 * length <= places[-1]),
                f"{joint}form.{name}.positions",
                f"they count from the middle of the bushing and must reach its ends at {500 * length:g} mm",
            )
        demand(
            (self.chamfer_length or 0.0) <= 0.4 * length,
            f"{joint}form.chamfer_length",
            f"two chamfers leave too little of {joint}length: at most 0.4 of it each",
        )


CONFORMAL, SLEEVE, NOTHING = "conformal", "sleeve", "none"  #: What yields under asperities.


class PlainJoint(Group):
    """The clearance joint: a trunnion in a bushing, with a thrust collar."""

    clearance: float = quantity("20 um", "radial clearance c", "paper, sections 4.1 and 5.2", gt=0)
    radius: float = quantity("6 mm", "radius of the trunnion r_j", TABLE_1, gt=0)
    length: float = quantity("20 mm", "length of the bushing l_z", TABLE_1, gt=0)
    contact: str = choice(
        SURFACE,
        "contact over the surface, or at one point of the clearance circle at each end",
        "paper, Eq. 44",
        family="tribodyn.joints:CONTACTS",
    )
    friction_coefficient: float = number(0.1, "coefficient of friction mu_f", ASSUMED, ge=0, le=2)
    friction: Literal["traction", "moment"] = choice(
        "traction",
        "traction along the actual slip, or the paper's moment alone",
        "depends on mechanism.formulation",
    )
    slip_velocity: float = quantity("10 um/s", "slip at which traction is fully developed u_s", ASSUMED, gt=0)
    bulk: Literal["conformal", "none"] | None = choice(
        None,
        "what yields under the asperities: shaft and bushing, or nothing; without it nothing, or both where "
        "asperities do not carry",
        example="conformal",
    )
    liner: LinerKeys = LinerKeys()
    form: FormKeys = FormKeys()
    collar_radius: float = quantity("12 mm", "radius of the thrust collar r_t", "paper, Table 2", gt=0)

    @property
    def may_yield(self) -> bool:
        """Whether there may be elastic bodies under its asperities."""
        return self.contact == SURFACE and self.liner.thickness is None

    def model_post_init(self, context: object, /) -> None:
        """Check that the clearance is small against the radius."""
        demand(
            self.clearance <= 0.1 * self.radius,
            "joint.clearance",
            "the clearance must not exceed a tenth of joint.radius",
        )
        words = "elastic bodies need a contact over the surface and no liner"
        demand(self.bulk != CONFORMAL or self.may_yield, "joint.bulk", words)
        self.liner.check_contact(self.contact)
        self.form.check(self.contact, self.length)


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

    def film(self, size: Cylinder, surfaces: Surfaces) -> Film:
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


class SurfaceWear(Group):
    """Wear rates of a pair of surfaces, and the scatter of equal parts."""

    KEYS_BEGIN_HERE: ClassVar[bool] = True

    specific_wear_rate: float = quantity(
        "1.1e-15 m^2/N", "specific wear rate C_w of the bushing", "paper, section 2.4", ge=0
    )
    partner_wear_rate: float = quantity(
        "0 m^2/N", "specific wear rate of what slides in it; both wear in proportion", ASSUMED, ge=0
    )
    scatter: Numbers | None = series(
        "least and largest wear of equal parts over that at the rate; by default those of the material",
        example="[0.5, 2]",
    )
    repeats: Numbers | None = series(
        "measured wear of equal parts in equal tests, in any one unit; the scatter follows from it",
        example="[1.2, 0.9, 2.1]",
    )
    final_roughness: float | None = quantity(
        None,
        "rms roughness that the bushing runs in to; that of the trunnion without it",
        ASSUMED,
        gt=0,
        example="0.4 um",
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that scatter is an interval around 1, and repeats at least two measurements."""
        low, high = self.scatter if self.scatter and len(self.scatter) == 2 else (1.0, 1.0)
        around = self.scatter is None or (len(self.scatter) == 2 and 0.0 < low <= 1.0 <= high)
        demand(around, "scatter", "give two numbers around 1, such as [0.5, 2]")
        several = self.repeats is None or (len(self.repeats) > 1 and min(self.repeats) > 0.0)
        demand(several, "repeats", "give two or more numbers above 0, such as [1.2, 0.9, 2.1]")
        one = self.scatter is None or self.repeats is None
        demand(one, "repeats", "give either this or scatter")


class Wear(SurfaceWear):
    """Wear of the bushing."""

    #: Keys that end a campaign, by what its history calls the number that is limited.
    LIMIT_OF: ClassVar[Mapping[str, str]] = {"wear_depth_max": "wear.depth_limit"}

    paper_hardness_divisor: float = number(
        0.0, "the paper's figures come out when the rate is divided by 65; 0 is off", "paper, Eq. 47", ge=0
    )
    cycles: int = count(
        0, "drive cycles of a wear campaign; 0: none, a linear estimate of wear", ASSUMED, ge=0, le=10**12
    )
    feedback: bool = switch(True, "whether the worn shape changes the gap in a campaign", "manual, wear")
    jump_limit: float = number(
        0.05,
        "change of the sliding load, relative to its peak, that one jump of a campaign may cause",
        ASSUMED,
        gt=0,
        le=1,
    )
    jump_depth: float = number(
        0.25, "largest gain of depth in one jump, over the combined roughness", ASSUMED, gt=0, le=1
    )
    depth_limit: float | None = quantity(
        None,
        "wear depth, of both partners together, at which a joint is worn out: a campaign ends there",
        ASSUMED,
        gt=0,
        example="5 um",
    )

    running_in: bool = switch(False, "whether the bushing's roughness changes in a campaign", "manual, wear")
