"""Rows and columns of the motion table.

Each row is a coordinate of a body or of a point. Its columns hold the partial derivatives with
respect to the crank angle and the four clearance coordinates, the velocity, the acceleration that
remains when the clearance accelerations vanish, and the value. With a mass and a force for each
row, the equations of motion are sums over rows.
"""

from typing import Final

THETA_A: Final = 0
THETA_B: Final = 1
THETA_V: Final = 2
O1_X: Final = 3
O1_Z: Final = 4
O2_X: Final = 5
O2_Y: Final = 6
O2_Z: Final = 7
N_X: Final = 8
N_Y: Final = 9
N_Z: Final = 10
O3_X: Final = 11
O3_Y: Final = 12
O3_Z: Final = 13
OV_X: Final = 14
OV_Y: Final = 15
E_X: Final = 16
E_Y: Final = 17
PHI_X: Final = 18
PHI_Y: Final = 19
S1_X: Final = 20
S1_Z: Final = 21
S2_X: Final = 22
S2_Y: Final = 23
S2_Z: Final = 24
S3_X: Final = 25
S3_Y: Final = 26
S3_Z: Final = 27
N_ROWS: Final = 28
N_BODY: Final = 20  #: Rows of bodies, with an inertia or a force; the others are points that connect them.

D_CRANK: Final = 0  #: Column of ∂/∂θ_a; columns 1 to 4 are ∂/∂(e_x, e_y, φ_x, φ_y).
VELOCITY: Final = 5
BIAS: Final = 6
VALUE: Final = 7
N_COLUMNS: Final = 8

N_IDEAL: Final = 512  #: Intervals of the table of the ideal mechanism.

N_COORDINATES: Final = 4  #: Clearance coordinates e_x, e_y, φ_x, φ_y.
