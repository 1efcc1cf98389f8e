"""What the kernels of the variable stator vane mechanism read and change."""

from __future__ import annotations

from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.report import N_REPORT
from tribodyn.kernels.vsv.layout import N_BODY, N_COLUMNS, N_RATES, N_ROWS, N_UNKNOWNS, N_WORKS


class VsvData(NamedTuple):
    """Constants of the mechanism, SI units, symbols of the paper.

    Attributes
    ----------
    exact
        1 for the formulation ``exact``, 0 for ``paper``.
    l_1, l_2, l_3, l_4
        Crank, drag link, ring radius and lever arm [m].
    pivot_x, pivot_z
        Crank pivot A = (l_m cos γ, l_4, l_m sin γ) [m].
    ring_angle, ring_sin, ring_cos
        Angle φ between the two arms of the ring [rad], its sine and cosine.
    half_length
        l_z/2, height of the lever plane above the trunnion centre O_j [m].
    vane_arm
        Distance from O_j down to the vane centre: (l_v − l_z)/2, or l_v/2 in ``paper`` [m].
    m_1, m_2, m_3, m_v
        Masses [kg].
    ring_inertia, link_inertia, crank_inertia
        About the mass centres [kg m²].
    inertia
        Mass or moment of inertia of each row of the motion table, shape (N_ROWS,) [kg, kg m²].
    weight
        Gravity load of each row, shape (N_ROWS,) [N].
    vane_weight
        G_v = m_v g [N].
    start_angle, speed_amplitude, angular_frequency
        Drive: ω_a = Ω sin ν t from θ_a0 [rad, rad/s, rad/s].
    air_force_x, air_force_y, air_moment
        Loads of Table 3 [N, N, N m].
    switch_angle, switch_width
        Vane angle where F_airx changes sign and width of the change [rad].
    collar_radius
        r_t [m].
    ideal_first, ideal_inverse_step, ideal
        Table of the vane angle of the ideal mechanism over the crank angle: first angle [rad],
        nodes per radian, and (θ_v, step dθ_v/dθ_a) at the nodes, shape (n, 2) [rad].
    joint
        The bushing.
    """

    exact: float
    l_1: float
    l_2: float
    l_3: float
    l_4: float
    pivot_x: float
    pivot_z: float
    ring_angle: float
    ring_sin: float
    ring_cos: float
    half_length: float
    vane_arm: float
    m_1: float
    m_2: float
    m_3: float
    m_v: float
    crank_inertia: float
    link_inertia: float
    ring_inertia: float
    inertia: FloatArray
    weight: FloatArray
    vane_weight: float
    start_angle: float
    speed_amplitude: float
    angular_frequency: float
    air_force_x: float
    air_force_y: float
    air_moment: float
    switch_angle: float
    switch_width: float
    collar_radius: float
    ideal_first: float
    ideal_inverse_step: float
    ideal: FloatArray
    joint: BushingData


Scratch: TypeAlias = Any
"""Work arrays of one evaluation, of the type :data:`SCRATCH`."""

SCRATCH: Final = np.dtype(
    [
        ("motion", "f8", (N_ROWS, N_COLUMNS)),
        ("test", "f8", (N_BODY, 5)),
        ("force", "f8", (N_BODY,)),
        ("collar", "f8", (N_BODY,)),
        ("mass", "f8", (5, 4)),
        ("load", "f8", (5,)),
        ("solved", "f8", (4, 9)),
        ("acceleration", "f8", (4,)),
        ("wrench", "f8", (5,)),
        ("wrench_jacobian", "f8", (5, 9)),
        ("gradient", "f8", (3, 5)),
        ("report", "f8", (N_REPORT,)),
        ("rates", "f8", (N_RATES,)),
        ("forces", "f8", (N_WORKS, 4)),
        ("momentum", "f8", (4,)),
        ("state", "f8", (8,)),
        ("small", "f8", (4, 4)),
        ("system", "f8", (N_UNKNOWNS, N_UNKNOWNS)),
        ("reactions", "f8", (N_UNKNOWNS, 1)),
        ("ideal", "f8", (N_ROWS, N_COLUMNS)),
        ("f_cz", "f8"),
        ("marked", "f8"),
    ],
    align=True,
)
"""Work arrays of one evaluation; they carry nothing from one evaluation to the next.

``marked`` is 1 while the others hold what the ledger evaluated at its mark.

One record instead of a tuple of arrays: a compiled function takes one address instead of seven numbers for
each array, and need not count who holds them.
"""


def new_scratch() -> Scratch:
    """Return cleared work arrays."""
    return np.zeros(1, dtype=SCRATCH).view(np.recarray)[0]


class VsvMemory(NamedTuple):
    """What accepted steps change.

    Attributes
    ----------
    entry_velocity
        δ̇₋ at the nodes [m/s], shape (n_z + 2, n_theta); 0 where there is no contact.
    sliding_load
        ∫P_c |u| dt [N/m], same shape (Eq. 47 and the text below it).
    mark
        When the ledgers were last added to, see ``kernels/vsv/ledger.py``, shape (N_MARK,).
    regime
        Direction of the ideal vane motion, ±1, and the vane speed that traction is told instead of
        the actual one (0: none), shape (2,).
    integrals
        Path integrals of the energy ledgers [J], shape (N_INTEGRALS,).
    rates, forces
        Their integrands at the last mark and at one before: powers [W], shape (2, N_RATES), and forces on the
        clearance coordinates [N, N m], shape (2, N_WORKS, 4).
    extremes
        Peaks over all accepted steps, see ``kernels/vsv/ledger.py``, shape (N_EXTREMES,).
    last_state
        State at the last mark, shape (8,).
    last_momentum
        Clearance momentum N q̇ at the last mark, shape (4,) [kg m/s, kg m²/s].
    scratch
        Work arrays.
    """

    entry_velocity: FloatArray
    sliding_load: FloatArray
    mark: FloatArray
    regime: FloatArray
    integrals: FloatArray
    rates: FloatArray
    forces: FloatArray
    extremes: FloatArray
    last_state: FloatArray
    last_momentum: FloatArray
    scratch: Scratch
