"""Energy ledger of the mechanism: powers and forces at an instant, energies, and quantities with peaks.

Of the two energy ledgers, that of the whole mechanism gets powers. The clearance ledger follows the clearance
motion alone, q̇ᵀ(N q̈ − Q), with N = Σ m_r δr δrᵀ: forces on the four clearance coordinates, and the momenta
N q̇.
"""

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import TIME, add_following
from tribodyn.kernels.jit import clear, inlined, kernel
from tribodyn.kernels.joints.bushing import note_lift_off, report, slide
from tribodyn.kernels.joints.memory import fill_watched, note_extremes
from tribodyn.kernels.joints.pose import from_report
from tribodyn.kernels.ledger import LAST, MOMENTUM, NOW, POSITION, RATE, SPEED, SWING, swings
from tribodyn.kernels.ledger import add_part as add_works
from tribodyn.kernels.ledger import begin as begin_works
from tribodyn.kernels.peaks import begin as begin_peaks
from tribodyn.kernels.peaks import note as note_peaks
from tribodyn.kernels.peaks import resume as resume_peaks
from tribodyn.kernels.vsv import data as at
from tribodyn.kernels.vsv.closure import place, vane_attitude
from tribodyn.kernels.vsv.data import AIR_M, AIR_X, AIR_Y, BEND_X, BEND_Y, VsvData, VsvMemory
from tribodyn.kernels.vsv.equations import drive_moment, set_up, solve_accelerations
from tribodyn.kernels.vsv.quantities import Forces, Powers, Watched


@inlined
def evaluate(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> float:
    """Fill all scratch arrays of one instant, joint report included, and return F_cz [N]."""
    scratch, joint = memory.scratch, memory.joint.scratch
    omega = set_up(data, t, y, memory)
    place(data, t, y, omega, memory.regime[0], memory)
    report(data.joint, memory.joint, joint.pose)
    from_report(joint.report)
    out = joint.report
    scratch.wrench[0] = out.F_cx + out.F_fx
    scratch.wrench[1] = out.F_cy + out.F_fy
    scratch.wrench[2] = out.M_jcx + out.M_fx
    scratch.wrench[3] = out.M_jcy + out.M_fy
    scratch.wrench[4] = out.M_jf
    return solve_accelerations(data, y, memory)


@kernel
def clearance_velocity(motion: FloatArray, row: int, y: FloatArray) -> float:
    """Return the part of a row's velocity that the clearance motion makes."""
    return motion[row, 1] * y[4] + motion[row, 2] * y[5] + motion[row, 3] * y[6] + motion[row, 4] * y[7]


@kernel
def fill_powers(y: FloatArray, memory: VsvMemory, powers: Record) -> None:
    """Fill the power of each contributor on the whole mechanism [W] from the scratch arrays."""
    scratch = memory.scratch
    motion, collar = scratch.motion, scratch.collar
    omega_v, f_cz = motion[at.THETA_V, at.VELOCITY], scratch.f_cz
    air = scratch.air
    sec2_x, sec2_y = scratch.secants[0], scratch.secants[1]
    powers.work_drive = drive_moment(scratch) * motion[at.THETA_A, at.VELOCITY]
    powers.work_loads = (
        air[AIR_X] * motion[at.OV_X, at.VELOCITY]
        + air[AIR_Y] * motion[at.OV_Y, at.VELOCITY]
        + air[AIR_M] * omega_v
    )
    powers.work_loads += sec2_x * air[BEND_X] * y[6] + sec2_y * air[BEND_Y] * y[7]
    powers.work_friction = memory.joint.scratch.report.friction_power
    powers.work_collar_friction = f_cz * collar[at.THETA_V] * omega_v
    powers.work_collar_tilt = f_cz * (collar[at.PHI_X] * y[6] + collar[at.PHI_Y] * y[7])
    powers.work_expansion = memory.joint.surface.reports[0].expansion_power


@kernel
def fill_joint_forces(secants: FloatArray, out: Record, forces: FloatArray) -> None:
    """Fill the forces of damping and friction on the clearance coordinates, one coordinate a row."""
    sec2_x, sec2_y = secants[0], secants[1]
    on_x, on_y = forces[0].view(Forces)[0], forces[1].view(Forces)[0]
    about_x, about_y = forces[2].view(Forces)[0], forces[3].view(Forces)[0]
    on_x.heat_damping, on_x.work_clearance_friction = out.F_kx - out.F_cx, out.F_fx
    on_y.heat_damping, on_y.work_clearance_friction = out.F_ky - out.F_cy, out.F_fy
    about_x.heat_damping = sec2_x * (out.M_kx - out.M_jcx)
    about_y.heat_damping = sec2_y * (out.M_ky - out.M_jcy)
    about_x.work_clearance_friction, about_y.work_clearance_friction = sec2_x * out.M_fx, sec2_y * out.M_fy


@kernel
def fill_clearance(mechanism: Record, y: FloatArray, memory: VsvMemory) -> None:
    """Fill forces on the clearance coordinates, their motion and their momenta at this instant."""
    scratch, forces, here = memory.scratch, memory.books.forces[NOW], memory.books.motion[NOW]
    motion, collar, out = scratch.motion, scratch.collar, memory.joint.scratch.report
    fill_joint_forces(scratch.secants, out, forces)
    for j in range(4):
        turning = motion[at.THETA_V, 1 + j]
        loads = -scratch.wrench[4] * turning
        for row in range(at.E_X):
            loads += (scratch.force[row] - mechanism.inertia[row] * motion[row, at.BIAS]) * motion[row, 1 + j]
        force = forces[j].view(Forces)[0]
        force.work_clearance_friction += out.M_jf * turning
        force.work_clearance_loads = loads
        force.work_clearance_collar = scratch.f_cz * collar[at.THETA_V] * turning
        here[POSITION, j], here[SPEED, j], here[MOMENTUM, j] = y[j], y[4 + j], 0.0
    for row in range(at.N_BODY):
        momentum = mechanism.inertia[row] * clearance_velocity(motion, row, y)
        for j in range(4):
            here[MOMENTUM, j] += momentum * motion[row, 1 + j]
    about_x, about_y = forces[2].view(Forces)[0], forces[3].view(Forces)[0]
    about_x.work_clearance_loads += scratch.secants[0] * scratch.air[BEND_X]
    about_y.work_clearance_loads += scratch.secants[1] * scratch.air[BEND_Y]
    about_x.work_clearance_collar += scratch.f_cz * collar[at.PHI_X]
    about_y.work_clearance_collar += scratch.f_cz * collar[at.PHI_Y]


@kernel
def _fill_swing(data: VsvData, y: FloatArray, memory: VsvMemory) -> None:
    """Move the loads that follow time from those of the clearance motion to where their rates are known."""
    scratch, actions, books = memory.scratch, data.actions, memory.books
    motion, air, swing = scratch.motion, scratch.air_over_time, books.swing[NOW]
    clear(air)
    n = actions.terms.size
    add_following(actions.signals, actions.terms, 0, n, memory.regime[0], TIME, scratch.places, air)
    sec2 = (0.0, 0.0, scratch.secants[0], scratch.secants[1])
    for j in range(4):
        for k in (SWING, RATE):
            swing[k, j] = (
                air[k, AIR_X] * motion[at.OV_X, 1 + j]
                + air[k, AIR_Y] * motion[at.OV_Y, 1 + j]
                + air[k, AIR_M] * motion[at.THETA_V, 1 + j]
            )
            if j > 1:
                swing[k, j] += air[k, BEND_X if j == 2 else BEND_Y] * sec2[j]
        books.forces[NOW, j].view(Forces)[0].work_clearance_loads -= swing[SWING, j]


@kernel
def vane_angle_with_clearance(mechanism: Record, y: FloatArray, motion: FloatArray) -> float:
    """Return θ_v [rad]; in ``paper`` it is read from the closure with the offsets e_x, e_y alone."""
    if mechanism.exact > 0.0:
        return motion[at.THETA_V, at.VALUE]
    s1_x, s1_z = motion[at.S1_X, at.VALUE], motion[at.S1_Z, at.VALUE]
    return vane_attitude(mechanism, motion[at.THETA_A, at.VALUE], s1_x, s1_z, y[0], y[1], 0.0, 0.0)[0]


@kernel
def _fill_watched(mechanism: Record, y: FloatArray, memory: VsvMemory) -> None:
    """Fill the sizes of this instant whose peaks are kept."""
    motion, watched = memory.scratch.motion, memory.peaks.values[NOW].view(Watched)[0]
    fill_watched(memory.joint.scratch.report, y, watched.joint)
    s1_x, s1_z = motion[at.S1_X, at.VALUE], motion[at.S1_Z, at.VALUE]
    ideal, _, _ = vane_attitude(mechanism, motion[at.THETA_A, at.VALUE], s1_x, s1_z, 0.0, 0.0, 0.0, 0.0)
    watched.mechanism.drive_moment = abs(drive_moment(memory.scratch))
    watched.mechanism.vane_angle_error = abs(vane_angle_with_clearance(mechanism, y, motion) - ideal)


@inlined
def _evaluate_mark(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Enter the powers and forces of an instant, and what is watched, in the books."""
    scratch = memory.scratch
    scratch.f_cz = evaluate(data, t, y, memory)
    fill_powers(y, memory, memory.books.powers[NOW].view(Powers)[0])
    fill_clearance(data.mechanism, y, memory)
    if swings(memory.books):
        _fill_swing(data, y, memory)
    _fill_watched(data.mechanism, y, memory)
    scratch.marked = 1.0


@inlined
def begin(data: VsvData, t: float, y: FloatArray, memory: VsvMemory, turned: bool) -> None:
    """Set the mark at ``t``, from which :func:`add_part` goes on; peaks begin where the vane ``turned``."""
    _evaluate_mark(data, t, y, memory)
    begin_works(memory.books, t)
    if turned or memory.peaks.course.stretch < 0:
        begin_peaks(memory.peaks, t)
    else:
        resume_peaks(memory.peaks, t)


@inlined
def add_part(data: VsvData, t: float, y: FloatArray, memory: VsvMemory) -> None:
    """Add the path integrals from the mark to ``t`` and move the mark there."""
    h = t - memory.books.times[LAST]
    slide(data.joint, memory.joint, 0.5 * h)
    _evaluate_mark(data, t, y, memory)
    note_peaks(memory.peaks, t)
    note_extremes(memory.joint, h)
    note_lift_off(memory.collar, h, memory.scratch.f_cz)
    add_works(memory.books, t)
    slide(data.joint, memory.joint, 0.5 * h)


@kernel
def fill_energies(mechanism: Record, scratch: Record, energies: Record) -> None:
    """Fill kinetic and gravity energy [J] from the scratch arrays of this instant."""
    motion = scratch.motion
    energies.energy_kinetic = energies.energy_gravity = 0.0
    for row in range(at.N_BODY):
        energies.energy_kinetic += 0.5 * mechanism.inertia[row] * motion[row, at.VELOCITY] ** 2
    for row in (at.O1_Z, at.O2_Z, at.O3_Z):
        energies.energy_gravity -= mechanism.weight[row] * motion[row, at.VALUE]
