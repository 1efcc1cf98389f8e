"""Effect of motions of the bodies on the shafts of many couplings at once.

Sums run in the order of :func:`tribodyn.kernels.dense.product`, coupling by coupling: the same bits on every
processor, whatever is taken together.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, IntArray
from tribodyn.kernels import dense
from tribodyn.kernels.joints.surface.data import GAP, NORMAL, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.tilt import LINE, NO_TILT

_ROOM: Final = 2**16  #: Entries of the stiffness of couplings that are taken together.


def products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the matrix products of stacks (..., r, s) and (..., s, c), shape (..., r, c)."""
    found = first[..., :, :1] * second[..., :1, :]
    for k in range(1, first.shape[-1]):
        found += first[..., :, k : k + 1] * second[..., k : k + 1, :]
    return found


def applied(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Return the product of a matrix (..., n) and a vector (n,), if small without a call of a kernel."""
    if matrix.size > _ROOM // 8:
        whole = matrix.flags.c_contiguous
        return np.asarray(dense.product(matrix, vector) if whole else dense.product(vector, matrix.T))
    sums = (matrix * vector).cumsum(axis=-1)  # in order, with the bits of the kernel
    return np.asarray(sums[..., -1] + 0.0 if vector.size else matrix.sum(axis=-1))


def length(vector: FloatArray) -> float:
    """Return the root of the sum of squares of a vector (n,)."""
    return math.sqrt(applied(vector, vector))


def ways(arms: FloatArray, bodies: FloatArray) -> FloatArray:
    """Return the effect of motions of socket and shaft (2, k, 6, m) on the shafts of k couplings, (k, 6, m).

    ``arms`` are those of the couplings, shape (k, 6, 12).
    """
    return products(arms[..., :6], bodies[0]) + products(arms[..., 6:], bodies[1])


def of_bodies(motions: FloatArray, ends: IntArray) -> FloatArray:
    """Return motions (6 n, m) of sockets and shafts, shape (2, k, 6, m); the ground, body n, has none.

    ``ends`` are the numbers of these bodies, shape (2, k).
    """
    bodies = motions.reshape(len(motions) // 6, 6, motions.shape[1])
    return np.concatenate([bodies, np.zeros_like(bodies[:1])])[ends]


def forces(pushes: FloatArray, ends: IntArray, n: int) -> FloatArray:
    """Return forces and moments on n bodies, shape (6 n,), from those on sockets and shafts (k, 12)."""
    places = 6 * ends.T[:, :, None] + np.arange(6)
    found = np.zeros(6 * (n + 1))
    np.add.at(found, places.ravel(), pushes.ravel())
    return found[: 6 * n]


class ShaftMotions:
    """Motions of bodies, each of which moves few of them, as the couplings between these take part in them.

    ``motions`` are columns over displacements and rotations of all bodies, shape (6 n, m), ``ends`` the
    numbers of socket and shaft of some couplings, shape (2, k).
    """

    def __init__(self, motions: FloatArray, ends: IntArray) -> None:
        self._m = motions.shape[1]
        moved = np.any(motions.reshape(len(motions) // 6, 6, self._m) != 0.0, axis=1)
        moved = np.concatenate([moved, np.zeros_like(moved[:1])])
        takes_part = moved[ends[0]] | moved[ends[1]]
        # What is left of a row is filled with a motion of nothing.
        spread = np.concatenate([motions, np.zeros_like(motions[:, :1])], axis=1)
        self._runs = []
        for run in _runs(np.count_nonzero(takes_part, axis=1)):
            width = int(np.max(np.count_nonzero(takes_part[run], axis=1), initial=0))
            columns = np.argsort(~takes_part[run], axis=1, kind="stable")[:, :width]
            columns[~np.take_along_axis(takes_part[run], columns, axis=1)] = self._m
            bodies = np.concatenate([spread, np.zeros_like(spread[:6])]).reshape(-1, 6, self._m + 1)
            own = bodies[ends[:, run, None], :, columns].swapaxes(-1, -2)
            self._runs.append((run, columns, np.ascontiguousarray(own)))

    def stiffness(
        self, arms: FloatArray, slopes: FloatArray, roots: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the sums of Wᵀ S W and of (R W)ᵀ R W over all couplings, shape (m, m) each.

        W is the motion of the shaft of a coupling; S and R have shape (k, 6, 6), ``arms`` (k, 6, 12).
        """
        size = (self._m + 1) ** 2
        sums = np.zeros((2, size))
        for run, columns, own in self._runs:
            way = ways(arms[run], own)
            across = way.swapaxes(-1, -2)
            lifted = products(roots[run], way)
            places = ((self._m + 1) * columns[:, :, None] + columns[:, None, :]).ravel()
            for found, entries in zip(
                sums,
                (products(products(across, slopes[run]), way), products(lifted.swapaxes(-1, -2), lifted)),
                strict=True,
            ):
                np.add.at(found, places, entries.ravel())
        first, second = sums.reshape(2, self._m + 1, self._m + 1)[:, :-1, :-1]
        return first, second


def _runs(widths: NDArray[np.intp]) -> Iterator[slice]:
    """Yield runs of couplings whose stiffness, that many columns wide, fits the room, or of one coupling."""
    first = widest = 0
    for k, width in enumerate(widths.tolist()):
        if k > first and (k + 1 - first) * max(widest, width) ** 2 > _ROOM:
            yield slice(first, k)
            first, widest = k, 0
        widest = max(widest, width)
    if first < widths.size:
        yield slice(first, widths.size)


_TINY: Final = 1.0e-300


@dataclass(frozen=True)
class JointNodes:
    """Nodes of a joint with clearance."""

    coupling: int  #: Number of the joint.
    gradient: FloatArray  #: −∂h/∂(d, φ), shape (n, 6).
    position: FloatArray  #: x_k [m], shape (n, 3).
    #: Gaps as drawn, and σ [m], shape (n,).
    drawn: FloatArray
    roughness: FloatArray
    slides: FloatArray  #: 1 where the shaft slides past the node, shape (n,).
    deepest: FloatArray  #: Gap at which the contact law ends [m], shape (n,).
    lean: FloatArray  #: Radius ρ of the second-order term of the tilt [m], shape (n,).
    slip: float  #: u_s [m/s].

    @cached_property
    def root(self) -> FloatArray:
        """Square root of the stiffness of springs under all nodes, 1 N/m altogether, shape (6, 6)."""
        values, vectors = dense.eigh(dense.product(self.gradient.T, self.gradient) / self.drawn.size)
        return np.asarray(np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T)

    def gaps(self, place: FloatArray) -> FloatArray:
        """Return the gaps [m] at displacement and tilt (d, φ), shape (6,)."""
        axis = applied(self.gradient[:, :3], np.array([place[4], -place[3], 1.0]))
        squares = 0.5 * self.lean * (axis - self.gradient[:, 2]) ** 2
        return np.asarray(
            self.drawn - applied(self.gradient, place) + self.slides * place[2] * axis - squares
        )


def nodes_of(joints: SurfaceData, couplings: IntArray) -> list[JointNodes]:
    """Return the nodes of all joints with clearance."""
    found = []
    for j, coupling in enumerate(couplings):
        surfaces = joints.surfaces[joints.joints[j] : joints.joints[j + 1]]
        counts = surfaces["last_node"] - surfaces["first_node"]
        nodes = joints.nodes[:, surfaces["first_node"][0] : surfaces["last_node"][-1]].T
        position, normal = nodes[:, POSITION:NORMAL], nodes[:, NORMAL : NORMAL + 3]
        kinds = np.repeat(surfaces["tilt"], counts)[:, None]
        turning = np.where(kinds == LINE, [0.0, 0.0, 1.0], kinds != NO_TILT) * np.cross(position, normal)
        found.append(
            JointNodes(
                coupling=int(coupling),
                gradient=np.hstack([normal, turning]),
                position=position,
                drawn=nodes[:, GAP],
                roughness=np.repeat(surfaces["roughness"], counts),
                slides=np.repeat(surfaces["slides"], counts),
                deepest=np.repeat(surfaces["deepest"], counts),
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
