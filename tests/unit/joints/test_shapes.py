"""Shapes of clearances: nodes, areas, normals, their number, and triangles from files."""

import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints.bushing import joint_wrench
from tribodyn.joints.rows import resolving
from tribodyn.joints.shapes import Annulus, Ball, Cylinder, Guide, Mesh, Slot, Sphere, Wall
from tribodyn.joints.shapes.mesh import _TRIANGLE, MOST_BYTES, read_stl
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of
from tribodyn.mechanisms.bushing import bushing_of, grid_of

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


def test_wider_clearances_and_smoother_surfaces_have_more_nodes():
    grids = [resolving(clearance, 1.6e-6) for clearance in (5e-6, 20e-6, 80e-6, 320e-6, 5e-3)]
    assert grids == sorted(grids)
    assert resolving(80e-6, 1.6e-6) == resolving(40e-6, 0.8e-6)


def test_what_is_given_is_kept():
    vane = td.load_case("vsv").replace({"solver.grid.theta": 40})
    assert grid_of(vane) == (40, grid_of(td.load_case("vsv"))[1])
    free = td.load_case("vsv-free").replace({"joints.trunnion.clearance.nodes_along": 6})
    assert clearances_of(free)["trunnion"].grid == (grid_of(td.load_case("vsv"))[0], 6)


@pytest.mark.parametrize("clearance", ["20 um", "80 um", "160 um"])
def test_error_of_the_force_on_the_default_grid(clearance):
    # Measured: 4e-6, 7e-6, 1e-5. On 96 × 16 nodes, for all clearances the same, the wider two had 5e-3, 3e-2.
    run = td.simulate(td.load_case("vsv").replace({"joint.clearance": clearance, "run.duration": "4 s"}))
    assert run.attrs["grid_force_error"] < 1e-4


def spread_over_phases(case):
    """Return the largest change of a light contact's force as its attitude turns from node to node [1]."""
    joint = bushing_of(case)
    forces = []
    for angle in 2.0 * math.pi / joint.grid.theta * np.linspace(0.0, 1.0, 5):
        attitude = np.zeros(8)
        attitude[:2] = joint.geometry.clearance - 3.0 * joint.roughness
        attitude[:2] *= math.cos(angle), math.sin(angle)
        forces.append(np.linalg.norm(joint_wrench(joint.data(), attitude)[:2]))
    return np.ptp(forces) / np.mean(forces)


@pytest.mark.parametrize("clearance", ["20 um", "80 um", "320 um"])
def test_a_default_grid_holds_under_rotation(clearance):
    # Measured: 4e-9 at most. On 24 nodes around: 3e-4, 0.7, 2.
    case = td.load_case("vsv").replace({"joint.clearance": clearance})
    assert spread_over_phases(case) < 1e-6
    assert spread_over_phases(case.replace({"solver.grid.theta": 24})) > 1e-4


CORNERS = np.array([[[0.0, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 0, 0.5], [1, 1, 0], [1, 0, -2.5e-3]]])


def binary(corners: np.ndarray, header: bytes = b"solid but binary") -> bytes:
    triangles = np.zeros(len(corners), dtype=_TRIANGLE)
    triangles["corners"] = corners
    return header.ljust(80) + len(corners).to_bytes(4, "little") + triangles.tobytes()


def text(corners: np.ndarray) -> bytes:
    lines = ["solid a name of many words"]
    for triangle in corners:
        lines += ["  facet normal 0 0 -1.0E+0", "    outer loop"]
        lines += [f"      vertex {x:.9e} {y} {z}" for x, y, z in triangle]
        lines += ["    endloop", "  endfacet"]
    return "\r\n".join([*lines, "endsolid a name"]).encode()


@pytest.mark.parametrize("write", [binary, text])
def test_reading_what_was_written(write: object) -> None:
    # Binary files hold single precision.
    np.testing.assert_allclose(read_stl(write(CORNERS)), CORNERS, rtol=1e-7)  # type: ignore[operator]


def test_capitals_are_text_too() -> None:
    np.testing.assert_array_equal(read_stl(text(CORNERS).upper()), CORNERS)


WHOLE = text(CORNERS)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "neither"),
        (b"PK\x03\x04" + bytes(200), "neither"),
        (binary(CORNERS)[:-1], "something else"),  # "solid" in its header makes it look like text
        (binary(CORNERS, b"a program")[:-1], "neither"),
        (binary(CORNERS[:0]), "0 triangles"),
        (binary(np.full((1, 3, 3), np.nan)), "no numbers"),
        (b"solid\nendsolid", "0 triangles"),
        (WHOLE.replace(b"vertex", b"corner"), "something else"),
        (WHOLE.replace(b"-0.0025", b"tiny"), "no numbers"),
        (WHOLE.replace(b"-0.0025", b"1e999"), "no numbers"),
        (WHOLE.replace(b"endfacet", b"endfacet <script>"), "something else"),
        (b"x" * 80 + (2**32 - 1).to_bytes(4, "little") + bytes(50), "neither"),
    ],
)
def test_what_is_no_mesh_is_refused(content: bytes, says: str) -> None:
    with pytest.raises(InputError, match=says):
        read_stl(content)


def test_a_huge_file_is_refused_unread() -> None:
    class Huge(bytes):
        def __len__(self) -> int:
            return MOST_BYTES + 1

    with pytest.raises(InputError, match="bytes"):
        read_stl(Huge())
