"""Pairs of rough surfaces of a case: common parts, and remarks on values that may not belong together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, Self

from tribodyn.cases import materials
from tribodyn.cases.case import Case
from tribodyn.cases.followed_tables import FollowedTable, of_tables
from tribodyn.cases.groups import AsperityKeys, Contact, Solver, Surfaces
from tribodyn.cases.joint_keys import CONFORMAL, PlainJoint
from tribodyn.cases.keys import Key, Value, keys_of
from tribodyn.cases.materials import MATERIAL, MATERIALS, SURFACES, Property, taken, warmth, written
from tribodyn.cases.messages import Remarks
from tribodyn.cases.tables import keys_at, keys_in, value_at
from tribodyn.cases.temperature import Temperature
from tribodyn.cases.units import RZ_OVER_RA

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

    def wear_scatter(self) -> dict[str, tuple[float, float]]:
        """Return the interval of the wear of equal parts, over that at the rate; none where nothing wears."""
        return {"": wear_scatter(self)}

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the checks of the contact law."""
        return (lambda: self.contact.check(self.surface_pair),)


class BushingCase(RoughCase):
    """A case with one clearance joint, between these surfaces."""

    joint: PlainJoint = PlainJoint()
    temperature: Temperature = Temperature()

    if TYPE_CHECKING:  # What its kinds declare.
        solver: Solver

    @classmethod
    def resolve(cls, given: Mapping[str, Value]) -> dict[str, Value]:
        """Return the defaults that follow from materials, the contact law and temperatures."""
        return super().resolve(given) | Temperature.resolve(given)

    def derived(self) -> dict[str, str]:
        """Return the properties of the material that follow from the temperature."""
        return self.temperature.properties.derived()

    def remarks(self) -> Remarks:
        """Return remarks on surfaces and tables, and on elastic bodies of unknown loss."""
        return super().remarks() + of_loss(self, ("",) if self.joint.bulk == CONFORMAL else ())

    def yielding(self) -> Self | None:
        """Return the case with elastic bodies under its asperities, if it says nothing of them."""
        possible = self.joint.bulk is None and self.joint.may_yield
        return self.replace({"joint.bulk": CONFORMAL}) if possible else None

    def checks(self) -> tuple[Callable[[], object], ...]:
        """Return the checks of contact law, liner and clearance."""
        return (*super().checks(), self._check_liner, self._check_clearance)

    def _check_liner(self) -> None:
        self.joint.liner.layer(self.surfaces.bushing)

    def _check_clearance(self) -> None:
        if self.temperature.changes:
            self.temperature.dimensions(self.joint, self.surfaces)


_WEAR = "wear.specific_wear_rate"
_NOTHING: Final[Mapping[str, Sequence[str]]] = MappingProxyType({})


def of_surfaces(case: Case, prefix: str = "", beside: Mapping[str, Sequence[str]] = _NOTHING) -> Remarks:
    """Return remarks on a set of surfaces.

    ``case``: any case that has one; ``prefix``: what stands before the paths of its keys; ``beside``: keys of
    joints between these surfaces that hold a property of the bushing too, by its name.
    """
    keys = keys_in(case)
    used = [one for surface in SURFACES for one in _used(case, keys, surface, prefix, beside)]
    warnings = [*_of_asperities(case, keys, prefix), *_of_wear(case, keys, prefix)]
    return Remarks(
        tuple(warnings + [text for one in used for text in one.warnings()]),
        tuple(chain(*(one.notes() for one in used), _of_heights(case, prefix), _of_law(case, keys, prefix))),
    )


def has_material(case: Case, prefix: str = "") -> bool:
    """Return whether somebody named the material of a bushing or gave its stiffness or hardness."""
    names = (MATERIAL, "young_modulus", "hardness")
    return any(case.given(f"{prefix}surfaces.bushing.{name}") is not None for name in names)


def of_choice(case: Case, prefixes: Iterable[str]) -> Remarks:
    """Return the note on sets of surfaces, by what their keys begin with, whose material nobody chose."""
    left = [f"{prefix}surfaces.bushing.{MATERIAL}" for prefix in prefixes if not has_material(case, prefix)]
    if not left:
        return Remarks()
    words = (
        "Nobody chose a material: surfaces are those of the paper, polyimide on 17-4 PH steel of an "
        f"aero-engine. Choose {', '.join(left)} (`tribodyn materials` lists them). Wear rates and lives of "
        "such surfaces are shown in grey."
    )
    return Remarks((), (words,))


def of_loss(case: Case, prefixes: Iterable[str]) -> Remarks:
    """Return the note on elastic bodies of unknown loss, by what the keys of their surfaces begin with."""
    given = ("surfaces.bushing.loss_factor", "contact.loss_coefficient")
    left = [
        f"{prefix}{given[0]}" for prefix in prefixes if all(case.at(prefix + key) is None for key in given)
    ]
    words = (
        "Nothing is known of what the bodies under the asperities lose in an impact: they return all of it. "
        f"Give {', '.join(left)}, or a material with a loss factor (`tribodyn materials`)."
    )
    return Remarks((), (words,)) if left else Remarks()


def has_wear_rate(case: Case, prefix: str = "") -> bool:
    """Return whether somebody gave the wear rate of a bushing, or a material for which one is known."""
    name = case.at(f"{prefix}surfaces.bushing.{MATERIAL}")
    known = name is not None and "specific_wear_rate" in MATERIALS[str(name)].properties
    return known or case.given(f"{prefix}{_WEAR}") is not None


def wear_scatter(case: Case, prefix: str = "") -> tuple[float, float]:
    """Return the interval of the wear of equal parts, over that at the rate of a set of surfaces [1]."""
    from tribodyn.wear.archard import of_repeats

    for begin in dict.fromkeys((prefix, "")):
        repeats, scatter = (value_at(case, f"{begin}wear.{name}") for name in ("repeats", "scatter"))
        if repeats is not None:
            return of_repeats(repeats)
        if scatter is not None:
            return float(scatter[0]), float(scatter[1])
    name, rate = case.at(f"{prefix}surfaces.bushing.{MATERIAL}"), f"{prefix}{_WEAR}"
    at = value_at(case, rate)
    # A case that is read back has its defaults written down.
    given = None if at == keys_at(type(case), [rate])[rate].default else case.given(rate)
    return materials.wear_scatter(given, None if name is None else str(name), at)


@dataclass(frozen=True)
class _Used:
    """A key that takes its value from a material: what the case holds there, and what the material has."""

    key: Key
    value: object
    material: str
    known: Property | None
    temperature: float

    def warnings(self) -> Iterator[str]:
        path, name = self.key.path, self.material
        if self.known is None:
            if self.value is not None and self.value == self.key.default:
                kept = self._shown(self.value)
                yield f"The library has no {self.key.name} of {name}: {path} stays at {kept}."
        elif self.known.at(self.temperature) == self.value and self.known.is_far(self.temperature):
            yield f"{path} of {name} is known at other temperatures only: {self.known.validity}."

    def notes(self) -> Iterator[str]:
        if self.known is None:
            return
        given, of_material = self._shown(self.value), self._shown(self.known.at(self.temperature))
        if self.known.at(self.temperature) != self.value:
            yield f"{self.key.path} = {given} goes before {of_material} of {self.material}."
        elif self.known.spread is not None:
            ends = written(self.key.name, self.known)
            yield f"{self.key.path} = {given} is the middle of a range that {self.material} has: {ends}."

    def _shown(self, value: object) -> str:
        assert isinstance(value, float)
        return self.key.write(float(f"{value:.4g}")).strip('"')


def _used(
    case: Case, keys: Mapping[str, Key], surface: str, prefix: str, beside: Mapping[str, Sequence[str]]
) -> Iterator[_Used]:
    name = case.at(f"{prefix}surfaces.{surface}.{MATERIAL}")
    if name is None:
        return
    more = ((key, path) for key, paths in beside.items() if surface == "bushing" for path in paths)
    for property_name, path in (*taken(surface, prefix), *more):
        if path in keys:
            known = MATERIALS[str(name)].properties.get(property_name)
            there = {key: case.at(key) for key in keys if key.startswith("temperature.")}
            yield _Used(keys[path], case.at(path), str(name), known, warmth(there, surface))


def _of_asperities(case: Case, keys: Mapping[str, Key], prefix: str) -> Iterator[str]:
    rough = [f"{prefix}surfaces.{surface}.roughness" for surface in SURFACES]
    left = [f"{prefix}asperities.{name}" for name in ("density", "radius")]
    if not _as_built_in(case, keys, rough) and _left(case, keys, left):
        yield (
            "The roughness is another one, the asperities are still those of the paper's surfaces: "
            f"give {left[0]} and {left[1]}, or a scan."
        )


def _of_wear(case: Case, keys: Mapping[str, Key], prefix: str) -> Iterator[str]:
    surface, rate = f"{prefix}surfaces.bushing", f"{prefix}{_WEAR}"
    bushing = [f"{surface}.{name}" for name in ("young_modulus", "poisson_ratio", "hardness")]
    if rate not in keys or case.at(f"{surface}.{MATERIAL}") is not None:
        return
    if not _as_built_in(case, keys, bushing) and _left(case, keys, [rate]):
        which = f"The bushing of {prefix.rstrip('.')}" if prefix else "The bushing"
        yield f"{which} is another one, and wears as that of the paper: give {rate} of its material."


def _of_heights(case: Case, prefix: str) -> Iterator[str]:
    for surface in SURFACES:
        given = case.given(f"{prefix}surfaces.{surface}.roughness")
        if isinstance(given, str) and given.strip().startswith("Rz"):
            yield (
                f"{given.strip()} of the {surface} was taken for {RZ_OVER_RA:g} Ra of Gaussian heights; "
                "surfaces have 4 to 7 Ra."
            )


def _of_law(case: Case, keys: Mapping[str, Key], prefix: str) -> Iterator[str]:
    """Yield the parameters of other contact laws that were given values without an effect."""
    from tribodyn.contact import LAWS, options_of_others

    law = str(case.at(f"{prefix}contact.law"))
    for key in sorted(options_of_others(law)) if law in LAWS else ():
        path = f"{prefix}contact.{key}"
        if case.at(path) != keys[path].default:
            yield f"{path} has no effect with the law {law}: it is a parameter of other laws."


def _left(case: Case, keys: Mapping[str, Key], paths: list[str]) -> bool:
    """Tell whether keys hold what they do by default, and nobody wrote that down."""
    return _as_built_in(case, keys, paths) and all(case.given(path) is None for path in paths)


def _as_built_in(case: Case, keys: Mapping[str, Key], paths: list[str]) -> bool:
    return all(case.at(path) == keys[path].default for path in paths)
