"""Bodies as solids: their volume is the one that their mass follows from."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanism.model.body import body_solid
from tribodyn.mechanism.sections import mechanism

STEEL = 7850.0
SHAPES = {
    "rod": {"start": "0, 0, 0 mm", "end": "30, 40, 0 mm", "radius": "4 mm"},
    "cylinder": {"centre": "1, 2, 3 mm", "length": "20 mm", "radius": "8 mm", "first_axis": [0, 0, 1]},
    "box": {
        "centre": "0, 0, 5 mm",
        "size": "30, 20, 10 mm",
        "first_axis": [0, 1, 0],
        "second_axis": [0, 0, 1],
    },
}


def drawn(shape: str, **keys: object) -> td.Mechanism:
    made = td.Mechanism("One body", run={"duration": "1 s"}).body("part", shape=shape, **keys)
    return made.revolute("pivot", "ground", "part", point="0, 0, 0 mm", axis=[0, 0, 1])


@pytest.mark.parametrize("shape", SHAPES)
def test_a_solid_has_the_volume_and_the_centre_of_its_body(shape: str) -> None:
    body = drawn(shape, density=f"{STEEL} kg/m^3", **SHAPES[shape]).case().bodies["part"]
    solid = body_solid(body)
    assert solid is not None
    first, *others = solid.points
    if solid.radius:
        volume = np.pi * solid.radius**2 * np.linalg.norm(others[0] - first)
        middle = 0.5 * (first + others[0])
    else:
        halves = np.array(others) - first
        volume, middle = 8.0 * abs(np.linalg.det(halves)), first
        assert halves @ halves.T == pytest.approx(np.diag(np.diag(halves @ halves.T)), abs=1e-18)
    assert STEEL * volume == pytest.approx(body.mass, rel=1e-12)
    np.testing.assert_allclose(middle, body.centre, atol=1e-15)


def test_a_body_without_a_shape_has_no_solid() -> None:
    plain = td.Mechanism("One body", run={"duration": "1 s"})
    plain.body("part", mass="1 kg", centre="1, 0, 0 mm", inertia="1e-4, 1e-4, 1e-4 kg m^2")
    case = plain.revolute("pivot", "ground", "part", point="0, 0, 0 mm", axis=[0, 0, 1]).case()
    assert body_solid(case.bodies["part"]) is None


def tetrahedron(edge: float) -> np.ndarray:
    """Return the corners of its triangles [m], shape (12, 3)."""
    o, x, y, z = np.zeros(3), *(edge * np.eye(3))
    return np.array([o, y, x, o, x, z, o, z, y, x, y, z])


def test_a_mesh_has_its_triangles_where_they_are_and_as_large_as_its_scale() -> None:
    corners = tetrahedron(0.03)
    numbers = ", ".join(f"{number:.9g}" for number in corners.ravel().tolist()) + " m"
    keys = {"facets": numbers, "density": f"{STEEL} kg/m^3", "scale": 2.0, "scaled_about": "0, 0, 0 mm"}
    solid = body_solid(drawn("mesh", **keys).case().bodies["part"])
    assert solid is not None
    assert solid.triangles is not None
    centre, *faces = solid.points
    found = centre + solid.triangles @ (np.array(faces) - centre)
    np.testing.assert_allclose(found, 2.0 * corners, atol=1e-15)


def test_a_hollow_cylinder_is_hollow() -> None:
    case = drawn("cylinder", density=f"{STEEL} kg/m^3", inner_radius="5 mm", **SHAPES["cylinder"]).case()
    solid = body_solid(case.bodies["part"])
    assert solid is not None
    assert (solid.radius, solid.inner) == (pytest.approx(0.008), pytest.approx(0.005))


REACTIONS = ("reaction_force", "reaction_moment")


def test_the_scene_moves_solids_with_their_bodies() -> None:
    """Check that a rod that turns about the origin by a right angle lies along Y in the last frame."""
    case = drawn("rod", mass="1 kg", start="0, 0, 0 mm", end="100, 0, 0 mm", radius="5 mm").case()
    half = np.sqrt(0.5)
    dataset = xr.Dataset(
        {
            "position": (("time", "body", "axis"), [[[0.05, 0.0, 0.0]], [[0.0, 0.05, 0.0]]]),
            "orientation": (("time", "body", "part"), [[[1.0, 0.0, 0.0, 0.0]], [[half, 0.0, 0.0, half]]]),
            "frame_time": ("frame", [0.0, 1.0]),
            "clearance": ("joint", [np.nan] * len(case.joints)),
            **dict.fromkeys(REACTIONS, (("time", "joint", "axis"), np.zeros((2, len(case.joints), 3)))),
        },
        coords={"time": [0.0, 1.0], "joint": list(case.joints)},
        attrs={"case": case.to_toml()},
    )
    payload = mechanism.data(dataset)
    assert payload is not None
    solid = payload["bodies"][0]["solid"]
    assert (solid["n"], solid["radius"]) == (2, pytest.approx(5.0))
    points = np.asarray(solid["points"].array, dtype=float).reshape(2, 2, 3)
    np.testing.assert_allclose(points[-1], [[0.0, 0.0, 0.0], [0.0, 100.0, 0.0]], atol=1e-4)
