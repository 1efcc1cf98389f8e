"""Triangles from STL files, and files that are none."""

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.mesh import _TRIANGLE, MOST_BYTES, read_stl

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
