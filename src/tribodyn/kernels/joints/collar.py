"""A thrust collar that rests on the rim of its bushing: a flat ring loaded along its axis.

Tilted, it rests on the side to which it leans, at the radius r_t; turning, it rubs there:

    M = N r_t (−φ_x/φ, −φ_y/φ, −s μ),    φ = √(φ_x² + φ_y² + φ_0²),

with the axial force N, which the mechanism knows, and the direction s of the rotation. The corner at φ = 0 is
rounded within φ_0. The collar cannot pull: a mechanism lets it go where N would be negative.
"""

import math
from typing import Final

from tribodyn.core.quantities import Quantity, Record, of_table
from tribodyn.kernels.jit import kernel

TILT_FLOOR: Final = 1.0e-6  #: φ_0 [rad].

CONSTANTS: Final = (
    Quantity("radius", "m", "radius r_t of the collar", ()),
    Quantity("friction", "m", "coefficient of friction times that radius", ()),
)
EXTREMES: Final = (Quantity("collar_lift_off_time", "s", "time during which the collar carries nothing", ()),)
Collar: Final = of_table(CONSTANTS)
Extremes: Final = of_table(EXTREMES)


@kernel
def moments(collar: Record, phi_x: float, phi_y: float, direction: float) -> tuple[float, float, float]:
    """Return M_x, M_y and M_z per unit of axial force [m] at a tilt [rad].

    About X and Y the collar answers a tilt with the opposite moment, whatever the hand in which both count.
    """
    tilt = math.sqrt(phi_x * phi_x + phi_y * phi_y + TILT_FLOOR * TILT_FLOOR)
    return -collar.radius * phi_x / tilt, -collar.radius * phi_y / tilt, -direction * collar.friction


@kernel
def stiffness(collar: Record, phi_x: float, phi_y: float, force: float) -> tuple[float, float, float]:
    """Return ∂M_x/∂φ_x, ∂M_y/∂φ_y and ∂M_x/∂φ_y = ∂M_y/∂φ_x [N m/rad] under an axial force [N]."""
    tilt = math.sqrt(phi_x * phi_x + phi_y * phi_y + TILT_FLOOR * TILT_FLOOR)
    load = collar.radius * force
    along_x = -load * (tilt * tilt - phi_x * phi_x) / tilt**3
    along_y = -load * (tilt * tilt - phi_y * phi_y) / tilt**3
    return along_x, along_y, load * phi_x * phi_y / tilt**3


@kernel
def note_lift_off(extremes: Record, h: float, force: float) -> None:
    """Note a part of an accepted step of length ``h`` [s] with the axial force at its end [N]."""
    if force == 0.0:
        extremes.collar_lift_off_time += h
