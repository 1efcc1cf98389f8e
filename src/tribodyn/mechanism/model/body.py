"""Bodies of a mechanism: their keys and their cross-checks."""

from dataclasses import dataclass
from typing import ClassVar, Final, Literal

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup, demand, dot, unit
from tribodyn.cases.fields import Numbers, Vector, choice, file, number, quantity, series, vector
from tribodyn.mechanism.model.beam import BeamBodyKeys
from tribodyn.mechanism.model.parts import POINT
from tribodyn.mechanism.model.solids import NEEDED, SIZES, mesh_solid

_ROUNDING: Final = 1e-6  #: Share of an inertia by which rounded numbers may break the triangle rule.


class BodyKeys(NamedGroup):
    """A body; of a simple solid mass, mass centre and inertia follow from its sizes."""

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
        example="rod",
    )
    density: float | None = quantity(None, "density of a shape", gt=0, example="7850 kg/m^3")
    start: Vector | None = vector(None, "start of a rod", unit="mm", example=POINT)
    end: Vector | None = vector(None, "end of a rod", unit="mm", example=POINT)
    length: float | None = quantity(None, "length of a cylinder", gt=0, example="20 mm")
    radius: float | None = quantity(None, "radius of a rod or cylinder", gt=0, example="8 mm")
    inner_radius: float | None = quantity(None, "inner radius of a hollow cylinder", gt=0, example="4 mm")
    size: Vector | None = vector(
        None, "edge lengths of a box along its axes", unit="mm", example='["30 mm", "20 mm", "10 mm"]'
    )
    mesh: str | None = file("STL file of a closed surface, global coordinates", "lever.stl")
    mesh_unit: float = quantity("1 mm", "length unit of that file", "assumed", gt=0)
    facets: Numbers | None = series(
        "corners of triangles in global coordinates, anticlockwise from outside, instead of a file",
        unit="m",
        example='"0, 0, 0, 1, 0, 0, 0, 1, 0 m"',
    )
    scale: float | None = number(None, "size of a mesh over that of its triangles", gt=0, example="1.2")
    scaled_about: Vector | None = vector(
        None, "point that the scale leaves in place; by default the mass centre", unit="mm", example=POINT
    )
    mass: float = quantity(None, "mass", unit="kg", gt=0, example="0.3 kg", required=True)
    centre: Vector = vector(None, "position of the mass centre", unit="mm", example=POINT, required=True)
    inertia: Vector = vector(
        None,
        "principal moments of inertia about the mass centre",
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

    elastic: Literal["beam"] | None = choice(None, "what it bends as; rigid without it", example="beam")
    beam: BeamBodyKeys | None = None

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


@dataclass(frozen=True)
class BodySolid:
    """A solid as modelled."""

    #: Of a round solid the middles of both ends, shape (2, 3); of a box, or of the one around a mesh, its
    #: centre and the middles of three faces, shape (4, 3) [m].
    points: FloatArray
    #: Outer and inner radius of a round solid [m]; 0 of others.
    radius: float = 0.0
    inner: float = 0.0
    #: Corners of the triangles of a mesh, shape (3 n, 3): −1 to 1 along each axis of its box. Else None.
    triangles: FloatArray | None = None


def body_solid(body: BodyKeys) -> BodySolid | None:
    """Return the solid of a body; None of one whose keys give mass properties only."""
    if body.start is not None and body.end is not None and body.radius is not None:
        return BodySolid(np.array([body.start, body.end]), body.radius)
    centre = np.array(body.centre)
    first, second = unit(body.first_axis, "first_axis"), unit(body.second_axis, "second_axis")
    if body.length is not None and body.radius is not None:
        half = 0.5 * body.length * np.array(first)
        return BodySolid(np.array([centre - half, centre + half]), body.radius, body.inner_radius or 0.0)
    if body.size is not None:
        axes = np.array([first, second, np.cross(first, second)])
        return BodySolid(_box(centre, 0.5 * np.array(body.size)[:, None] * axes))
    return None if body.facets is None else _mesh(body, np.array(body.facets).reshape(-1, 3))


def _box(centre: FloatArray, halves: FloatArray) -> FloatArray:
    """Return the centre of a box and the middles of three faces from the vectors to them, shape (4, 3)."""
    return np.concatenate([centre[None], centre + halves])


def _mesh(body: BodyKeys, corners: FloatArray) -> BodySolid:
    """Return the solid of a mesh from its corners [m], shape (3 n, 3), and the scale of the body."""
    if body.scale is not None:
        fixed = body.scaled_about or mesh_solid(body.facets or ()).centre
        corners = fixed + body.scale * (corners - fixed)
    low, high = corners.min(axis=0), corners.max(axis=0)
    centre, half = 0.5 * (low + high), 0.5 * (high - low)
    return BodySolid(_box(centre, np.diag(half)), triangles=(corners - centre) / half)
