"""Growth of the errors of outputs with the wear of joints, and life to their limits: a linear estimate.

A shaft follows the wear of its bore. It is displaced by δ and rotated by φ such that the gaps under the
pressure stay as they were. With depth w, normal n (from the shaft into the bore), position x and pressure
times area p A of the nodes, the forces stay the same where

    Σ p A n' (n'·(δ, φ) − w) = 0,    n' = (n, x × n),

the contact being stiff in proportion to its pressure. Directions in which it is not are left out. Where the
contact is narrow, as in an impact, it hardly holds the shaft across the force. A shaft is displaced by no
more than the largest depth, because it stays where the bore is worn most.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense

_SOFT: Final = 1.0e-6
"""Stiffness of a direction over the largest one that counts as zero."""
_N_WAYS: Final = 6
"""Translations and rotations of a shaft."""


def shaft_displacements(
    position: FloatArray, normal: FloatArray, weight: FloatArray, depth: FloatArray
) -> FloatArray:
    """Return displacement [m] and rotation [rad] of a shaft that follows the wear, shape (n_t, 6).

    Parameters
    ----------
    position, normal
        Of the nodes on the shaft [m], and into the bore, shape (n, 3).
    weight
        Pressure times area over time [N], shape (n_t, n).
    depth
        Worn off at the nodes [m], shape (n,).
    """
    size = float(np.max(np.linalg.norm(position, axis=1), initial=np.finfo(float).tiny))
    lever = np.concatenate([normal, np.cross(position / size, normal)], axis=1)
    row, column = np.triu_indices(_N_WAYS)
    of_nodes = np.concatenate([lever[:, row] * lever[:, column], lever * depth[:, None]], axis=1)
    sums = dense.product(weight, of_nodes)
    stiffness, force = np.empty((len(sums), _N_WAYS, _N_WAYS)), sums[:, row.size :]
    stiffness[:, row, column] = stiffness[:, column, row] = sums[:, : row.size]
    moved = np.linalg.pinv(stiffness, rcond=_SOFT, hermitian=True) @ force[..., None]
    most = float(depth.max(initial=0.0))
    way = np.linalg.norm(moved[:, :3, 0], axis=1)
    moved[way > most] *= (most / way[way > most])[:, None, None]
    return np.asarray(moved[..., 0] / np.repeat([1.0, size], 3))


def lives(error: FloatArray, growth: FloatArray, limits: FloatArray) -> FloatArray:
    """Return after how many cycles errors reach their limits, shape (n_outputs,); NaN for never.

    Parameters
    ----------
    error
        Over time in the units of the outputs, shape (n_t, n_outputs).
    growth
        Of the error in one cycle, in the same shape; NaN where it is not known.
    limits
        Shape (n_outputs,); NaN for none.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        cycles = (limits - error * np.sign(growth)) / np.abs(growth)
    cycles = np.where(np.isfinite(cycles), np.maximum(cycles, 0.0), np.inf)
    first = np.min(cycles, axis=0, initial=np.inf)
    return np.asarray(np.where(np.isfinite(first), first, np.nan))
