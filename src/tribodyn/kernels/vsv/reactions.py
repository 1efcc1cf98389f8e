"""Reactions from the balance of each body, Eqs. 20-39: the vane first, then ring, drag link and crank.

The accelerations are known. What is left of each equation is one unknown, but for the force between ring and
drag link in the plane of the ring: two equations.
"""

from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.data import AIR_X, AIR_Y
from tribodyn.kernels.vsv.equations import lever_lift
from tribodyn.kernels.vsv.motion import ring_centre


@inlined
def _acceleration(scratch: Record, row: int) -> float:
    """Return the acceleration of a row of the motion table."""
    motion, q = scratch.motion, scratch.acceleration
    total: float = motion[row, at.BIAS]
    for j in range(4):
        total += motion[row, 1 + j] * q[j]
    return total


@kernel
def _needed(mechanism: Record, scratch: Record, row: int) -> float:
    """Return the force or moment of a row that its acceleration takes beside its weight."""
    return float(mechanism.inertia[row] * _acceleration(scratch, row) - mechanism.weight[row])


@inlined
def _fill_vane(mechanism: Record, scratch: Record, out: Record) -> None:
    """Equations 38 and 39, and the condition of the frictionless pin."""
    out.F_cz = scratch.f_cz
    out.F_43x = scratch.wrench[0] + scratch.air[AIR_X] - _needed(mechanism, scratch, at.OV_X)
    out.F_43y = scratch.wrench[1] + scratch.air[AIR_Y] - _needed(mechanism, scratch, at.OV_Y)
    out.F_43z = lever_lift(mechanism.exact, scratch.motion) * out.F_43x


@inlined
def _fill_ring(mechanism: Record, scratch: Record, out: Record) -> None:
    """Equations 32 to 37 with F_43z and that of the drag link about Y; arms from the mass centre O_3.

    The moments of ring and drag link about Y hold F_32x and F_32z.
    """
    motion = scratch.motion
    s2_x, s2_z = motion[at.S2_X, at.VALUE], motion[at.S2_Z, at.VALUE]
    s3_x, s3_z = motion[at.S3_X, at.VALUE], motion[at.S3_Z, at.VALUE]
    n_x, n_z = motion[at.N_X, at.VALUE], motion[at.N_Z, at.VALUE]
    o3_x, o3_z = ring_centre(mechanism, s2_x, s2_z)
    across_x, across_z = _needed(mechanism, scratch, at.O3_X), _needed(mechanism, scratch, at.O3_Z)
    about_axis = _needed(mechanism, scratch, at.THETA_B) + o3_x * across_z - o3_z * across_x
    of_ring = about_axis + s3_z * out.F_43x - s3_x * out.F_43z
    turning = n_z * _acceleration(scratch, at.N_X) - n_x * _acceleration(scratch, at.N_Z)
    link_x, link_z = _needed(mechanism, scratch, at.O2_X), _needed(mechanism, scratch, at.O2_Z)
    of_link = mechanism.link_inertia / mechanism.l_2 * turning + 0.5 * (n_z * link_x - n_x * link_z)
    inverse = 1.0 / (s2_x * n_z - s2_z * n_x)
    out.F_32x = (s2_x * of_link - n_x * of_ring) * inverse
    out.F_32y = out.F_43y - _needed(mechanism, scratch, at.O3_Y)
    out.F_32z = (s2_z * of_link - n_z * of_ring) * inverse
    out.F_bx = across_x - out.F_43x + out.F_32x
    out.F_bz = across_z - out.F_43z + out.F_32z
    out.M_bx = (s3_z - o3_z) * out.F_43y - (s2_z - o3_z) * out.F_32y
    out.M_bz = (s2_x - o3_x) * out.F_32y - (s3_x - o3_x) * out.F_43y


@inlined
def _fill_crank(mechanism: Record, scratch: Record, out: Record) -> None:
    """Equations 20 to 25 and the forces on the drag link, 26 to 28; arms from the mass centre O_1."""
    motion = scratch.motion
    out.F_21x = out.F_32x - _needed(mechanism, scratch, at.O2_X)
    out.F_21y = out.F_32y - _needed(mechanism, scratch, at.O2_Y)
    out.F_21z = out.F_32z - _needed(mechanism, scratch, at.O2_Z)
    out.F_ax = _needed(mechanism, scratch, at.O1_X) - out.F_21x
    out.F_ay = -out.F_21y
    out.F_az = _needed(mechanism, scratch, at.O1_Z) - out.F_21z
    x, z = (
        0.5 * (motion[at.S1_X, at.VALUE] - mechanism.pivot_x),
        0.5 * (motion[at.S1_Z, at.VALUE] - mechanism.pivot_z),
    )
    out.M_ax = z * (out.F_21y - out.F_ay)
    out.M_az = x * (out.F_ay - out.F_21y)
    moment = x * (out.F_21z - out.F_az) - z * (out.F_21x - out.F_ax)
    out.M_d = _needed(mechanism, scratch, at.THETA_A) - moment


@kernel
def fill_reactions(mechanism: Record, scratch: Record, out: Record) -> None:
    """Fill the reactions from motion table, joint wrench, loads and accelerations of this instant."""
    _fill_vane(mechanism, scratch, out)
    _fill_ring(mechanism, scratch, out)
    _fill_crank(mechanism, scratch, out)
