"""Tables of keys that several kinds of cases share."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Self

from pydantic import PrivateAttr, create_model

from tribodyn.cases.case import Group, demand
from tribodyn.cases.fields import Bounds, choice, count, file, number, quantity, switch, text
from tribodyn.cases.keys import ASSUMED, Value
from tribodyn.cases.units import from_si
from tribodyn.joints.rows import resolving

if TYPE_CHECKING:
    from tribodyn.contact import ContactLaw, SurfacePair

TABLE_1 = "paper, Table 1"
MADE_FOR_AN_IMPACT = ("calibrated", "kelvin-voigt")  #: Damping factors that use ``contact.design_pressure``.
_MOST_OUTPUT_TIMES = 2_000_000


def _loss_factor() -> Any:
    words = "tan delta of the body under the asperities; it loses none without it"
    return number(None, words, ge=0, le=1, example="0.005")


def _material(example: str) -> Any:
    words = "of the library; keys beside it go before what it gives"
    return choice(None, words, family="tribodyn.cases.materials:MATERIALS", example=example)


def _conductivity(example: str) -> Any:
    words = "of heat; of both surfaces, with the diffusivity, for a flash temperature"
    return quantity(None, words, gt=0, example=example)


class Trunnion(Group):
    """Surface of the trunnion (element 1)."""

    material: str | None = _material("steel-17-4ph")
    young_modulus: float = quantity("203 GPa", "Young's modulus E_1", TABLE_1, gt=0)
    poisson_ratio: float = number(0.27, "Poisson's ratio nu_1", TABLE_1, gt=0, le=0.5)
    roughness: float = quantity(
        "0.392 um", "root mean square roughness sigma_1; Ra or Rz as well", TABLE_1, ge=0, profile=True
    )
    thermal_expansion: float | None = quantity(
        None, "linear; needed with temperature.trunnion", ge=0, example="11e-6 1/K"
    )
    conductivity: float | None = _conductivity("16 W/(m K)")
    diffusivity: float | None = quantity(None, "of heat, k/(rho c)", gt=0, example="4 mm^2/s")
    loss_factor: float | None = _loss_factor()
    surface: str | None = file("scan of the surface instead; then one of the bushing too", "trunnion.csv")


class Bushing(Group):
    """Surface of the bushing (element 2), the softer one."""

    material: str | None = _material("bronze-c93200")
    young_modulus: float = quantity("7.17 GPa", "Young's modulus E_2", TABLE_1, gt=0)
    poisson_ratio: float = number(0.34, "Poisson's ratio nu_2", TABLE_1, gt=0, le=0.5)
    roughness: float = quantity(
        "1.586 um", "root mean square roughness sigma_2; Ra or Rz as well", TABLE_1, ge=0, profile=True
    )
    hardness: float = quantity("492 MPa", "hardness H", TABLE_1, gt=0)
    thermal_expansion: float | None = quantity(
        None, "linear; needed with temperature.bushing", ge=0, example="50e-6 1/K"
    )
    conductivity: float | None = _conductivity("0.35 W/(m K)")
    diffusivity: float | None = quantity(None, "of heat, k/(rho c)", gt=0, example="0.2 mm^2/s")
    loss_factor: float | None = _loss_factor()
    surface: str | None = file("scan of the surface instead; then one of the trunnion too", "bushing.csv")


class Surfaces(Group):
    """The two rough surfaces."""

    trunnion: Trunnion = Trunnion()
    bushing: Bushing = Bushing()

    def model_post_init(self, context: object, /) -> None:
        """Check that at least one surface is rough."""
        demand(
            self.trunnion.roughness + self.bushing.roughness > 0,
            "surfaces.bushing.roughness",
            "one of the two surfaces must be rough: a roughness above 0 is needed here or for the trunnion",
        )

    def pair(self, asperities: AsperityKeys) -> SurfacePair:
        """Return the two surfaces in contact, as contact laws take them."""
        from tribodyn.contact import SurfacePair

        return SurfacePair(
            young_modulus=(self.trunnion.young_modulus, self.bushing.young_modulus),
            poisson_ratio=(self.trunnion.poisson_ratio, self.bushing.poisson_ratio),
            roughness=(self.trunnion.roughness, self.bushing.roughness),
            hardness=self.bushing.hardness,
            asperity_density=asperities.density,
            asperity_radius=asperities.radius,
            loss_factor=(self.trunnion.loss_factor or 0.0, self.bushing.loss_factor or 0.0),
        )

    def run_in(self, depth: float, final: float | None) -> Self:
        """Return the surfaces after a mean depth is worn off the bushing.

        ``depth``: the depth [m]; ``final``: roughness that the bushing runs in to [m]; None for that of the
        trunnion.
        """
        from tribodyn.wear import worn_roughness

        sigma = worn_roughness(self.bushing.roughness, depth, final or self.trunnion.roughness)
        return self.model_copy(update={"bushing": self.bushing.model_copy(update={"roughness": sigma})})

    def check_running_in(self, final: float | None, key: str = "wear.") -> None:
        """Refuse a bushing that runs in to no roughness; ``key`` is what the keys of its wear begin with."""
        words = "the trunnion is smooth: say what the bushing runs in to"
        demand(bool(final or self.trunnion.roughness), f"{key}final_roughness", words)


class AsperityKeys(Group):
    """The asperities of the equivalent rough surface."""

    density: float = quantity("0.038 1/um^2", "asperities per area xi", TABLE_1, gt=0)
    radius: float = quantity("8.17 um", "radius of the asperity tips beta", TABLE_1, gt=0)
    origin: str = text("", "where these and the roughness come from, if not from the paper")
    surface: str | None = file("scan that gives these and the roughness, instead of them", "scan.csv")
    level: str | None = choice(
        None, "what is taken off a scan", family="tribodyn.surfaces:LEVELS", example="plane"
    )
    filter: str | None = choice(
        None, "filter of the cut-offs", family="tribodyn.surfaces:FILTERS", example="gaussian"
    )
    short_cutoff: float | None = quantity(
        None, "shortest wavelength kept of a scan; all without it", gt=0, example="2.5 um"
    )
    long_cutoff: float | None = quantity(
        None, "longest wavelength kept of a scan; all without it", gt=0, example="0.8 mm"
    )


class _ContactOfAnyLaw(Group):
    """Keys of contact that all laws share."""

    law: str = choice("rsdc", "contact law", "paper, section 2.1", family="tribodyn.contact:LAWS")
    damping_factor: str = choice(
        "lankarani-nikravesh",
        "how damping follows from restitution; by default none for a law that has no restitution",
        "paper, Eq. 5",
        family="tribodyn.contact:DAMPING_FACTORS",
    )
    restitution: float | None = number(
        None, "restitution meant; rsdc has its own without it", "paper, Eq. 9", gt=0, le=1, example="0.7"
    )
    loss_coefficient: float | None = quantity(
        None,
        "alpha of a damping in proportion to the speed, without entry velocities: e = 1 - alpha v",
        "Hunt and Crossley 1975",
        gt=0,
        example="0.1 s/m",
    )
    design_pressure: float = quantity(
        "50 MPa",
        "peak pressure of the undamped impact that the factors calibrated and kelvin-voigt are made for",
        ASSUMED,
        gt=0,
    )
    separation_from: str = choice(
        "asperities",
        "mean plane from which asperity laws count separations",
        "paper, section 2.1",
        family="tribodyn.contact:SEPARATIONS",
    )
    onset_separation: float = number(
        4.0,
        "separation over sigma at which contact begins and the entry velocity is taken",
        ASSUMED,
        gt=0,
        le=8,
    )
    smoothing_width: float = number(
        1.0,
        "width over sigma, below the onset, in which damping grows to its full value",
        ASSUMED,
        gt=0,
        le=8,
    )
    minimum_entry_velocity: float = quantity(
        "1 mm/s", "least entry velocity, also that of points in contact at the start", ASSUMED, gt=0
    )
    tensile_clip: bool = switch(True, "whether the total pressure is kept from becoming tensile", ASSUMED)


def _of_laws() -> Iterator[tuple[str, tuple[type[float], Any]]]:
    """Yield the keys that are parameters of single laws, by their names."""
    from tribodyn.contact import LAWS
    from tribodyn.contact.parameter import parameters_of

    for kind in LAWS.values():
        for name, said in parameters_of(kind):
            if name in _ContactOfAnyLaw.model_fields:
                # A law of another package must not change the keys of the others.
                words = f"contact.{name} is a key of all laws, and not declared by the law {kind.name}"
                warnings.warn(words, stacklevel=2)
                continue
            limits = Bounds(gt=_written(said.above, said.unit), le=_written(said.most, said.unit))
            if said.unit:
                default = from_si(said.default, said.unit)
                key = quantity(default, said.meaning, said.source, unit=said.unit, **limits)
            else:
                key = number(said.default, said.meaning, said.source, **limits)
            yield name, (float, key)


def _written(value: float | None, unit: str) -> str | float | None:
    return from_si(value, unit) if unit and value else value


if TYPE_CHECKING:
    _ContactKeys = _ContactOfAnyLaw
else:
    _ContactKeys = create_model(
        "_ContactKeys", __base__=_ContactOfAnyLaw, __module__=__name__, **dict(_of_laws())
    )


class Contact(_ContactKeys):
    """The law of rough contact and its damping."""

    _own_law: Any = PrivateAttr(None)

    @staticmethod
    def resolve(given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the damping factor of a law that has no restitution of its own, or that needs none."""
        if given.get("contact.loss_coefficient") is not None:
            return {"contact.damping_factor": "none"}
        name = given.get("contact.law")
        if name is None or given.get("contact.restitution") is not None:
            return {}
        from tribodyn.contact import LAWS

        if name not in LAWS or LAWS[str(name)].knows_restitution:
            return {}
        demand(
            given.get("contact.damping_factor", "none") == "none",
            "contact.restitution",
            f"the law {name} has no restitution of its own, and the damping factor needs one, such as 0.7",
        )
        return {"contact.damping_factor": "none"}

    def law_of(self, surfaces: SurfacePair) -> ContactLaw:
        """Return the contact law for a pair of surfaces.

        A law that has no restitution of its own and is given none is left undamped.
        """
        from tribodyn.contact import LAWS, made

        kind = self._own_law or LAWS[self.law]
        damped = self.restitution is not None or kind.knows_restitution
        options = {key: getattr(self, key) for key in type(self).model_fields}
        options["damping_factor"] = self.damping_factor if damped else "none"
        return made(kind, surfaces, options)

    def with_own(self, kind: type[ContactLaw]) -> Contact:
        """Return a copy with a law that no list holds, under its name."""
        copied = self.model_copy(update={"law": kind.name})
        copied._own_law = kind
        return copied

    @property
    def least_entry_velocity(self) -> float:
        """Least δ̇₋ [m/s]; where damping is in proportion to the speed it is that of all points."""
        from tribodyn.contact.contact_law import MEMORYLESS

        return self.minimum_entry_velocity if self.loss_coefficient is None else MEMORYLESS

    def check(self, surfaces: SurfacePair) -> None:
        """Refuse options that these surfaces cannot have; the plain law has none to refuse."""
        one = self.loss_coefficient is None or (self.damping_factor == "none" and self.restitution is None)
        demand(one, "contact.loss_coefficient", "give either this or a damping factor with its restitution")
        if self.damping_factor in MADE_FOR_AN_IMPACT or self.separation_from != "asperities":
            chosen = self.law_of(surfaces)
            if chosen.damping_factor in MADE_FOR_AN_IMPACT:
                chosen.design_separation()


class Tolerances(Group):
    """Absolute tolerance of each kind of state."""

    position: float = quantity("2e-10 m", "for e_x and e_y", ASSUMED, gt=0)
    tilt: float = quantity("2e-8 rad", "for phi_x and phi_y", ASSUMED, gt=0)
    velocity: float = quantity("2e-6 m/s", "for the rates of e_x and e_y", ASSUMED, gt=0)
    tilt_rate: float = quantity("2e-4 rad/s", "for the rates of phi_x and phi_y", ASSUMED, gt=0)

    @property
    def as_tuple(self) -> tuple[float, float, float, float]:
        """Tolerances of e [m], φ [rad], ė [m/s], φ̇ [rad/s]."""
        return self.position, self.tilt, self.velocity, self.tilt_rate


class GridKeys(Group):
    """Quadrature points over each surface of a clearance; by default as many as resolve its contact."""

    theta: int | None = count(
        None, "points around; by default by clearance over roughness", ge=12, le=4096, example="96"
    )
    z: int | None = count(
        None, "Gauss points along; by default by clearance over roughness", ge=2, le=256, example="16"
    )

    def resolved(self, clearance: float, roughness: float) -> tuple[int, int]:
        """Return the points around and along of a clearance [m] between surfaces of a roughness [m]."""
        around, along = resolving(clearance, roughness)
        return self.theta or around, self.z or along


class Solver(Group):
    """The time integration."""

    name: str = choice("mebdf", "integrator", ASSUMED, family="tribodyn.integrate:SOLVERS")
    rtol: float = number(1e-3, "relative tolerance", ASSUMED, ge=1e-12, le=0.1)
    atol: Tolerances = Tolerances()
    grid: GridKeys = GridKeys()


def check_output_interval(interval: float, duration: float) -> None:
    """Refuse a ``run.output_interval`` [s] that a run of ``duration`` [s] cannot have."""
    key = "run.output_interval"
    demand(interval <= duration, key, f"the run lasts only {duration:g} s")
    demand(
        duration <= _MOST_OUTPUT_TIMES * interval,
        key,
        f"at most {_MOST_OUTPUT_TIMES} output times are kept; the run lasts {duration:g} s",
    )
