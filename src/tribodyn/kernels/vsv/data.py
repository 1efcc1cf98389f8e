"""What the kernels of the variable stator vane mechanism read and change."""

from __future__ import annotations

from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.report import N_REPORT
from tribodyn.kernels.vsv.books import Books
from tribodyn.kernels.vsv.layout import N_BODY, N_COLUMNS, N_IDEAL, N_RATES, N_ROWS, N_UNKNOWNS, N_WORKS

Mechanism: TypeAlias = Any
"""Constants of the mechanism, of the type :data:`MECHANISM`."""

MECHANISM: Final = np.dtype(
    [
        ("exact", "f8"),
        *((name, "f8") for name in ("l_1", "l_2", "l_3", "l_4", "pivot_x", "pivot_z")),
        *((name, "f8") for name in ("ring_angle", "ring_sin", "ring_cos", "half_length", "vane_arm")),
        *((name, "f8") for name in ("m_1", "m_2", "m_3", "m_v", "vane_weight")),
        *((name, "f8") for name in ("crank_inertia", "link_inertia", "ring_inertia")),
        ("inertia", "f8", (N_ROWS,)),
        ("weight", "f8", (N_ROWS,)),
        *((name, "f8") for name in ("start_angle", "speed_amplitude", "angular_frequency")),
        *((name, "f8") for name in ("air_force_x", "air_force_y", "air_moment")),
        *((name, "f8") for name in ("switch_angle", "switch_width")),
        *((name, "f8") for name in ("collar_radius", "collar_friction")),
        *((name, "f8") for name in ("ideal_first", "ideal_inverse_step")),
        ("ideal", "f8", (N_IDEAL + 1, 2)),
    ],
    align=True,
)
"""Constants of the mechanism, SI units, symbols of the paper.

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
vane_weight
    G_v = m_v g [N].
crank_inertia, link_inertia, ring_inertia
    About the mass centres [kg m²].
inertia
    Mass or moment of inertia of each row of the motion table, shape (N_ROWS,) [kg, kg m²].
weight
    Gravity load of each row, shape (N_ROWS,) [N].
start_angle, speed_amplitude, angular_frequency
    Drive: ω_a = Ω sin ν t from θ_a0 [rad, rad/s, rad/s].
air_force_x, air_force_y, air_moment
    Loads of Table 3 [N, N, N m].
switch_angle, switch_width
    Vane angle where F_airx changes sign and width of the change [rad].
collar_radius, collar_friction
    r_t and μ_f r_t [m].
ideal_first, ideal_inverse_step, ideal
    Table of the vane angle of the ideal mechanism over the crank angle: first angle [rad],
    nodes per radian, and (θ_v, step dθ_v/dθ_a) at the nodes, shape (N_IDEAL + 1, 2) [rad].
"""


def new_mechanism(**constants: float | FloatArray) -> Mechanism:
    """Return the constants as kernels read them, every one of :data:`MECHANISM` by its name."""
    mechanism = new_record(MECHANISM)
    for name in MECHANISM.names or ():
        mechanism[name] = constants.pop(name)
    assert not constants, f"unknown: {', '.join(constants)}"
    return mechanism


class VsvData(NamedTuple):
    """What the kernels of the mechanism read.

    Attributes
    ----------
    mechanism
        Its constants.
    joint
        The bushing.
    """

    mechanism: Mechanism
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
"""


def new_scratch() -> Scratch:
    """Return cleared work arrays."""
    return new_record(SCRATCH)


class VsvMemory(NamedTuple):
    """What accepted steps change.

    Attributes
    ----------
    entry_velocity
        δ̇₋ at the nodes [m/s], shape (n_z + 2, n_theta); 0 where there is no contact.
    sliding_load
        ∫P_c |u| dt [N/m], same shape (Eq. 47 and the text below it).
    regime
        Direction of the ideal vane motion, ±1, and the vane speed that traction is told instead of
        the actual one (0: none), shape (2,).
    books
        What the energy ledgers have added up.
    scratch
        Work arrays.
    """

    entry_velocity: FloatArray
    sliding_load: FloatArray
    regime: FloatArray
    books: Books
    scratch: Scratch
