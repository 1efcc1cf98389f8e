"""A socket of triangles, with a shaft that fits it at a constant gap: anything conformal.

A node lies in the middle of each triangle. Triangles point out of the material of the socket, so the normal
into it is against theirs. Turning is held on all three axes; it must stay small, for the gap follows it to
first order.
"""

import re
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.surface import Points, Surface, check_positive, no_points
from tribodyn.kernels.joints.surface.data import Row
from tribodyn.kernels.joints.surface.tilt import WHOLE

PATCH = 32  #: Nodes that are looked at together before each is.
MOST_NODES = 1_000_000


@dataclass(frozen=True)
class Mesh:
    """A socket of triangles."""

    #: Corners in the socket's frame [m], shape (n, 3, 3), anticlockwise as seen from the shaft.
    facets: FloatArray
    clearance: float  #: Gap as drawn, everywhere [m].
    edge: float  #: Longest edge that a triangle may have [m]; longer ones are split.

    def __post_init__(self) -> None:
        """Refuse invalid meshes."""
        check_positive("mesh", gap=self.clearance, edge=self.edge)
        facets = np.asarray(self.facets)
        if facets.ndim != 3 or facets.shape[1:] != (3, 3) or not len(facets):
            raise InputError(f"a mesh has triangles, shape (n, 3, 3), not {facets.shape}", key="facets")
        if not np.isfinite(facets).all():
            raise InputError("has corners that are no numbers", key="facets")

    def surfaces(self, grid: tuple[int, int]) -> tuple[Surface, ...]:
        """Return the mesh; its nodes are as many as its triangles, whatever the grid."""
        facets = split(np.asarray(self.facets, dtype=np.float64), self.edge)
        across = 0.5 * np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
        area = np.linalg.norm(across, axis=1)
        kept = area > 0.0
        if not kept.any():
            raise InputError("no triangle has an area", key="facets")
        middle, area, across = facets.mean(axis=1)[kept], area[kept], across[kept]
        order = nearby(middle)
        middle, area = middle[order], area[order]
        normal = -across[order] / area[:, None]
        position = middle - self.clearance * normal
        return (
            Surface(
                name="mesh",
                position=position,
                normal=normal,
                area=area,
                gap=np.full(area.size, self.clearance),
                rows=patches(position, normal, area),
                tilt=WHOLE,
                size=float(np.sqrt(area.sum() / np.pi)),
                axes={"node": np.arange(area.size, dtype=np.float64)},
            ),
        )

    def points(self) -> Points:
        """Refuse a point contact."""
        return no_points("mesh")


def split(facets: FloatArray, edge: float) -> FloatArray:
    """Return triangles whose edges are not longer than ``edge``, each long one cut into four."""
    done = []
    while len(facets):
        sides = np.linalg.norm(facets - np.roll(facets, -1, axis=1), axis=2)
        long = sides.max(axis=1) > edge
        done.append(facets[~long])
        if sum(map(len, done)) + 4 * long.sum() > MOST_NODES:
            raise InputError(
                f"makes more than {MOST_NODES} nodes of this mesh; allow longer edges", key="edge"
            )
        corner = facets[long]
        middle = 0.5 * (corner + np.roll(corner, -1, axis=1))
        small = [np.stack([corner[:, k], middle[:, k], middle[:, k - 1]], axis=1) for k in range(3)]
        facets = np.concatenate([*small, middle])
    return np.concatenate(done)


def nearby(points: FloatArray) -> NDArray[np.intp]:
    """Return an order of points, shape (n, 3), in which neighbours follow each other.

    The longest side of a box is halved again and again.
    """
    order, boxes = [], [np.arange(len(points))]
    while boxes:
        box = boxes.pop()
        if box.size <= PATCH:
            order.append(box)
            continue
        side = int(np.ptp(points[box], axis=0).argmax())
        half = PATCH * max(1, round(box.size / (2 * PATCH)))
        box = box[np.argsort(points[box, side], kind="stable")]
        boxes += [box[half:], box[:half]]
    return np.concatenate(order)


def patches(position: FloatArray, normal: FloatArray, area: FloatArray) -> NDArray[np.void]:
    """Return records of rows of neighbouring nodes, with bounds that return whether any can touch."""
    first = np.arange(0, len(area), PATCH)
    rows = np.zeros(first.size, dtype=Row)
    rows["first"], rows["whole"] = first, 1.0
    moment = np.cross(position, normal)
    for row in rows:
        nodes = slice(int(row["first"]), min(int(row["first"]) + PATCH, len(area)))
        row["count"], row["area"] = nodes.stop - nodes.start, area[nodes].sum()
        for k, values in enumerate((normal[nodes], moment[nodes])):
            mean = values.mean(axis=0)
            row[("normal", "moment")[k]] = mean
            row["spread"][k] = np.linalg.norm(values - mean, axis=1).max()
    return rows


_HEADER: Final = 84
_TRIANGLE: Final = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
MOST_BYTES: Final = 300 * MOST_NODES  #: Size of a triangle in text, times the largest number of them.
_LOOP: Final = rb"outer\s+loop((?:\s+vertex(?:\s+\S+){3}){3})\s+endloop"
_FACET: Final = re.compile(rb"facet\s+normal(?:\s+\S+){3}\s+" + _LOOP + rb"\s+endfacet")


def read_stl(content: bytes) -> FloatArray:
    """Return the corners of the triangles in a file's content, shape (n, 3, 3), in the unit of the file."""
    if len(content) > MOST_BYTES:
        raise InputError(f"has {len(content)} bytes; a mesh may have {MOST_NODES} triangles")
    counted = int.from_bytes(content[80:_HEADER], "little")
    if len(content) == _HEADER + _TRIANGLE.itemsize * counted and len(content) >= _HEADER:
        corners = np.frombuffer(content, _TRIANGLE, offset=_HEADER)["corners"].astype(np.float64)
    elif content.lstrip()[:5].lower() == b"solid":
        corners = _text(content)
    else:
        raise InputError("is neither a binary STL file, whose length fits its triangles, nor one in text")
    if not 0 < len(corners) <= MOST_NODES:
        raise InputError(f"has {len(corners)} triangles; a mesh has at least one and at most {MOST_NODES}")
    if not np.isfinite(corners).all():
        raise InputError("has corners that are no numbers")
    return corners


def _text(content: bytes) -> FloatArray:
    """Return the corners of a file in text: triangles and nothing else up to ``endsolid``."""
    lower = content.lower()
    body = lower[lower.find(b"\n") + 1 :].partition(b"endsolid")[0]
    facets = _FACET.findall(body)
    if _FACET.sub(b"", body).strip():
        raise InputError("has something else than triangles in its text")
    try:
        numbers = [float(word) for facet in facets for word in facet.split() if word != b"vertex"]
    except ValueError as error:
        raise InputError("has corners that are no numbers") from error
    return np.array(numbers, dtype=np.float64).reshape(-1, 3, 3)
