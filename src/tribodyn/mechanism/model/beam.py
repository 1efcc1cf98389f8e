"""Beams as bodies: their line, section and material, and the properties of the section."""

import math
from typing import ClassVar, Final, Literal

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup, demand, unit
from tribodyn.cases.fields import Numbers, Vector, choice, count, number, quantity, series, vector
from tribodyn.cases.materials import MATERIALS

SAME: Final = 1.0e-9  #: Distance over the length of a beam at which two places are one.
_ALONG: Final = 1.0e-6  #: Sine of the angle at which a direction is that of a piece.


class BeamBodyKeys(NamedGroup):
    """A beam: its line, section and material."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("young_modulus", "material"), ("width", "area"))

    points: Numbers | None = series(
        "points that the beam goes through straight, first to last",
        unit="mm",
        example='"0, 0, 0, 50, 0, 0 mm"',
    )
    section: Literal["rectangle", "circle", "tube", "any"] = choice(
        "rectangle", "shape of the section", "assumed"
    )
    width: float | None = quantity(None, "width of a rectangle", gt=0, example="10 mm")
    height: float | None = quantity(None, "height of a rectangle, along height_axis", gt=0, example="3 mm")
    height_axis: Vector | None = vector(
        None, "direction of the height; by default across the line, near a global axis", example="[0, 0, 1]"
    )
    radius: float | None = quantity(None, "radius of a circle or tube", gt=0, example="5 mm")
    inner_radius: float = quantity("0 mm", "inner radius of a tube", "assumed", ge=0, example="4 mm")
    area: float | None = quantity(None, "area of any section", gt=0, example="30 mm^2")
    second_moments: Numbers | None = series(
        "second moments of any section, for deflection along height_axis and across it",
        unit="mm^4",
        example='["22.5 mm^4", "250 mm^4"]',
    )
    torsion_constant: float | None = quantity(
        None, "torsion constant of any section", gt=0, example="73 mm^4"
    )
    shear_factor: float | None = number(
        None,
        "share of the area in the shear rigidity; by default that of the shape",
        gt=0,
        le=1,
        example="0.83",
    )
    material: str | None = choice(
        None,
        "of the library, for Young's modulus and Poisson's ratio",
        family="tribodyn.cases.materials:MATERIALS",
        example="steel-52100",
    )
    young_modulus: float | None = quantity(None, "Young's modulus", gt=0, example="110 GPa")
    poisson_ratio: float | None = number(
        None, "Poisson's ratio; 0.3 without a material", ge=0, lt=0.5, example="0.34"
    )
    density: float | None = quantity(None, "density", gt=0, example="4430 kg/m^3")
    segments: int = count(
        4, "pieces of the whole line, two at least between ends, corners and joints", "assumed", ge=2, le=64
    )
    damping_ratio: float = number(
        0.01,
        "damping ratio of the lowest bending mode, one end clamped; of others in proportion to frequency",
        "assumed",
        ge=0,
        le=1,
    )

    def model_post_init(self, context: object, /) -> None:
        """Check line and section."""
        count = 0 if self.points is None else len(self.points)
        demand(
            count >= 6 and count % 3 == 0,
            "points",
            "a beam goes through two points or more, three numbers each",
        )
        steps = np.diff(self.line, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        words = "two points that follow each other are one"
        demand(bool(np.all(lengths > SAME * lengths.sum())), "points", words)
        if self.height_axis is not None:
            sides = np.linalg.norm(np.cross(steps, unit(self.height_axis, "height_axis")), axis=1)
            words = "the height lies across the line, and this direction is that of a piece of it"
            demand(bool(np.all(sides > _ALONG * lengths)), "height_axis", words)
        needed = {
            "rectangle": ("width", "height"),
            "circle": ("radius",),
            "tube": ("radius",),
            "any": ("area", "second_moments", "torsion_constant"),
        }[self.section]
        for key in needed:
            demand(
                getattr(self, key) is not None, key, f"a section {self.section} needs {' and '.join(needed)}"
            )
        solid = self.radius is None or self.inner_radius < self.radius
        demand(solid, "inner_radius", "the inner radius is smaller than radius")
        moments = self.second_moments
        words = "two numbers above zero"
        demand(moments is None or (len(moments) == 2 and min(moments) > 0.0), "second_moments", words)
        demand(self.density is not None, "density", "a beam needs its density")
        words = "a beam needs Young's modulus, or a material of the library"
        demand(self.young_modulus is not None or self.material is not None, "young_modulus", words)

    @property
    def line(self) -> FloatArray:
        """Its points [m], shape (n, 3)."""
        return np.array(self.points).reshape(-1, 3)

    @property
    def moduli(self) -> tuple[float, float, float]:
        """Young's modulus, shear modulus [Pa], Poisson's ratio."""
        of_material = None if self.material is None else MATERIALS[self.material]
        young = self.young_modulus or (0.0 if of_material is None else of_material.young_modulus)
        ratio = self.poisson_ratio
        if ratio is None:
            ratio = (
                0.3
                if of_material is None or "poisson_ratio" in of_material.unknown
                else of_material.poisson_ratio
            )
        return young, young / (2.0 * (1.0 + ratio)), ratio

    @property
    def properties(self) -> tuple[float, tuple[float, float], float, float, tuple[float, ...]]:
        """Area, second moments, torsion constant, shear factor (0 for none) and section moduli [SI].

        Second moments and moduli are those for deflection along the height and across it, of round sections
        one. Shear factors are those of G. R. Cowper, Journal of Applied Mechanics 33 (1966); the torsion of a
        rectangle is after R. J. Roark, Formulas for Stress and Strain. Any section shears only as given, and
        has no moduli.
        """
        nu, given = self.moduli[2], self.shear_factor
        if self.section == "any":
            first, second = self.second_moments or (0.0, 0.0)
            return self.area or 0.0, (first, second), self.torsion_constant or 0.0, given or 0.0, ()
        if self.section == "rectangle":
            b, h = self.width or 0.0, self.height or 0.0
            long, short = max(b, h), min(b, h)
            torsion = long * short**3 * (1.0 / 3.0 - 0.21 * short / long * (1.0 - (short / long) ** 4 / 12.0))
            factor = given or 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)
            return (
                b * h,
                (b * h**3 / 12.0, h * b**3 / 12.0),
                torsion,
                factor,
                (b * h * h / 6.0, h * b * b / 6.0),
            )
        r, inner = self.radius or 0.0, self.inner_radius if self.section == "tube" else 0.0
        share, moment = (inner / r) ** 2, 0.25 * math.pi * (r**4 - inner**4)
        both = (1.0 + share) ** 2
        factor = 6.0 * (1.0 + nu) * both / ((7.0 + 6.0 * nu) * both + (20.0 + 12.0 * nu) * share)
        area = math.pi * (r * r - inner * inner)
        return area, (moment, moment), 2.0 * moment, given or factor, (moment / r,)
