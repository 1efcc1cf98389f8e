"""The compiled functions of the VSV problem for the protocol of ``core/problem.py``; the loop over steps."""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import begin_segment
from tribodyn.kernels.jit import clear, entry, kernel
from tribodyn.kernels.joints.bushing import pressure_field, update_entry_velocity
from tribodyn.kernels.ledger import is_at_mark
from tribodyn.kernels.mebdf.drive import loop
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv import ledger
from tribodyn.kernels.vsv.closure import ideal_vane, place
from tribodyn.kernels.vsv.data import VsvData, VsvMemory
from tribodyn.kernels.vsv.equations import accelerations, accelerations_and_gradient
from tribodyn.kernels.vsv.motion import drive, fill_rods
from tribodyn.kernels.vsv.quantities import Air, Row, States, Works
from tribodyn.kernels.vsv.reactions import fill_reactions


@kernel
def _fill_motion(data: VsvData, t: float, y: FloatArray, memory: VsvMemory, out: Record) -> None:
    """Fill angles and speeds; in ``paper`` θ_v is read from the closure with the offsets e_x, e_y alone."""
    mechanism, motion = data.mechanism, memory.scratch.motion
    theta_a, omega_a = motion[at.THETA_A, at.VALUE], motion[at.THETA_A, at.VELOCITY]
    ideal, slope = ideal_vane(mechanism, theta_a, motion[at.S1_X, at.VALUE], motion[at.S1_Z, at.VALUE])
    out.theta_v_ideal, out.omega_v_ideal = ideal, slope * omega_a
    if mechanism.exact > 0.0:
        out.theta_v, out.omega_v = motion[at.THETA_V, at.VALUE], motion[at.THETA_V, at.VELOCITY]
    else:
        table, crank = memory.scratch.closed, drive(data, memory.segment, t)
        clear(table)
        fill_rods(mechanism, crank, (y[0], y[1], 0.0, 0.0), (y[4], y[5], 0.0, 0.0), table)
        out.theta_v, out.omega_v = table[at.THETA_V, at.VALUE], table[at.THETA_V, at.VELOCITY]
    out.theta_a, out.omega_a = theta_a, omega_a
    out.theta_b = motion[at.THETA_B, at.VALUE]
    out.h_1 = motion[at.S3_Y, at.VALUE] - mechanism.l_4


@entry
def observe(t: float, y: FloatArray, data: VsvData, memory: VsvMemory, row: FloatArray) -> None:
    """Fill ``row`` with the quantities of the mechanism, SI units."""
    scratch, joint, out = memory.scratch, memory.joint.scratch, row.view(Row)[0]
    if not (scratch.marked > 0.0 and is_at_mark(memory.books, t, y)):
        scratch.f_cz = ledger.evaluate(data, t, y, memory)
    collar, f_cz = scratch.collar, scratch.f_cz
    _fill_motion(data, t, y, memory, out.motion)
    out.states = y.view(States)[0]
    out.joint = joint.report
    out.collar.M_tcx, out.collar.M_tcy = f_cz * collar[at.PHI_X], f_cz * collar[at.PHI_Y]
    out.collar.M_tf = f_cz * collar[at.THETA_V]
    out.air = scratch.air.view(Air)[0]
    ledger.fill_energies(data.mechanism, scratch, out.energies)
    fill_reactions(data.mechanism, scratch, out.reactions)
    out.works = memory.books.works.view(Works)[0]


#: Entry of the regime that is above zero once a step was accepted beyond a limit. From then on no force is a
#: number, which stops every integrator. Trial states may lie there: the law goes on linearly.
BEYOND: Final = 2
BEYOND_LAW: Final = 1.0
#: Its values: beyond the range of the contact law, and where the mechanism cannot be joined, without an angle
#: of the vane.
BEYOND_REACH: Final = 2.0


@entry
def rhs(t: float, y: FloatArray, data: VsvData, memory: VsvMemory, f: FloatArray) -> None:
    """Fill ``f`` (8,) with the time derivative of the state."""
    accelerations(data, t, y, memory)
    for i in range(4):
        f[i] = y[4 + i]
        f[4 + i] = memory.scratch.acceleration[i] if memory.regime[BEYOND] == 0.0 else math.nan


@entry
def jac(
    t: float, y: FloatArray, data: VsvData, memory: VsvMemory, f: FloatArray, jacobian: FloatMatrix
) -> None:
    """Fill ``f`` (8,) and its derivative ``jacobian`` (8, 8)."""
    accelerations_and_gradient(data, t, y, memory)
    clear(jacobian)
    for i in range(4):
        f[i] = y[4 + i]
        f[4 + i] = memory.scratch.acceleration[i]
        jacobian[i, 4 + i] = 1.0
        for k in range(8):
            jacobian[4 + i, k] = memory.scratch.solved[i, 1 + k]


@entry
def enter(t: float, y: FloatArray, data: VsvData, memory: VsvMemory) -> None:
    """Begin a segment: set the direction of the ideal vane motion and where the pieces of tables end."""
    turned = begin_segment(data.actions, t, memory.segment)
    memory.regime[0] = memory.segment.direction
    ledger.begin(data, t, y, memory, turned)


@entry
def advance(t_a: float, t_b: float, y_b: FloatArray, data: VsvData, memory: VsvMemory) -> None:
    """Add the path integrals over ``[t_a, t_b]``: the energy ledgers and the sliding load."""
    ledger.add_part(data, t_b, y_b, memory)


@entry
def accept(t: float, y: FloatArray, data: VsvData, memory: VsvMemory) -> None:
    """Update entry velocities and watch both limits at the end of an accepted step, the last mark."""
    place(data, t, y, 0.0, 0.0, memory)
    update_entry_velocity(data.joint, memory.joint, memory.joint.scratch.pose, 0.0)
    if memory.joint.scratch.report.separation_min < data.joint.surface.surfaces[0].deepest:
        memory.regime[BEYOND] = BEYOND_LAW
    if not math.isfinite(memory.scratch.motion[at.THETA_V, at.VALUE]):
        memory.regime[BEYOND] = BEYOND_REACH


@entry
def picture(t: float, y: FloatArray, data: VsvData, memory: VsvMemory, fields: FloatCube) -> None:
    """Fill ``fields`` (1, n_z + 2, n_theta) with the contact pressure [Pa]."""
    place(data, t, y, 0.0, 0.0, memory)
    pressure_field(data.joint, memory.joint, memory.joint.scratch.pose, fields[0])


@entry
def kinetostatic_residual(
    t: float, y: FloatArray, data: VsvData, memory: VsvMemory, residual: FloatArray, jacobian: FloatMatrix
) -> None:
    """Fill the load (4,) [N, N m] that remains with q̇ = q̈ = 0, and its derivative (4, 4).

    All velocities of the state are zero; the ideal motion at the time is included. The geometry of the rods
    is held fixed in the derivative.
    """
    accelerations_and_gradient(data, t, y, memory)
    for i in range(4):
        residual[i] = memory.scratch.load[1 + i]
        for k in range(4):
            total = 0.0
            for j in range(4):
                total += memory.scratch.mass[1 + i, j] * memory.scratch.solved[j, 1 + k]
            jacobian[i, k] = total


LOOP: Final = loop(rhs, jac, advance, accept, observe, picture)
#: Functions by the names that ``CompiledFunctions`` of ``core/problem.py`` has for them.
FUNCTIONS: Final[dict[str, Any]] = {
    "rhs": rhs,
    "jac": jac,
    "enter": enter,
    "advance": advance,
    "accept": accept,
    "observe": observe,
    "picture": picture,
}
