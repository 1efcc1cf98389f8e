"""Triangles from STL files, and files that are none."""

import numpy as np

from tribodyn.joints.shapes.mesh import read_stl

CORNERS = np.array([[[0.0, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 0, 0.5], [1, 1, 0], [1, 0, -2.5e-3]]])


def text(corners: np.ndarray) -> bytes:
    lines = ["solid a name of many words"]
    for triangle in corners:
        lines += ["  facet normal 0 0 -1.0E+0", "    outer loop"]
        lines += [f"      vertex {x:.9e} {y} {z}" for x, y, z in triangle]
        lines += ["    endloop", "  endfacet"]
    return "\r\n".join([*lines, "endsolid a name"]).encode()


def test_capitals_are_text_too() -> None:
    np.testing.assert_array_equal(read_stl(text(CORNERS).upper()), CORNERS)
