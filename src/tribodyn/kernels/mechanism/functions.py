"""The compiled functions of any mechanism, as ``core/problem.py`` asks for them; the loop over steps."""

import math
from typing import Any, Final

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.kernels.jit import copy
from tribodyn.kernels.film.data import film_at, memory_at
from tribodyn.kernels.film.report import film_pressure
from tribodyn.kernels.jit import entry, inlined, kernel
from tribodyn.kernels.joints.film import note_film_peaks
from tribodyn.kernels.joints.surface import joint as surfaces
from tribodyn.kernels.joints.surface.memory import note_peaks
from tribodyn.kernels.mebdf.drive import loop
from tribodyn.kernels.mechanism import ledger
from tribodyn.kernels.mechanism.bodies import rates
from tribodyn.kernels.mechanism.data import (
    CONTACT,
    INTACT,
    NONE,
    PLAIN,
    SLOPES,
    MechanismData,
    MechanismMemory,
    Now,
    Parts,
)
from tribodyn.kernels.mechanism.equations import has_law
from tribodyn.kernels.mechanism.jacobian import fill_derivatives, fill_gyroscopic, fill_jacobian
from tribodyn.kernels.mechanism.law import remember
from tribodyn.kernels.mechanism.newton import factorise, fill_entries, solve
from tribodyn.kernels.mechanism.observe import fill_row, watch
from tribodyn.kernels.mechanism.redundancy import SMALL, choose_rows
from tribodyn.kernels.mechanism.solution import accelerations, mark_angles, settle

BEFORE_KINK: Final = 1.0e-9  #: Part of a segment by which its pieces end before the kink.


@entry
def rhs(t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory, f: FloatArray) -> None:
    """Fill ``f`` (n,) with the time derivative of the state."""
    accelerations(data, memory, t, y, PLAIN)
    rates(memory.now.bodies, f)
    if memory.now.course.broken != INTACT:
        for i in range(f.size):
            f[i] = math.nan


@inlined
def _differentiate(
    t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory, f: FloatArray
) -> None:
    """Fill ``f`` and the derivatives that bodies and couplings hold."""
    accelerations(data, memory, t, y, SLOPES)
    rates(memory.now.bodies, f)
    fill_derivatives(data.parts, memory.now)
    fill_gyroscopic(data.parts, memory.now)


@entry
def jac(
    t: float,
    y: FloatArray,
    data: MechanismData,
    memory: MechanismMemory,
    f: FloatArray,
    jacobian: FloatMatrix,
) -> None:
    """Fill ``f`` (n,) and its derivative ``jacobian`` (n, n)."""
    _differentiate(t, y, data, memory, f)
    fill_jacobian(data.parts, memory.now, data.mass, memory.blocks, jacobian)


@entry
def jac_entries(
    t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory, f: FloatArray, entries: FloatArray
) -> None:
    """Fill ``f`` (n,) and the entries (n_entries,) that ``kernels/mechanism/newton.py`` names."""
    _differentiate(t, y, data, memory, f)
    fill_entries(data.parts, memory.now, entries)


@entry
def enter(t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory) -> None:
    """Begin a segment: its pieces of tables hold, and the state is put on the constraints as they go on."""
    course, kinks = memory.now.course, data.signals.kinks
    course.begin, course.until = t, math.inf
    for i in range(kinks.size - 1, -1, -1):
        if kinks[i] > t:
            course.until = kinks[i] - BEFORE_KINK * (kinks[i] - t)
    settle(data, memory, t, y)
    mark_angles(memory.now.couplings)
    for k in range(data.parts.couplings.size):
        law = memory.now.couplings[k].law
        if math.isnan(law.anchor):
            law.anchor = law.position
    _look_after_rows(data.parts, memory.now, memory.independence)
    copy(memory.settled, y)
    ledger.begin(data.parts, memory.now, memory.books, t)


@kernel
def _look_after_rows(parts: Parts, now: Now, matrix: FloatArray) -> None:
    """Choose the independent rows anew where some are not; the more there are, the more rarely."""
    course, n = now.course, parts.constants.n_rows
    course.wait -= 1
    if parts.constants.rank < n and course.wait <= 0:
        choose_rows(parts, now, matrix)
        course.wait = 1 + (n // SMALL) ** 3


@kernel
def _slide(data: MechanismData, memory: MechanismMemory, h: float) -> None:
    """Add to the sliding loads what slides in ``h`` [s] as at the last reports."""
    for k in range(data.parts.couplings.size):
        if data.parts.couplings[k].force == CONTACT:
            surfaces.slide(data.contact, memory.contact, data.parts.couplings[k].contact, h)


@entry
def advance(t_a: float, t_b: float, y_b: FloatArray, data: MechanismData, memory: MechanismMemory) -> None:
    """Settle at the end of a part of an accepted step and add to the books."""
    h = t_b - t_a
    _slide(data, memory, 0.5 * h)
    settle(data, memory, t_b, y_b)
    ledger.add_part(data.parts, memory.now, memory.books, t_b)
    _slide(data, memory, 0.5 * h)
    for k in range(data.parts.couplings.size):
        if data.parts.couplings[k].force == CONTACT:
            note_peaks(data.contact, memory.contact, data.parts.couplings[k].contact, t_b, h)
        if data.parts.couplings[k].film != NONE:
            note_film_peaks(memory.oil[data.parts.couplings[k].film], t_b)


@entry
def observe(t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory, row: FloatArray) -> None:
    """Fill ``row``, see ``kernels/mechanism/observe.py``, with what stands settled since ``advance``."""
    fill_row(data, memory, row)


@entry
def accept(t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory) -> None:
    """Put the state on the constraints, count turns, let contact begin and end, watch the joints."""
    copy(memory.settled, y)
    mark_angles(memory.now.couplings)
    watch(data, memory)
    touch(data, memory, 0.0)
    _look_after_rows(data.parts, memory.now, memory.independence)


@entry
def touch(data: MechanismData, memory: MechanismMemory, at_start: float) -> None:
    """Let contact of all joints and in all force laws begin and end."""
    for k in range(data.parts.couplings.size):
        if data.parts.couplings[k].force == CONTACT:
            pose = memory.now.couplings[k].pose
            surfaces.update_entry_velocity(
                data.contact, memory.contact, data.parts.couplings[k].contact, pose, at_start
            )
        if has_law(data.parts.couplings[k]):
            remember(memory.now.couplings[k].law)


@entry
def picture(
    t: float, y: FloatArray, data: MechanismData, memory: MechanismMemory, fields: FloatArray
) -> None:
    """Fill the contact pressure at the nodes of all joints [Pa], and behind them that of all films."""
    for k in range(data.parts.couplings.size):
        if data.parts.couplings[k].force == CONTACT:
            pose = memory.now.couplings[k].pose
            surfaces.pressure_field(
                data.contact, memory.contact, data.parts.couplings[k].contact, pose, fields
            )
    n_theta, n_z = data.films.wear_node.shape[1:]
    for k in range(data.films.constants.size):
        first = data.contact.nodes.shape[1] + k * n_theta * n_z
        field = fields[first : first + n_theta * n_z].reshape((n_z, n_theta))
        film_pressure(film_at(data.films, k), memory_at(memory.films, k), field)


LOOP: Final = loop(rhs, jac_entries, advance, accept, observe, picture, factorise, solve)
#: Functions by the names that ``CompiledFunctions`` of ``core/problem.py`` has for them.
FUNCTIONS: Final[dict[str, Any]] = {
    "rhs": rhs,
    "jac": jac_entries,
    "enter": enter,
    "advance": advance,
    "accept": accept,
    "observe": observe,
    "picture": picture,
}
