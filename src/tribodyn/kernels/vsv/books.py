"""The entries of the energy ledgers, and the record that holds them."""

from __future__ import annotations

from typing import Any, Final, TypeAlias

import numpy as np

from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.vsv.layout import N_RATES, N_WORKS

DRIVE, LOADS, FRICTION, COLLAR_FRICTION, COLLAR_TILT = 0, 1, 2, 3, 4
"""Whole mechanism: work of the drive and of the air loads, of friction, of the collar."""
DAMPING, OTHERS, JOINT_FRICTION, COLLAR = 0, 1, 2, 3
"""Clearance motion, counted from N_RATES on: damping heat, work of everything but the joint, of joint
friction, of the collar."""
INERTIA = N_RATES + N_WORKS
"""Clearance motion: what inertia has taken in."""
N_INTEGRALS = INERTIA + 1

TIME, EARLIER, SPEED = 0, 1, 2
"""Time of the last mark and of the one before that is kept [s], sliding speed |ω_v| r_j at the last [m/s]."""
N_MARK = 3

PEAK_FORCE, PEAK_FORCE_TIME, PEAK_PRESSURE, PEAK_PRESSURE_TIME = 0, 1, 2, 3
"""Largest contact force [N] and pressure [Pa] at any mark, and when [s]."""
LEAST_SEPARATION, LIFT_OFF = 4, 5
"""Smallest gap between mean planes [m]; time during which the collar carries nothing [s]."""
CLIPPED = 6
"""Time integral of the share of the contact area where the tensile clip acts [s]."""
N_EXTREMES = 7

Books: TypeAlias = Any
"""What the energy ledgers have added up, of the type :data:`BOOKS`."""

BOOKS: Final = np.dtype(
    [
        ("mark", "f8", (N_MARK,)),
        ("integrals", "f8", (N_INTEGRALS,)),
        ("rates", "f8", (2, N_RATES)),
        ("forces", "f8", (2, N_WORKS, 4)),
        ("extremes", "f8", (N_EXTREMES,)),
        ("last_state", "f8", (8,)),
        ("last_momentum", "f8", (4,)),
    ],
    align=True,
)
"""The entries named above, and what the ledgers need to go on.

mark
    When they were last added to.
integrals
    Path integrals [J].
rates, forces
    Their integrands at the last mark and at one before: powers [W], and forces on the clearance
    coordinates [N, N m].
extremes
    Peaks over all accepted steps.
last_state, last_momentum
    State at the last mark, and the clearance momentum N q̇ there [kg m/s, kg m²/s].
"""


def new_books(separation: float) -> Books:
    """Return ledgers that nothing has been added to; the smallest gap so far is ``separation`` [m]."""
    books = new_record(BOOKS)
    books.extremes[LEAST_SEPARATION] = separation
    return books
