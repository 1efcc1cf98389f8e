"""One row of observed quantities, in the order of :data:`OBSERVED`."""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear, copy
from tribodyn.kernels.bushing import report as joint_report
from tribodyn.kernels.bushing.joint import stored
from tribodyn.kernels.bushing.names import REPORTED as JOINT
from tribodyn.kernels.bushing.names import STATES
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.vsv import ledger
from tribodyn.kernels.vsv import newton_euler as ne
from tribodyn.kernels.vsv.books import N_INTEGRALS
from tribodyn.kernels.vsv.data import Mechanism, VsvData, VsvMemory
from tribodyn.kernels.vsv.layout import (
    N_UNKNOWNS,
    OV_X,
    OV_Y,
    PHI_X,
    PHI_Y,
    S3_Y,
    THETA_A,
    THETA_B,
    THETA_V,
    VALUE,
    VELOCITY,
)
from tribodyn.kernels.vsv.motion import fill_rods

MOTION: Final = (
    "theta_a",
    "theta_b",
    "theta_v",
    "theta_v_ideal",
    "omega_a",
    "omega_v",
    "omega_v_ideal",
    "h_1",
)
COLLAR: Final = ("M_tcx", "M_tcy", "M_tf")
REACTIONS: Final = (
    "F_ax",
    "F_ay",
    "F_az",
    "M_ax",
    "M_az",
    "M_d",
    "F_21x",
    "F_21y",
    "F_21z",
    "F_32x",
    "F_32y",
    "F_32z",
    "F_43x",
    "F_43y",
    "F_43z",
    "F_bx",
    "F_bz",
    "M_bx",
    "M_bz",
    "F_cz",
)
AIR: Final = ("F_airx", "F_airy", "M_air")
ENERGIES: Final = ("energy_kinetic", "energy_gravity")
INTEGRALS: Final = (
    "work_drive",
    "work_loads",
    "work_friction",
    "work_collar_friction",
    "work_collar_tilt",
    "heat_damping",
    "work_clearance_loads",
    "work_clearance_friction",
    "work_clearance_collar",
    "work_clearance_inertia",
)
OBSERVED: Final = STATES + MOTION + JOINT + COLLAR + REACTIONS + AIR + ENERGIES + INTEGRALS

_MOTION = len(STATES)
_JOINT = _MOTION + len(MOTION)
_COLLAR = _JOINT + len(JOINT)
_REACTIONS = _COLLAR + len(COLLAR)
_AIR = _REACTIONS + len(REACTIONS)
_ENERGIES = _AIR + len(AIR)
_INTEGRALS = _ENERGIES + len(ENERGIES)


@kernel
def _vanes(mechanism: Mechanism, t: float, y: FloatArray, memory: VsvMemory, row: FloatArray) -> None:
    """Fill ideal and actual vane angle and speed.

    In ``paper`` the actual angle is read from the closure with the offsets e_x, e_y alone.
    """
    motion, table = memory.scratch.motion, memory.scratch.ideal
    clear(table)
    fill_rods(mechanism, t, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, table)
    row[_MOTION + 3] = table[THETA_V, VALUE]
    row[_MOTION + 6] = table[THETA_V, VELOCITY]
    if mechanism.exact > 0.0:
        row[_MOTION + 2] = motion[THETA_V, VALUE]
        row[_MOTION + 5] = motion[THETA_V, VELOCITY]
    else:
        clear(table)
        fill_rods(mechanism, t, y[0], y[1], 0.0, 0.0, y[4], y[5], 0.0, 0.0, table)
        row[_MOTION + 2] = table[THETA_V, VALUE]
        row[_MOTION + 5] = table[THETA_V, VELOCITY]


@entry
def observe(t: float, y: FloatArray, data: VsvData, memory: VsvMemory, row: FloatArray) -> None:
    """Fill ``row`` with the quantities named in :data:`OBSERVED`, SI units."""
    scratch = memory.scratch
    if not ledger.is_at_mark(t, y, memory):
        scratch.f_cz = ledger.evaluate(data, t, y, memory)
    f_cz = scratch.f_cz
    copy(y, row)
    _vanes(data.mechanism, t, y, memory, row)
    scratch.report[joint_report.STORED] = stored(data.joint, memory.entry_velocity, y)
    motion, force = scratch.motion, scratch.force
    row[_MOTION] = motion[THETA_A, VALUE]
    row[_MOTION + 1] = motion[THETA_B, VALUE]
    row[_MOTION + 4] = motion[THETA_A, VELOCITY]
    row[_MOTION + 7] = motion[S3_Y, VALUE] - data.mechanism.l_4
    for k in range(joint_report.N_REPORT):
        row[_JOINT + k] = scratch.report[k]
    row[_COLLAR] = f_cz * scratch.collar[PHI_X]
    row[_COLLAR + 1] = f_cz * scratch.collar[PHI_Y]
    row[_COLLAR + 2] = f_cz * scratch.collar[THETA_V]
    row[_AIR] = force[OV_X]
    row[_AIR + 1] = force[OV_Y]
    row[_AIR + 2] = force[THETA_V] - scratch.wrench[4]
    ledger.fill_energies(data.mechanism, scratch, row[_ENERGIES:])
    ne.newton_euler(data.mechanism, y, memory, 1.0 if f_cz == 0.0 else 0.0)
    for k in range(N_UNKNOWNS - ne.F_AX):
        row[_REACTIONS + k] = scratch.reactions[ne.F_AX + k, 0]
    for k in range(N_INTEGRALS):
        row[_INTEGRALS + k] = memory.books.integrals[k]
