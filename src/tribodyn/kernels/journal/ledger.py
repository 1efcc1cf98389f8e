"""What the journal enters in its energy ledger: forces on its coordinates at an instant, and its energy.

Loads and drive put work in; friction, damping and film turn it into heat. Coordinates are those of the
centre, the tilts and the angle of the rotation.
"""

from __future__ import annotations

from mebdf.kernels.elementary import hypot, tan
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.bushing import report
from tribodyn.kernels.joints.memory import fill_watched, note_extremes
from tribodyn.kernels.joints.paper import from_report
from tribodyn.kernels.journal.data import JournalData, JournalMemory
from tribodyn.kernels.journal.equations import film_force, place
from tribodyn.kernels.journal.quantities import Forces, Watched
from tribodyn.kernels.ledger import LAST, NOW, POSITION, SPEED
from tribodyn.kernels.ledger import add_part as add_works
from tribodyn.kernels.ledger import begin as begin_works
from tribodyn.kernels.peaks import begin as begin_peaks
from tribodyn.kernels.peaks import note as note_peaks
from tribodyn.kernels.peaks import resume as resume_peaks


@inlined
def evaluate(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Fill states, joint report and film of one instant."""
    place(data, t, y, memory)
    report(data.joint, memory.joint, memory.joint.scratch.pose)
    from_report(memory.joint.scratch.report)
    film_force(data.film, memory.film, memory.scratch.speed, memory.scratch)


@kernel
def fill_motion(scratch: Record, motion: FloatArray) -> None:
    """Fill coordinates and velocities of the ledger."""
    state = scratch.state
    for i in range(4):
        motion[POSITION, i], motion[SPEED, i] = state[i], state[4 + i]
    motion[POSITION, 4], motion[SPEED, 4] = scratch.turned, scratch.speed


@kernel
def fill_forces(memory: JournalMemory) -> None:
    """Fill the forces on the coordinates from the scratch arrays of this instant, one coordinate a row."""
    forces, out, film = memory.books.forces[NOW], memory.joint.scratch.report, memory.scratch.film
    state, load = memory.scratch.state, memory.scratch.load
    sec2_x, sec2_y = 1.0 + tan(state[2]) ** 2, 1.0 + tan(state[3]) ** 2
    damping = (out.F_kx - out.F_cx, out.F_ky - out.F_cy, out.M_kx - out.M_jcx, out.M_ky - out.M_jcy, 0.0)
    friction = (out.F_fx, out.F_fy, out.M_fx, out.M_fy, out.M_jf)
    scale = (1.0, 1.0, sec2_x, sec2_y, 1.0)
    for i in range(5):
        force = forces[i].view(Forces)[0]
        force.work_loads = load[i] if i < 4 else 0.0
        force.work_friction = scale[i] * friction[i]
        force.heat_damping = scale[i] * damping[i]
        force.work_film = scale[i] * film[i]
        force.work_drive = -(out.M_jf + film[4]) if i == 4 else 0.0


@inlined
def _evaluate_mark(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Enter the forces of an instant, and what is watched, in the books."""
    evaluate(data, t, y, memory)
    watched, film = memory.peaks.values[NOW].view(Watched)[0], memory.scratch.film
    fill_watched(memory.joint.scratch.report, memory.scratch.state, watched.joint)
    watched.film.film_force = hypot(film[0], film[1])
    fill_motion(memory.scratch, memory.books.motion[NOW])
    fill_forces(memory)


@inlined
def begin(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Set the mark at ``t``, from which :func:`add_part` goes on."""
    _evaluate_mark(data, t, y, memory)
    begin_works(memory.books, t)
    if memory.peaks.course.stretch < 0:
        begin_peaks(memory.peaks, t)
    else:
        resume_peaks(memory.peaks, t)


@inlined
def add_part(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Add the path integrals from the mark to ``t`` and move the mark there."""
    _evaluate_mark(data, t, y, memory)
    note_peaks(memory.peaks, t)
    note_extremes(memory.joint, t - memory.books.times[LAST])
    add_works(memory.books, t)


@kernel
def count_rebound(data: JournalData, gap: float, memory: JournalMemory) -> None:
    """Count a rebound where the journal, in contact at the last step, touches nowhere now.

    ``gap`` is the smallest gap of the bushing [m].
    """
    surface = data.joint.surface.surfaces[0]
    touching = gap < surface.onset * surface.roughness
    if memory.course.touching > 0.0 and not touching:
        memory.counts.rebounds += 1.0
    memory.course.touching = 1.0 if touching else 0.0


@kernel
def kinetic_energy(inertia: FloatArray, state: FloatArray) -> float:
    """Return the kinetic energy of the motion in the clearance [J]; that of the rotation does not change."""
    energy = 0.0
    for i in range(4):
        energy += 0.5 * inertia[i] * state[4 + i] ** 2
    return energy
