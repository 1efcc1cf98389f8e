"""Any surface, given by triangles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from tribodyn.cases.case import demand
from tribodyn.core.arrays import FloatArray
from tribodyn.joints.shapes import Mesh
from tribodyn.mechanisms.general.shapes.base import ClearanceShape


class Facets(ClearanceShape):
    """A surface of triangles."""

    NAME: ClassVar[str] = "mesh"
    NEEDED: ClassVar[Mapping[str, str]] = {
        "facets": 'triangles, such as mesh = "socket.stl"',
        "gap": "its gap",
    }

    def check(self, keys: Any) -> None:
        """Refuse temperatures."""
        words = "the gap of a mesh is given as it is in the run"
        demand(not keys.temperature.changes, "clearance.temperature", words)

    def of(self, keys: Any, facets: FloatArray | None = None) -> Mesh:
        """Return the mesh."""
        assert facets is not None
        edge = keys.mesh_edge or float(np.ptp(facets.reshape(-1, 3), axis=0).max())
        return Mesh(facets, keys.gap, edge)

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the gap twice, and the size of the mesh."""
        return shape.clearance, shape.clearance, float(np.ptp(shape.facets))

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the number of triangles."""
        return len(keys.facets or ()) / 9.0
