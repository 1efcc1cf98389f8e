"""Joints that are elastic: beams without mass, and two bodies that move against six stiffnesses."""

from typing import Any, ClassVar

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import Numbers, Vector, quantity, series, vector
from tribodyn.kernels.mechanism.data import BEAM, SPRINGS
from tribodyn.mechanism.joints.joint_type import JointType

#: Number of the key's component along x, y, z: keys are along axis, second axis and across both.
_OF_AXES = (1, 2, 0)


class SpringDamperKeys(NamedGroup):
    """Stiffness and damping of a spring-damper."""

    stiffness: Vector | None = vector(
        None,
        "stiffness of a spring-damper along axis, second axis and across both",
        unit="N/um",
        example='["10 N/um", "10 N/um", "10 N/um"]',
    )
    damping: Vector | None = vector(
        None,
        "damping of a spring-damper along these directions",
        unit="N s/m",
        example='["10 N s/m", "10 N s/m", "10 N s/m"]',
    )
    angular_stiffness: Vector | None = vector(
        None,
        "angular stiffness of a spring-damper about these directions",
        unit="N m/rad",
        example='["0 N m/rad", "10 N m/rad", "10 N m/rad"]',
    )
    angular_damping: Vector | None = vector(
        None,
        "angular damping of a spring-damper about these directions",
        unit="N m s/rad",
        example='["0 N m s/rad", "1 N m s/rad", "1 N m s/rad"]',
    )


class SpringDamper(JointType):
    """Springs and dampers along and about three axes."""

    NAME: ClassVar[str] = "spring-damper"
    MEANING: ClassVar[str] = "moves against `stiffness`, `angular_stiffness`, `damping`, `angular_damping`"
    COORDINATES: ClassVar[tuple[str, ...]] = ("angle", "position")
    KEYS: ClassVar[type[NamedGroup]] = SpringDamperKeys
    NEEDED: ClassVar[dict[str, object]] = {"stiffness": "1, 1, 1 N/um"}

    def check(self, keys: Any) -> None:
        """Refuse values below zero, and springs without a stiffness."""
        given = {key: getattr(keys, key) for key in SpringDamperKeys.model_fields}
        for key, values in given.items():
            demand(values is None or min(values) >= 0.0, key, "none of them may be below zero")
        stiff = given["stiffness"] or given["angular_stiffness"]
        demand(bool(stiff), "stiffness", "a spring-damper needs a stiffness")

    def fill(self, record: Any, keys: Any) -> None:
        """Fill stiffness and damping."""
        record.force = SPRINGS
        record.stiffness[:] = _six(keys.stiffness, keys.angular_stiffness)
        record.damping[:] = _six(keys.damping, keys.angular_damping)


def _six(along: Vector | None, about: Vector | None) -> list[float]:
    """Return the given values of two kinds of motion, along and about x, y, z."""
    return [given[k] for given in (along or (0.0,) * 3, about or (0.0,) * 3) for k in _OF_AXES]


class BeamKeys(NamedGroup):
    """Length, rigidities and section of a beam."""

    beam_length: float | None = quantity(None, "length of a beam, which ends at point", gt=0, example="50 mm")
    axial_rigidity: float | None = quantity(
        None, "Young's modulus times area of a beam", gt=0, example="3e6 N"
    )
    torsional_rigidity: float | None = quantity(
        None, "shear modulus times torsion constant of a beam", gt=0, unit="N m^2", example="10 N m^2"
    )
    bending_rigidity: Numbers | None = series(
        "Young's modulus times second moment of a beam, for deflection along second_axis and across both",
        unit="N m^2",
        example='["90 N m^2", "9 N m^2"]',
    )
    shear_rigidity: Numbers | None = series(
        "shear modulus times area and shear factor of a beam along these; rigid without it",
        unit="N",
        example='["1e6 N", "1e6 N"]',
    )
    damping_time: float | None = quantity(
        None, "stress of a beam by its rate of strain over that by strain", ge=0, example="1 us"
    )
    section_area: float | None = quantity(
        None, "area of a beam's section, for its stress", gt=0, example="30 mm^2"
    )
    section_moduli: Numbers | None = series(
        "section moduli of a beam, for its stress, in the order of its rigidities; one of a round section",
        unit="mm^3",
        example='["50 mm^3", "15 mm^3"]',
    )


_NEEDED: dict[str, object] = {
    "axis": [0, 0, 1],
    "beam_length": "50 mm",
    "axial_rigidity": "3e6 N",
    "torsional_rigidity": "10 N m^2",
    "bending_rigidity": ["90 N m^2", "9 N m^2"],
}


class Beam(JointType):
    """A straight piece that bends, twists and stretches."""

    NAME: ClassVar[str] = "beam"
    MEANING: ClassVar[str] = "bends, twists and stretches: a beam along `axis` that ends at `point`"
    AXIS: ClassVar[str] = "axis"
    HELD: ClassVar[str] = "fixed"
    KEYS: ClassVar[type[NamedGroup]] = BeamKeys
    NEEDED: ClassVar[dict[str, object]] = {key: value for key, value in _NEEDED.items() if key != "axis"}

    def check(self, keys: Any) -> None:
        """Refuse a beam without its length or a rigidity."""
        for key, example in self.NEEDED.items():
            demand(getattr(keys, key) is not None, key, f"a beam needs it, such as {key} = {example!r}")
        for key in ("bending_rigidity", "shear_rigidity", "section_moduli"):
            given = getattr(keys, key) or (1.0, 1.0)
            sound = len(given) == 2 or (len(given) == 1 and key == "section_moduli")
            demand(sound and min(given) > 0.0, key, "a beam has two of these, above zero")
        words = "a stress needs the area of the section, too"
        demand(keys.section_moduli is None or keys.section_area is not None, "section_area", words)

    def fill(self, record: Any, keys: Any) -> None:
        """Fill stiffness and damping."""
        record.force, record.length = BEAM, keys.beam_length
        record.damping[0] = keys.damping_time or 0.0
        bending, phi = np.array(keys.bending_rigidity), np.zeros(2)
        if keys.shear_rigidity is not None:
            phi = 12.0 * bending / (np.array(keys.shear_rigidity) * keys.beam_length**2)
        record.stiffness[:2] = keys.axial_rigidity, keys.torsional_rigidity
        record.stiffness[:2] /= keys.beam_length
        record.stiffness[2:4], record.stiffness[4:] = bending / (keys.beam_length * (1.0 + phi)), phi


def flexibility(keys: Any) -> FloatArray:
    """Return displacement and turn of the second body over the wrench on it at its point, shape (6, 6)."""
    length, found = keys.beam_length, np.zeros((6, 6))
    found[2, 2], found[5, 5] = length / keys.axial_rigidity, length / keys.torsional_rigidity
    for i, rigidity in enumerate(keys.bending_rigidity):
        # A force along x turns the end about y, one along y the other way about x.
        turn, sign = 4 - i, 1.0 - 2.0 * i
        shear = 0.0 if keys.shear_rigidity is None else length / keys.shear_rigidity[i]
        found[i, i], found[turn, turn] = length**3 / (3.0 * rigidity) + shear, length / rigidity
        found[i, turn] = found[turn, i] = sign * length**2 / (2.0 * rigidity)
    return found
