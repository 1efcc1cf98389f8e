"""A worn profile on another grid.

Wear is known at the nodes of the bushing and nowhere else; kernels never ask in between. Only a check on a
finer grid does. The interpolant is monotone between nodes, so that it makes no depth where there is none
and no overshoot beside a worn edge.
"""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray


def resampled(depth: FloatArray, z: FloatArray, fine_z: FloatArray, n_theta: int) -> FloatArray:
    """Return a wear depth at the nodes of another grid.

    Parameters
    ----------
    depth
        Depth [m] at rows ``z`` and at uniform angles, shape (n_z + 2, n).
    z, fine_z
        Axial positions of the rows [m]; both from edge to edge.
    n_theta
        Number of uniform angles wanted.

    Returns
    -------
    numpy.ndarray
        Depth [m], shape (fine_z.size, n_theta).
    """
    from scipy.interpolate import PchipInterpolator

    along = PchipInterpolator(z, depth, axis=0)(fine_z)
    n = depth.shape[1]
    # Three more angles on either side: the slope at a node is made from its neighbours.
    around = np.arange(-3, n + 4)
    wanted = np.arange(n_theta) * (n / n_theta)
    return np.asarray(PchipInterpolator(around, along[:, around % n], axis=1)(wanted))
