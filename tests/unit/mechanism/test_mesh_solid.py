"""Mass properties of solids inside closed surfaces of triangles."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.model.solids import mesh_solid

SIZES = np.array([0.03, 0.02, 0.01])
PLACE = np.array([0.5, -0.2, 0.1])


def hull(points: np.ndarray) -> np.ndarray:
    """Return the triangles around points [m], outsides anticlockwise, shape (n, 3, 3)."""
    found = ConvexHull(points)
    facets = points[found.simplices]
    across = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    inside = np.sum(across * found.equations[:, :3], axis=1) < 0.0
    facets[inside] = facets[inside, ::-1]
    return facets


def box(turn: Rotation | None = None) -> np.ndarray:
    corners = 0.5 * SIZES * np.array(list(product((-1.0, 1.0), repeat=3)))
    return hull(PLACE + (corners if turn is None else turn.apply(corners)))


def stl(facets: np.ndarray, scale: float = 1e3) -> str:
    """Return facets [m] as the text of an STL file in millimetres."""
    triangles = (
        "facet normal 0 0 0\nouter loop\n"
        + "\n".join("vertex " + " ".join(f"{scale * x:.9g}" for x in corner) for corner in triangle)
        + "\nendloop\nendfacet"
        for triangle in facets.tolist()
    )
    return "solid made\n" + "\n".join(triangles) + "\nendsolid made\n"


def test_a_box_has_the_properties_of_the_closed_form() -> None:
    turn = Rotation.from_rotvec([0.3, -0.8, 0.5])
    solid = mesh_solid(box(turn).ravel().tolist())
    a, b, c = SIZES**2 / 12.0
    assert solid.volume == pytest.approx(np.prod(SIZES), rel=1e-12)
    assert solid.centre == pytest.approx(PLACE, abs=1e-15)
    assert solid.squares == pytest.approx([b + c, a + c, a + b], rel=1e-12)
    assert np.abs(solid.axes @ turn.as_matrix()) == pytest.approx(np.eye(3), abs=1e-7)


def test_a_hollow_box_is_a_box_less_another() -> None:
    outer = box()
    inner = (PLACE + 0.5 * (outer - PLACE))[:, ::-1]
    solid = mesh_solid(np.concatenate([outer, inner]).ravel().tolist())
    a, b, c = SIZES**2 / 12.0 * (1.0 - 0.5**5) / (1.0 - 0.5**3)
    assert solid.volume == pytest.approx(np.prod(SIZES) * (1.0 - 0.5**3), rel=1e-12)
    assert solid.squares == pytest.approx([b + c, a + c, a + b], rel=1e-12)


def test_a_tetrahedron_off_the_origin() -> None:
    # Of a corner tetrahedron the centroid is at a quarter of the edges.
    points = np.vstack([np.zeros(3), np.diag(SIZES)])
    solid = mesh_solid(hull(points + PLACE).ravel().tolist())
    assert solid.volume == pytest.approx(np.prod(SIZES) / 6.0, rel=1e-12)
    assert solid.centre == pytest.approx(PLACE + SIZES / 4.0, abs=1e-15)
    about_centroid = np.sum(SIZES**2) * (1.0 / 10.0 - 1.0 / 16.0)
    assert np.sum(solid.squares) / 2.0 == pytest.approx(about_centroid, rel=1e-12)


@pytest.mark.parametrize(
    ("facets", "said"),
    [
        (box()[:-1].ravel(), "not closed: 3 edges"),
        (box()[:, ::-1].ravel(), "anticlockwise"),
        (box().ravel()[:-1], "nine coordinates"),
    ],
)
def test_no_solid(facets: np.ndarray, said: str) -> None:
    with pytest.raises(InputError, match=said):
        mesh_solid(facets.tolist())


def case(folder: Path, **keys: object) -> td.Mechanism:
    (folder / "lever.stl").write_text(stl(box()))
    drawn = td.Mechanism("Lever", run={"duration": "10 ms"})
    drawn.parameter("size", "30 mm")
    drawn.body("lever", shape="mesh", mesh=str(folder / "lever.stl"), density="7850 kg/m^3", **keys)
    return drawn.revolute("pin", "ground", "lever", point="0, 0, 0 mm", axis=[0, 0, 1])


def test_a_body_from_a_file_and_its_scale(tmp_path: Path) -> None:
    plain = case(tmp_path).case().bodies["lever"]
    assert plain.mass == pytest.approx(7850.0 * np.prod(SIZES), rel=1e-6)
    assert plain.centre == pytest.approx(PLACE, abs=1e-9)
    swept = case(tmp_path, scale="size / (15 mm)", scaled_about="0, 0, 0 mm").case()
    for factor, larger in ((2.0, swept), (4.0, swept.replace({"parameters.size": "60 mm"}))):
        body = larger.bodies["lever"]
        assert body.mass == pytest.approx(factor**3 * plain.mass)
        assert body.inertia == pytest.approx(factor**5 * np.array(plain.inertia))
        assert body.centre == pytest.approx(factor * PLACE)
    again = swept.replace({"bodies.lever.scale": 0.5})
    assert again.bodies["lever"].mass == pytest.approx(0.125 * plain.mass)


def test_a_scale_is_that_of_a_mesh(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="a mesh needs its triangles"):
        td.Mechanism("Lever").body("lever", shape="mesh", density="7850 kg/m^3").case()
    with pytest.raises(InputError, match="this belongs to a shape"):
        td.Mechanism("Lever").body(
            "lever", mass="1 kg", centre="0, 0, 0 mm", inertia="1, 1, 1 kg m^2", scale=2.0
        ).case()


def test_a_unit_of_a_file_is_one_of_it(tmp_path: Path) -> None:
    plain = case(tmp_path, mesh_unit="1 cm").case().bodies["lever"]
    assert case(tmp_path, mesh_unit="cm").case().bodies["lever"] == plain
