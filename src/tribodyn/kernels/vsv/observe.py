"""One row of observed quantities, see ``kernels/vsv/quantities.py``."""

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.ledger import is_at_mark
from tribodyn.kernels.vsv import layout as at
from tribodyn.kernels.vsv import ledger
from tribodyn.kernels.vsv.closure import ideal_vane
from tribodyn.kernels.vsv.data import VsvData, VsvMemory
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
