"""Node generators: areas, normals, refusals."""

import math

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.joints.shapes import Annulus, Ball, Cylinder, Guide, Mesh, Slot, Sphere, Wall

#: Two triangles of a square centimetre at z = 0 that face −z.
CUBE_FACE = np.array([[[0.0, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [1, 0, 0]]]) * 1e-2
TRIANGLE = (
    Wall("bottom", (-6e-3, -2e-3), (6e-3, -2e-3)),
    Wall("right", (6e-3, -2e-3), (0.0, 6e-3)),
    Wall("left", (0.0, 6e-3), (-6e-3, -2e-3)),
)
MADE = {
    "cylinder": Cylinder(6e-3, 20e-6, 20e-3),
    "annulus": Annulus(6e-3, 9e-3),
    "sphere": Sphere(8e-3, 20e-6, 0.8),
    "ball": Ball(8e-3, 20e-6, 0.1),
    "mesh": Mesh(CUBE_FACE, 20e-6, 3e-3),
    "guide": Guide(TRIANGLE, 20e-6, 30e-3),
    "slot": Slot(6e-3, 20e-6, 20e-3),
}


@pytest.mark.parametrize("shape", MADE)
def test_nodes_are_whole(shape: str) -> None:
    for surface in MADE[shape].surfaces((12, 5)):
        n = surface.area.size
        assert surface.position.shape == surface.normal.shape == (n, 3)
        assert surface.gap.shape == (n,)
        np.testing.assert_allclose(np.linalg.norm(surface.normal, axis=1), 1.0, rtol=1e-14)
        assert math.prod(surface.field_shape) == n
        assert sorted(
            node for row in surface.rows for node in range(row["first"], row["first"] + row["count"])
        ) == [*range(n)]


def test_areas_are_those_of_the_socket() -> None:
    # Gauss-Legendre is exact for the areas of all three.
    barrel = MADE["cylinder"].surfaces((12, 5))[0]
    assert barrel.area.sum() == pytest.approx(2.0 * math.pi * 6.02e-3 * 20e-3, rel=1e-13)
    ring = MADE["annulus"].surfaces((12, 5))[0]
    assert ring.area.sum() == pytest.approx(math.pi * (81e-6 - 36e-6), rel=1e-13)
    race = MADE["sphere"].surfaces((12, 5))[0]
    assert race.area.sum() == pytest.approx(4.0 * math.pi * 8.02e-3**2 * math.sin(0.8), rel=1e-13)
    mesh = MADE["mesh"].surfaces((12, 5))[0]
    assert mesh.area.sum() == pytest.approx(1e-4, rel=1e-13)


def test_normals_point_into_the_socket() -> None:
    barrel, upper, lower = Cylinder(6e-3, 20e-6, 20e-3, axial=5e-6, flange=8e-3).surfaces((12, 5))
    assert (np.sum(barrel.normal * barrel.position, axis=1) > 0.0).all()
    # Flanges of the journal stand outside and rest on the ends.
    assert (upper.name, lower.name) == ("upper face", "lower face")
    assert (upper.position[:, 2] == 10e-3).all()
    assert (upper.normal == [0.0, 0.0, -1.0]).all()
    assert (lower.position[:, 2] == -10e-3).all()
    assert (lower.normal == [0.0, 0.0, 1.0]).all()
    race = MADE["sphere"].surfaces((12, 5))[0]
    np.testing.assert_allclose(race.position, 8e-3 * race.normal, atol=1e-18)
    # A socket that faces −z is filled above: into it means +z, and the journal lies below by the gap.
    mesh = MADE["mesh"].surfaces((12, 5))[0]
    np.testing.assert_allclose(mesh.normal, np.tile([0.0, 0.0, 1.0], (mesh.area.size, 1)), atol=1e-15)
    np.testing.assert_allclose(mesh.position[:, 2], -20e-6, rtol=1e-12)


def test_one_face_alone() -> None:
    names = [
        surface.name for surface in Cylinder(6e-3, 2e-5, 2e-2, axial_upper=0.0, flange=8e-3).surfaces((12, 5))
    ]
    assert names == ["barrel", "upper face"]


def test_a_ball_in_a_bore_has_its_nodes_where_it_can_touch() -> None:
    (band,) = Ball(8e-3, 20e-6).surfaces((12, 8))
    assert band.gap.min() < 22e-6
    assert band.gap.max() == pytest.approx(40e-6, rel=1e-12)  # at the edges
    np.testing.assert_allclose(np.linalg.norm(band.position, axis=1), 8e-3, rtol=1e-14)


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda: Cylinder(-1.0, 1e-5, 1e-2), "radius"),
        (lambda: Cylinder(1e-3, math.nan, 1e-2), "radial"),
        (lambda: Cylinder(1e-3, 1e-5, 1e-2, axial=1e-5), "flange"),
        (lambda: Cylinder(1e-3, 1e-5, 1e-2, flange=2e-3), "flange"),
        (lambda: Cylinder(1e-3, 1e-5, 1e-2, axial=1e-5, flange=5e-4).surfaces((8, 3)), "outer"),
        (lambda: Cylinder(1e-3, 1e-5, 1e-2, axial=1e-5, flange=2e-3).points(), "axial"),
        (lambda: Annulus(2e-3, 1e-3), "outer"),
        (lambda: Annulus(1e-3, 2e-3, clearance=-1e-6), "axial"),
        (lambda: Annulus(1e-3, 2e-3, direction=0.5), "direction"),
        (lambda: Annulus(1e-3, 2e-3).points(), "contact"),
        (lambda: Sphere(1e-3, 1e-5, 2.0), "band"),
        (lambda: Ball(1e-3, 1e-5, 1.6), "band"),
        (lambda: Ball(1e-3, 1e-5, 0.1).points(), "contact"),
        (lambda: Mesh(np.zeros((0, 3, 3)), 1e-5, 1e-3), "facets"),
        (lambda: Mesh(np.zeros((2, 3, 3)), 1e-5, 1e-3).surfaces((1, 1)), "facets"),
        (lambda: Mesh(np.full((1, 3, 3), math.inf), 1e-5, 1e-3), "facets"),
        (lambda: Mesh(CUBE_FACE, 1e-5, 1e-7).surfaces((1, 1)), "edge"),
    ],
)
def test_what_makes_no_joint_is_refused(make: object, key: str) -> None:
    with pytest.raises(InputError) as caught:
        make()  # type: ignore[operator]
    assert caught.value.key == key
