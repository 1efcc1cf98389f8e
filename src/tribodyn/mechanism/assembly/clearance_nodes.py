"""Nodes of the joints with clearance: the gaps at any displacement and tilt of their shafts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.kernels import dense
from tribodyn.kernels.joints.surface.data import GAP, NORMAL, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.tilt import NO_TILT

_TINY: Final = 1.0e-300


@dataclass(frozen=True)
class JointNodes:
    """Nodes of a joint with clearance.

    Attributes
    ----------
    coupling
        Number of the joint.
    gradient
        −∂h/∂(d, φ), shape (n, 6).
    position
        x_k [m], shape (n, 3).
    drawn, roughness
        Gaps as drawn, and σ [m], shape (n,).
    slides
        1 where the shaft slides past the node, shape (n,).
    deepest
        Gap at which the contact law ends [m], shape (n,).
    lean
        Radius ρ of the second-order term of the tilt [m], shape (n,).
    slip
        u_s [m/s].
    """

    coupling: int
    gradient: FloatArray
    position: FloatArray
    drawn: FloatArray
    roughness: FloatArray
    slides: FloatArray
    deepest: FloatArray
    lean: FloatArray
    slip: float

    @cached_property
    def root(self) -> FloatArray:
        """Square root of the stiffness of springs under all nodes, 1 N/m altogether, shape (6, 6)."""
        values, vectors = dense.eigh(dense.product(self.gradient.T, self.gradient) / self.drawn.size)
        return np.asarray(np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T)

    def gaps(self, place: FloatArray) -> FloatArray:
        """Return the gaps [m] at displacement and tilt (d, φ), shape (6,)."""
        axis = dense.product(self.gradient[:, :3], np.array([place[4], -place[3], 1.0]))
        squares = 0.5 * self.lean * (axis - self.gradient[:, 2]) ** 2
        return np.asarray(
            self.drawn - dense.product(self.gradient, place) + self.slides * place[2] * axis - squares
        )


def nodes_of(joints: SurfaceData, couplings: IntArray) -> list[JointNodes]:
    """Return the nodes of all joints with clearance."""
    found = []
    for j, coupling in enumerate(couplings):
        surfaces = joints.surfaces[joints.joints[j] : joints.joints[j + 1]]
        counts = surfaces["last_node"] - surfaces["first_node"]
        nodes = joints.nodes[:, surfaces["first_node"][0] : surfaces["last_node"][-1]].T
        position, normal = nodes[:, POSITION:NORMAL], nodes[:, NORMAL : NORMAL + 3]
        turning = np.cross(position, normal) * np.repeat(surfaces["tilt"] != NO_TILT, counts)[:, None]
        found.append(
            JointNodes(
                coupling=int(coupling),
                gradient=np.hstack([normal, turning]),
                position=position,
                drawn=nodes[:, GAP],
                roughness=np.repeat(surfaces["roughness"], counts),
                slides=np.repeat(surfaces["slides"], counts),
                deepest=np.repeat(surfaces["h_first"] * surfaces["roughness"], counts),
                lean=np.repeat(surfaces["lean"], counts),
                slip=float(max(surfaces["slip_velocity"].max(), _TINY)),
            )
        )
    return found


def alike(contacts: Sequence[JointNodes]) -> list[list[int]]:
    """Return the numbers of joints in groups whose nodes have the same places, normals and roughness."""
    groups: dict[tuple[bytes, bytes], list[int]] = {}
    for number, contact in enumerate(contacts):
        groups.setdefault((contact.gradient.tobytes(), contact.roughness.tobytes()), []).append(number)
    return list(groups.values())
