"""What the kernels of the film read, and what they change."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray

IntArray = NDArray[np.int64]
FlagArray = NDArray[np.int8]

CONVERGED: Final = 0
NO_CONVERGENCE: Final = 1
"""The set of cavitated nodes did not settle."""
OUT_OF_RANGE: Final = 2
"""Somewhere h < −4σ (or h ≤ 0 without roughness), or the state is not a number."""
NOT_STEADY: Final = 3
"""``jfo`` was asked for a moving journal centre, or for one that does not turn."""
NO_MEAN_GAP: Final = 4
"""``jfo`` needs a positive mean gap everywhere."""

REYNOLDS: Final = 0
HALF_SOMMERFELD: Final = 1
NO_CAVITATION: Final = 2
JFO: Final = 3


class FlowTable(NamedTuple):
    """Flow, shear and contact factors of a pair of rough surfaces, as piecewise cubics.

    A cubic of one interval is c_0 + c_1 x + c_2 x² + c_3 x³ with x from 0 to 1 across it.

    Attributes
    ----------
    inverse_step
        Intervals per unit of 1/H, H = h/σ, of the factors.
    factors
        φ_θ, φ_z, φ_s, φ_f, φ_fp over 1/H from 0 to 2, shape (intervals, 5, 4).
    gap_first, gap_step
        First h/σ and interval of ``mean_gap``.
    mean_gap
        Mean gap h_T/σ, whose slope is the contact factor φ_c, shape (intervals, 4); equal to h/σ above.
    """

    inverse_step: float
    factors: FloatArray
    gap_first: float
    gap_step: float
    mean_gap: FloatArray


class FilmData(NamedTuple):
    """Constants of a film, SI units.

    Nodes are uniform in θ and z; those at both ends (z = ∓length/2) carry p = 0. ``theta`` fields live on
    faces half a step after a node in θ, ``z`` fields half a step after it in z.

    Attributes
    ----------
    viscosity
        η [Pa s].
    clearance, radius, length
        c, r_j, l_z [m].
    roughness
        Combined rms roughness σ [m]; 0 for smooth surfaces, which have no factors.
    cavitation
        ``REYNOLDS``, ``HALF_SOMMERFELD``, ``NO_CAVITATION`` or ``JFO``.
    groove
        1 for p = 0 on the line of maximum gap, to which the grid then turns; 0 for a periodic film.
    uniform
        1 if the wear does not depend on z.
    mirror
        1 if the wear is the same at z and −z.
    cos_node, sin_node, cos_face, sin_face
        Cosine and sine of θ at nodes and faces, shape (n_theta,).
    z_node, z_face
        Axial positions [m], shapes (n_z + 1,) and (n_z,).
    wear_node, wear_theta, wear_z
        Wear depth at nodes and faces [m], shapes (n_theta, n_z + 1) twice and (n_theta, n_z).
    table
        Factors of the rough surfaces.
    """

    viscosity: float
    clearance: float
    radius: float
    length: float
    roughness: float
    cavitation: int
    groove: int
    uniform: int
    mirror: int
    cos_node: FloatArray
    sin_node: FloatArray
    cos_face: FloatArray
    sin_face: FloatArray
    z_node: FloatArray
    z_face: FloatArray
    wear_node: FloatArray
    wear_theta: FloatArray
    wear_z: FloatArray
    table: FlowTable


class FilmMemory(NamedTuple):
    """Cavitation of the last evaluation, as a first guess, and scratch.

    Fields have one row a column of nodes (fixed θ) and leave the ends out: shape (n_theta, n_z − 1) unless said.

    Attributes
    ----------
    active
        1 where the film is full, 0 where it cavitates.
    pressure
        p/(6 η r²/c²) [1/s].
    fill
        Fraction of the gap that holds oil.
    """

    active: FlagArray
    pressure: FloatArray
    fill: FloatArray
    scratch: Any
