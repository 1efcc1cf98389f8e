"""Bodies of a mechanism: their keys and their cross-checks."""

from __future__ import annotations

from typing import ClassVar, Final, Literal

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.directions import dot, unit
from tribodyn.cases.fields import Numbers, Vector, choice, file, number, quantity, series, vector
from tribodyn.mechanism.model.parts import POINT
from tribodyn.mechanism.model.solids import NEEDED, SIZES

_ROUNDING: Final = 1e-6
"""Share of an inertia by which rounded numbers may break the triangle rule."""


class BodyKeys(NamedGroup):
    """A rigid body; of a simple solid mass, mass centre and inertia follow from its sizes."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        ("mass", "density"),
        ("inertia", "shape"),
        ("centre", "start"),
        ("mesh", "facets"),
    )

    shape: Literal["rod", "cylinder", "box", "mesh"] | None = choice(
        None,
        "solid of uniform density: a round rod from start to end, a cylinder about the first axis, a box, or "
        "the inside of a mesh",
        "",
        example="rod",
    )
    density: float | None = quantity(None, "density of a shape", "", gt=0, example="7850 kg/m^3")
    start: Vector | None = vector(None, "start of a rod", "", unit="mm", example=POINT)
    end: Vector | None = vector(None, "end of a rod", "", unit="mm", example=POINT)
    length: float | None = quantity(None, "length of a cylinder", "", gt=0, example="20 mm")
    radius: float | None = quantity(None, "radius of a rod or cylinder", "", gt=0, example="8 mm")
    inner_radius: float | None = quantity(None, "inner radius of a hollow cylinder", "", gt=0, example="4 mm")
    size: Vector | None = vector(
        None,
        "edge lengths of a box along its axes",
        "",
        unit="mm",
        example='["30 mm", "20 mm", "10 mm"]',
    )
    mesh: str | None = file("STL file of a closed surface, global coordinates", "lever.stl")
    mesh_unit: float = quantity("1 mm", "length unit of that file", "assumed", gt=0)
    facets: Numbers | None = series(
        "corners of triangles in global coordinates, anticlockwise from outside, instead of a file",
        "",
        unit="m",
        example='"0, 0, 1 m"',
    )
    scale: float | None = number(None, "size of a mesh over that of its triangles", "", gt=0, example="1.2")
    scaled_about: Vector | None = vector(
        None,
        "point that the scale leaves in place; by default the mass centre",
        "",
        unit="mm",
        example=POINT,
    )
    mass: float = quantity(None, "mass", "", unit="kg", gt=0, example="0.3 kg", required=True)
    centre: Vector = vector(None, "position of the mass centre", "", unit="mm", example=POINT, required=True)
    inertia: Vector = vector(
        None,
        "principal moments of inertia about the mass centre",
        "",
        unit="kg m^2",
        example='["1e-4 kg m^2", "1e-4 kg m^2", "2e-4 kg m^2"]',
        required=True,
    )
    first_axis: Vector = vector(
        "1, 0, 0", "direction of the first principal axis", "global axes", example="[1, 0, 0]"
    )
    second_axis: Vector = vector(
        "0, 1, 0", "direction of the second principal axis", "global axes", example="[0, 1, 0]"
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that a body of this inertia can exist."""
        sizes = [key for key in (*SIZES, "density") if key != "centre" and getattr(self, key) is not None]
        words = f"this belongs to a shape: {', '.join(NEEDED)}"
        demand(self.shape is not None or not sizes, next(iter(sizes), "shape"), words)
        largest, others = max(self.inertia), sum(self.inertia) - max(self.inertia)
        demand(min(self.inertia) > 0.0, "inertia", "moments of inertia are above zero")
        demand(
            largest <= others * (1.0 + _ROUNDING),
            "inertia",
            f"no body has these: the largest, {largest:.6g} kg m^2, exceeds the sum of the other two, "
            f"{others:.6g} kg m^2",
        )
        demand(
            abs(dot(unit(self.first_axis, "first_axis"), unit(self.second_axis, "second_axis"))) < _ROUNDING,
            "second_axis",
            "principal axes stand at right angles",
        )
