"""Triangles from a file in STL, binary or text.

Binary: 80 bytes of any kind, the number of triangles in four bytes, and for each of them 50 bytes, its
normal, its three corners as twelve single precision numbers, and two bytes more, all little-endian (3D
Systems, 1988). Normals are not read: corners run anticlockwise seen from outside the material. The format
knows no unit.
"""

from __future__ import annotations

import re
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.mesh import MOST_NODES

_HEADER: Final = 84
_TRIANGLE: Final = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
MOST_BYTES: Final = 300 * MOST_NODES
"""Size of a triangle in text, times the largest number of them."""
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
