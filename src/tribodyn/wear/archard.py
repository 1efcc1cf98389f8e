"""Archard's law of wear, Eq. 47, and worn profiles on another grid.

The depth worn off a point of the bushing is the specific wear rate times the sliding load of that point,
the time integral of P_c |u|. The paper prints C_w/H_d, which is no specific wear rate if C_w is one
already; its figures result when the rate is divided by the bare number 65.
"""

from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray


@dataclass(frozen=True)
class Archard:
    """Archard's law with a constant rate."""

    specific_rate: float | FloatArray  #: Specific wear rate C_w [m²/N], one or one for each node.
    hardness_divisor: float = 0.0  #: What the paper divides the rate by, a number without a unit; 0 is off.

    @property
    def rate(self) -> float | FloatArray:
        """Wear rate in force [m²/N]."""
        return self.specific_rate / (self.hardness_divisor or 1.0)

    def depth(self, sliding_load: FloatArray) -> FloatArray:
        """Return the depth worn off [m].

        Parameters
        ----------
        sliding_load
            ∫P_c |u| dt [N/m], any shape.
        """
        return np.asarray(self.rate * sliding_load)


def worn_volume(depth: FloatArray, node_area: FloatArray) -> float:
    """Return the volume worn off [m³] by the quadrature of the contact.

    Parameters
    ----------
    depth
        Depth at the nodes [m], any shape.
    node_area
        Area that each node stands for [m²], of the same shape; zero on edges.
    """
    return float(np.sum(node_area * depth))


def resampled(
    depth: FloatArray, z: FloatArray, fine_z: FloatArray, n_theta: int, *, turn: float = 0.0
) -> FloatArray:
    """Return a wear depth at the nodes of another grid.

    Parameters
    ----------
    depth
        Depth [m] at rows ``z`` and at uniform angles, shape (n_z + 2, n).
    z, fine_z
        Axial positions of the rows [m]; both from edge to edge.
    n_theta
        Number of uniform angles wanted.
    turn
        Angle of the first of them, over a full turn [1].

    Returns
    -------
    numpy.ndarray
        Depth [m], shape (fine_z.size, n_theta).
    """
    if not depth.any():
        return np.zeros((fine_z.size, n_theta))
    along = between_edges(depth, z, fine_z)
    n = depth.shape[1]
    # Three more angles on either side: the slope at a node is made from its neighbours.
    around = np.arange(-3, n + 4)
    wanted = np.mod(np.arange(n_theta) * (n / n_theta) + turn * n, n)
    return between_edges(along[:, around % n], around, wanted, axis=1)


def between_edges(depth: FloatArray, z: FloatArray, fine_z: FloatArray, axis: int = 0) -> FloatArray:
    """Return depths at other places along an axis of the array, without new peaks."""
    from scipy.interpolate import PchipInterpolator

    return np.asarray(PchipInterpolator(z, depth, axis=axis)(fine_z))
