"""Pose of a joint's shaft in its socket and its rates, right-handed and in the paper's signs.

Wrenches are (F_x, F_y, F_z, M_x, M_y, M_z) on the shaft, moments about its origin; their derivatives are
taken with respect to displacement, tilt, velocity and rates of turning, three of each.

The paper's states are (e_x, e_y, φ_x, φ_y) and their rates, its wrench is (F_x, F_y, M_x, M_y, M_z); φ_y and
M_y are left-handed, all else is right-handed.
"""

from typing import Annotated, Final

from mebdf.arrays import FloatArray, FloatMatrix
from tribodyn.core.quantities import Quantity, Record, of_table
from tribodyn.kernels.jit import entry
from tribodyn.kernels.joints.quantities import Report

POSE: Final = (
    Quantity("d_x", "m", "displacement of the shaft's origin along X"),
    Quantity("d_y", "m", "displacement of the shaft's origin along Y"),
    Quantity("d_z", "m", "displacement of the shaft's origin along Z"),
    Quantity("phi_x", "rad", "tilt about X: the shaft's axis leans by −tan φ_x along Y"),
    Quantity("phi_y", "rad", "tilt about Y: the shaft's axis leans by tan φ_y along X"),
    Quantity("v_x", "m s-1", "velocity of the shaft's origin along X"),
    Quantity("v_y", "m s-1", "velocity of the shaft's origin along Y"),
    Quantity("v_z", "m s-1", "velocity of the shaft's origin along Z"),
    Quantity("w_x", "rad s-1", "rate of the tilt about X"),
    Quantity("w_y", "rad s-1", "rate of the tilt about Y"),
    Quantity("w_z", "rad s-1", "angular velocity about Z"),
    Quantity("direction", "1", "direction of rotation that a friction moment opposes: 1, -1, or 0 at rest"),
    Quantity("opening", "m", "what the clearance of a bushing has more than that of its data"),
    Quantity("v_opening", "m s-1", "its rate"),
)
Pose: Final = of_table(POSE)

F_X: Final = 0
F_Y: Final = 1
F_Z: Final = 2
M_X: Final = 3
M_Y: Final = 4
M_Z: Final = 5
N_WRENCH: Final = 6  #: Entries of a wrench, rows of its derivative.

D: Final = 0
PHI: Final = 3
V: Final = 6
W: Final = 9
N_MOTION: Final = 12  #: First columns of displacement, tilt, velocity and rates of turning in the derivative.


@entry
def fill_pose(y: FloatArray, omega: float, direction: float, pose: Annotated[Record, Pose]) -> None:
    """Fill ``pose`` from the states ``y`` (8,), the speed ω about Z [rad/s] and its direction."""
    pose.d_x, pose.d_y, pose.d_z = y[0], y[1], 0.0
    pose.phi_x, pose.phi_y = y[2], -y[3]
    pose.v_x, pose.v_y, pose.v_z = y[4], y[5], 0.0
    pose.w_x, pose.w_y, pose.w_z = y[6], -y[7], omega
    pose.direction = direction


@entry
def from_wrench(wrench: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` (5,) with the paper's wrench from the joint's ``wrench`` (6,)."""
    out[0], out[1] = wrench[F_X], wrench[F_Y]
    out[2], out[3], out[4] = wrench[M_X], -wrench[M_Y], wrench[M_Z]


@entry
def from_jacobian(jacobian: FloatMatrix, out: FloatMatrix) -> None:
    """Fill ``out`` (5, 9), derivatives in the eight states and ω, from the joint's ``jacobian`` (6, 12)."""
    rows = (F_X, F_Y, M_X, M_Y, M_Z)
    columns = (D, D + 1, PHI, PHI + 1, V, V + 1, W, W + 1, W + 2)
    for k in range(5):
        for m in range(9):
            turned = (k == 3) != (m == 3 or m == 7)
            entry = jacobian[rows[k], columns[m]]
            out[k, m] = -entry if turned else entry


@entry
def from_report(report: Annotated[Record, Report]) -> None:
    """Turn the moments about Y of a joint's report, right-handed as the joint left it, into the paper's."""
    report.M_jcy = -report.M_jcy
    report.M_fy = -report.M_fy
    report.M_ky = -report.M_ky
