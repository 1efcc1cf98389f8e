"""What the kernels of the bushing joint read; it never changes."""

from __future__ import annotations

from typing import NamedTuple

from tribodyn.core.arrays import FloatArray
from tribodyn.core.tables import ContactTable


class BushingData(NamedTuple):
    """Constants of a bushing joint, SI units.

    The nodes are uniform in θ (trapezoidal rule, periodic) and Gauss-Legendre in z; the first
    and last row of nodes stand on the edges z = ∓length/2 with weight zero, because Gauss nodes
    miss the edge, where the pressure of a tilted trunnion is highest.

    Attributes
    ----------
    clearance
        Radial clearance c [m].
    journal_radius, bore_radius
        r_j and r_b = r_j + c [m].
    roughness
        Combined rms roughness σ of both surfaces [m].
    friction_coefficient
        μ_f [1].
    slip_velocity
        Regularisation velocity u_s of the traction [m/s].
    tangential
        1 for friction as traction on the surface, 0 for a friction moment only.
    onset
        Separation in units of σ below which a point is in contact [1].
    minimum_entry_velocity
        Lower bound v_min of the entry velocity [m/s].
    clip
        1 if the total pressure must not be tensile, 0 otherwise.
    table
        Tabulated contact law.
    point
        1 for contact at a point of each end, whose force [N] the table then holds, 0 over the surface.
    cos_theta, sin_theta
        Cosine and sine of the node angles, shape (n_theta,).
    z
        Axial positions of the rows of nodes [m], shape (n_z + 2,).
    area
        Area that a node of each row stands for [m²], shape (n_z + 2,); zero on the edges.
    wear
        Wear depth at the nodes [m], shape (n_z + 2, n_theta).
    """

    clearance: float
    journal_radius: float
    bore_radius: float
    roughness: float
    friction_coefficient: float
    slip_velocity: float
    tangential: float
    onset: float
    minimum_entry_velocity: float
    clip: float
    table: ContactTable
    point: float
    cos_theta: FloatArray
    sin_theta: FloatArray
    z: FloatArray
    area: FloatArray
    wear: FloatArray
