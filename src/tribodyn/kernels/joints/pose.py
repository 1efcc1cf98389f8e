"""Pose of a joint's shaft in its socket and its rates, right-handed, in the socket's frame.

Wrenches are (F_x, F_y, F_z, M_x, M_y, M_z) on the shaft, moments about its origin; their derivatives are
taken with respect to displacement, tilt, velocity and rates of turning, three of each.
"""

from typing import Final

from tribodyn.core.quantities import Quantity, of_table

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
