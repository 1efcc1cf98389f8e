"""Mass properties of simple solids of uniform density, as defaults of a body's keys.

A rod is round and goes from one point to another; a cylinder, solid or hollow, is round about the first
principal axis of the body; a box has its sides along the principal axes; a mesh is a closed surface of
triangles.
"""

import math
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import demand
from tribodyn.cases.fields import Vector
from tribodyn.cases.keys import Value
from tribodyn.core.errors import below
from tribodyn.kernels import dense

Given = Mapping[str, Any]  #: Values of the keys of a body [SI].

#: Keys that each solid needs.
NEEDED: Final[Mapping[str, tuple[str, ...]]] = {
    "rod": ("start", "end", "radius"),
    "cylinder": ("centre", "length", "radius"),
    "box": ("centre", "size"),
    "mesh": ("facets",),
}
OPTIONAL: Final[Mapping[str, tuple[str, ...]]] = {
    "cylinder": ("inner_radius",),
    "mesh": ("scale", "scaled_about"),
}
SIZES: Final = tuple(dict.fromkeys(key for keys in (*NEEDED.values(), *OPTIONAL.values()) for key in keys))
_FILES: Final = {"facets": 'a mesh needs its triangles, such as mesh = "lever.stl"'}
FOLLOWING: Final = ("mass", "centre", "inertia", "first_axis", "second_axis")


def of_bodies(given: Mapping[str, Value]) -> dict[str, Value]:
    """Return mass, centre, inertia and axes of all bodies that have a shape, by dotted path.

    ``given``: what was given for a case, by dotted path.
    """
    found: dict[str, Value] = {}
    for prefix in _with_shape(given):
        keys = {path.removeprefix(prefix): value for path, value in given.items() if path.startswith(prefix)}
        if keys["shape"] in NEEDED:
            with below(prefix.rstrip(".")):
                check(keys)
            found |= {prefix + key: value for key, value in of_body(keys).items()}
    return found


def following(given: Collection[str]) -> tuple[str, ...]:
    """Return the paths of keys whose values follow from shapes and were not given."""
    return tuple(
        prefix + key for prefix in _with_shape(given) for key in FOLLOWING if prefix + key not in given
    )


def _with_shape(given: Iterable[str]) -> Iterator[str]:
    for path in given:
        if path.startswith("bodies.") and path.endswith(".shape"):
            yield path.removesuffix("shape")


def of_body(given: Given) -> dict[str, Any]:
    """Return the properties that follow from the shape of a body."""
    volume, squares, placed = _SOLIDS[given["shape"]](given)
    mass = given["mass"] if "mass" in given else given["density"] * volume
    return {"mass": mass, "inertia": tuple(mass * square for square in squares), **placed}


def check(given: Given) -> None:
    """Refuse a shape without its sizes, and with sizes of another one."""
    shape = given["shape"]
    known = (*NEEDED[shape], *OPTIONAL.get(shape, ()), "density")
    for key in NEEDED[shape]:
        words = _FILES.get(key, f"a {shape} needs {', '.join(NEEDED[shape])}")
        demand(key in given, key, words)
    for key in SIZES:
        demand(key in known or key not in given, key, f"a {shape} has {', '.join(known)}")
    demand("density" in given or "mass" in given, "density", f"a {shape} needs its density, or its mass")
    smaller = "inner_radius" not in given or given["inner_radius"] < given["radius"]
    demand(smaller, "inner_radius", "the inner radius is smaller than radius")
    lengths = given.get("size", (1.0,))
    demand(min(lengths) > 0.0, "size", "three lengths above zero")
    ends = shape == "rod" and given["start"] == given["end"]
    demand(not ends, "end", "the rod begins and ends at one point")


#: Volume [m³], principal moments of inertia per mass [m²], and what else follows.
Solid = tuple[float, Vector, dict[str, Any]]


def _round(length: float, radius: float, inner: float = 0.0) -> tuple[float, Vector]:
    """Return volume and inertia per mass of a hollow cylinder along the first axis."""
    squares = (radius * radius) + (inner * inner)
    across = squares / 4.0 + (length * length) / 12.0
    return math.pi * ((radius * radius) - (inner * inner)) * length, (squares / 2.0, across, across)


def _rod(given: Given) -> Solid:
    start, end = given["start"], given["end"]
    length = math.dist(start, end)
    volume, inertia = _round(length, given["radius"])
    axis = tuple((b - a) / length for a, b in zip(start, end, strict=True))
    centre = tuple(0.5 * (a + b) for a, b in zip(start, end, strict=True))
    return volume, inertia, {"centre": centre, "first_axis": axis, "second_axis": _across(axis)}


def _across(axis: tuple[float, ...]) -> Vector:
    """Return a unit vector at right angles to another: of that and the coordinate axis least along it."""
    least = min(range(3), key=lambda i: abs(axis[i]))
    e = [float(i == least) for i in range(3)]
    x, y, z = axis
    cross = (y * e[2] - z * e[1], z * e[0] - x * e[2], x * e[1] - y * e[0])
    length = math.hypot(*cross)
    return cross[0] / length, cross[1] / length, cross[2] / length


def _cylinder(given: Given) -> Solid:
    return *_round(given["length"], given["radius"], given.get("inner_radius", 0.0)), {}


def _box(given: Given) -> Solid:
    a, b, c = given["size"]
    inertia = ((b * b + c * c) / 12.0, (a * a + c * c) / 12.0, (a * a + b * b) / 12.0)
    return a * b * c, inertia, {}


def _mesh(given: Given) -> Solid:
    # Imported here: reading other cases needs no arrays.
    from tribodyn.mechanism.model.solids import mesh_solid

    solid, scale = mesh_solid(given["facets"]), given.get("scale", 1.0)
    centre = solid.centre
    if "scaled_about" in given:
        centre = given["scaled_about"] + scale * (centre - given["scaled_about"])
    placed = {"centre": centre, "first_axis": solid.axes[0], "second_axis": solid.axes[1]}
    inertia = tuple((scale * scale * solid.squares).tolist())
    volume = scale**3 * solid.volume
    demand(volume > 0.0 and min(inertia) > 0.0, "facets", "the solid is too small to have a mass")
    return volume, inertia, {key: tuple(v.tolist()) for key, v in placed.items()}


_SOLIDS: Final[Mapping[str, Callable[[Given], Solid]]] = {
    "rod": _rod,
    "cylinder": _cylinder,
    "box": _box,
    "mesh": _mesh,
}


@dataclass(frozen=True)
class MeshSolid:
    """A solid of uniform density."""

    volume: float  #: [m³].
    centre: FloatArray  #: Its centroid [m], shape (3,).
    squares: FloatArray  #: Principal moments of inertia about the centroid per mass [m²], shape (3,), rising.
    axes: FloatArray  #: Principal axes as rows, shape (3, 3).


def mesh_solid(facets: Sequence[float]) -> MeshSolid:
    """Return the solid inside a surface.

    ``facets``: corners of triangles, anticlockwise from outside [m], 9 n numbers. Raises InputError if the
    surface is not closed, or its triangles face inwards.
    """
    demand(len(facets) > 0 and len(facets) % 9 == 0, "facets", "a triangle has nine coordinates")
    corners = np.array(facets).reshape(-1, 3, 3)
    _require_closed(corners)
    middle = 0.5 * (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1)))
    corners = corners - middle
    a, b, c = np.moveaxis(corners, 1, 0)
    volumes = np.add.reduce(a * np.cross(b, c), axis=1) / 6.0
    volume = math.fsum(volumes)
    demand(volume > 0.0, "facets", "corners of triangles go anticlockwise, seen from outside")
    sums = a + b + c
    centre = np.array([math.fsum(column) for column in (volumes[:, None] * sums).T]) / (4.0 * volume)
    second = _second_moments(volumes, (a, b, c, sums)) / (20.0 * volume)
    second -= np.outer(centre, centre)
    values, vectors = dense.eigh(second)
    # About an axis the inertia per mass is the sum of the second moments along the other two.
    squares = math.fsum(values) - values
    order = np.argsort(squares, kind="stable")
    return MeshSolid(volume, middle + centre, squares[order], vectors.T[order])


def _second_moments(weights: FloatArray, points: Sequence[FloatArray]) -> FloatArray:
    """Return the sum of weighted products of coordinates, shape (3, 3)."""
    found = np.zeros((3, 3))
    for place in points:
        found += [[math.fsum(weights * place[:, i] * place[:, j]) for j in range(3)] for i in range(3)]
    return found


def _require_closed(corners: FloatArray) -> None:
    """Refuse a surface that has an edge without another triangle on its other side."""
    points = [[tuple(corner) for corner in triangle] for triangle in corners.tolist()]
    edges = Counter((triangle[i], triangle[(i + 1) % 3]) for triangle in points for i in range(3))
    open_edges = sum(n != edges[end, start] for (start, end), n in edges.items())
    words = f"the surface is not closed: {open_edges} edges have a triangle on one side only"
    demand(open_edges == 0, "facets", words)
