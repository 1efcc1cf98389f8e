"""Pose of a joint's shaft in its socket and its rates: in the frame of the socket, right-handed.

Wrenches are (F_x, F_y, F_z, M_x, M_y, M_z) on the shaft, moments about its origin P. Their derivatives are
taken with respect to displacement, a small rotation of the shaft, velocity and angular velocity, three of
each. On the socket the same forces act backwards: −F, and −(M + d × F) about the socket's origin O.
"""

from typing import Final

from tribodyn.core.quantities import record_type

Pose: Final = record_type(
    ("d", "f8", (3,)),
    ("rotation", "f8", (3, 3)),
    ("v", "f8", (3,)),
    ("w", "f8", (3,)),
    ("opening", "f8", (2,)),
    ("v_opening", "f8", (2,)),
)
"""
d
    From O to P [m].
rotation
    Turns components in the shaft's frame into those in the socket's; the identity as drawn. Its last column
    is the axis of the shaft.
v
    Velocity of P relative to the socket [m/s].
w
    Angular velocity of the shaft relative to the socket [rad/s].
opening, v_opening
    What temperatures have added to the radial clearance and to the play along the axis [m], and the rates.
"""

#: First column of the small rotation in the derivative; for the others see ``joints/pose.py``.
TURN: Final = 3
