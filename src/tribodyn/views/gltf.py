"""Moving solids as a file of glTF 2.0 in its binary form, which browsers and modellers open.

After the specification of the Khronos Group, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.
"""

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray

_FLOAT: Final = 5126
_INDEX: Final = 5125
_KINDS: Final = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
#: Quaternion (x, y, z, w) that turns this axis of the drawing upwards, which is y in such files.
_UP: Final = {"y": [0.0, 0.0, 0.0, 1.0], "z": [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]}


@dataclass(frozen=True)
class Solid:
    """A rigid body and its motion."""

    name: str  #: Its name.
    colour: tuple[float, float, float]  #: Red, green, blue, from 0 to 1.
    vertices: FloatArray  #: In the axes of the body [m], shape (n, 3).
    triangles: NDArray[np.int64]  #: Numbers of their vertices, anticlockwise from outside, shape (m, 3).
    #: Of the body over time: origin [m] and unit quaternion, scalar first, shapes (n_t, 3) and (n_t, 4).
    position: FloatArray
    orientation: FloatArray


class _File:
    """A file under way: its arrays one after the other, and what says where they are."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.parts: dict[str, list[dict[str, Any]]] = {"bufferViews": [], "accessors": []}

    def add(self, values: FloatArray | NDArray[np.int64]) -> int:
        """Add an array and return the number of its accessor; integers are indices of vertices."""
        whole = values.dtype.kind == "i"
        data = np.ascontiguousarray(values, dtype="<u4" if whole else "<f4").reshape(len(values), -1)
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": data.nbytes}
        self.parts["bufferViews"].append(view)
        self.parts["accessors"].append(
            {
                "bufferView": len(self.parts["bufferViews"]) - 1,
                "componentType": _INDEX if whole else _FLOAT,
                "count": len(data),
                "type": _KINDS[data.shape[1]],
                "min": data.min(axis=0).tolist(),
                "max": data.max(axis=0).tolist(),
            }
        )
        self.content += data.tobytes()
        return len(self.parts["accessors"]) - 1


def gltf(solids: Sequence[Solid], times: FloatArray, up: str) -> bytes:
    """Return the content of a file with the extension ``.glb``.

    ``solids``: at least one; ``times``: of their positions [s], increasing from 0, shape (n_t,); ``up``: axis
    of the drawing that points upwards, ``y`` or ``z``.
    """
    file = _File()
    time = file.add(times)
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, Any]] = []
    for number, solid in enumerate(solids):
        for path, values in (("translation", solid.position), ("rotation", _continuous(solid.orientation))):
            channels.append({"sampler": len(samplers), "target": {"node": number, "path": path}})
            samplers.append({"input": time, "output": file.add(values), "interpolation": "LINEAR"})
    meshes = [_mesh(file, number, solid) for number, solid in enumerate(solids)]
    root = {"name": "mechanism", "rotation": _UP[up], "children": list(range(len(solids)))}
    scene = {
        "asset": {"version": "2.0", "generator": "tribodyn"},
        "scene": 0,
        "scenes": [{"nodes": [len(solids)]}],
        "nodes": [*({"name": solid.name, "mesh": k} for k, solid in enumerate(solids)), root],
        "meshes": meshes,
        "materials": [_material(solid) for solid in solids],
        "animations": [{"name": "run", "channels": channels, "samplers": samplers}],
        **file.parts,
        "buffers": [{"byteLength": len(file.content)}],
    }
    return _packed(json.dumps(scene).encode(), bytes(file.content))


def _mesh(file: _File, number: int, solid: Solid) -> dict[str, Any]:
    """Return a mesh of facets, each with corners of its own, so that its edges are sharp."""
    corners = solid.vertices[solid.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    attributes = {
        "POSITION": file.add(corners.reshape(-1, 3)),
        "NORMAL": file.add(np.repeat(normals, 3, axis=0)),
    }
    indices = file.add(np.arange(3 * len(corners)))
    return {
        "name": solid.name,
        "primitives": [{"attributes": attributes, "indices": indices, "material": number}],
    }


def _material(solid: Solid) -> dict[str, Any]:
    looks = {"baseColorFactor": [*solid.colour, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6}
    return {"name": solid.name, "pbrMetallicRoughness": looks}


def _continuous(orientation: FloatArray) -> FloatArray:
    """Return quaternions, scalar last, each with the sign that is nearer to the one before."""
    sign = np.sign(np.sum(orientation[1:] * orientation[:-1], axis=1))
    turned = orientation * np.cumprod(np.append(1.0, np.where(sign == 0.0, 1.0, sign)))[:, None]
    return np.roll(turned, -1, axis=1)


def _packed(scene: bytes, content: bytes) -> bytes:
    """Return header and both chunks, each filled up to whole words."""
    scene += b" " * (-len(scene) % 4)
    content += b"\0" * (-len(content) % 4)
    chunks = struct.pack("<I4s", len(scene), b"JSON") + scene
    chunks += struct.pack("<I4s", len(content), b"BIN\0") + content
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
