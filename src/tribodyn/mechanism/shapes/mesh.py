"""Any surface, given by triangles."""

from typing import Any, ClassVar

import numpy as np

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import Numbers, file, quantity, series
from tribodyn.joints.shapes import Mesh
from tribodyn.mechanism.joints.joint_type import JointType
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local


class MeshKeys(NamedGroup):
    """Triangles and their gap."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("mesh", "facets"),)

    mesh: str | None = file("STL file of the bore, global coordinates, outsides anticlockwise", "socket.stl")
    mesh_unit: float = quantity("1 mm", "length unit of that file", "assumed", gt=0)
    mesh_edge: float | None = quantity(
        None, "longest edge of a triangle; longer ones are split", gt=0, example="0.5 mm"
    )
    gap: float | None = quantity(None, "constant gap of a mesh", gt=0, example="20 um")
    facets: Numbers | None = series(
        "corners of triangles in global coordinates, instead of a file",
        unit="m",
        example='"0, 0, 0, 1, 0, 0, 0, 1, 0 m"',
    )


class Facets(ClearanceShape):
    """A surface of triangles."""

    NAME: ClassVar[str] = "mesh"
    TYPES: ClassVar[tuple[str, ...]] = ("revolute", "cylindrical", "spherical")
    NEEDED: ClassVar[dict[str, str]] = {"facets": 'triangles, such as mesh = "socket.stl"', "gap": "its gap"}
    EXAMPLE: ClassVar[dict[str, object]] = {"facets": "10, -5, -5, 10, 5, -5, 10, 0, 5 mm", "gap": "20 um"}
    KEYS: ClassVar[type[NamedGroup]] = MeshKeys

    def check(self, kind: JointType, keys: Any) -> None:
        """Refuse corners that are no triangles, and temperatures."""
        demand(len(keys.facets) % 9 == 0, "clearance.facets", "a triangle has nine coordinates")
        words = "the gap of a mesh is given as it is in the run"
        demand(not keys.temperature.changes, "clearance.temperature", words)

    def of(self, keys: Any, local: Local) -> Mesh:
        """Return the mesh."""
        facets = local(np.array(keys.facets).reshape(-1, 3, 3))
        edge = keys.mesh_edge or float(np.ptp(facets.reshape(-1, 3), axis=0).max())
        return Mesh(facets, keys.gap, edge)

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the gap twice, and the size of the mesh."""
        return shape.clearance, shape.clearance, float(np.ptp(shape.facets))

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the number of triangles."""
        return len(keys.facets) / 9.0
