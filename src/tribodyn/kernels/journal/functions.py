"""The compiled functions of the journal problem, as the protocol in ``core/problem.py`` asks for them."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.actions import begin_segment
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.joints.bushing import pressure_field, update_entry_velocity
from tribodyn.kernels.journal import ledger
from tribodyn.kernels.journal.data import JournalData, JournalMemory
from tribodyn.kernels.journal.equations import forces, forces_and_gradient, least_gap, place


@entry
def rhs(t: float, y: FloatArray, data: JournalData, memory: JournalMemory, f: FloatArray) -> None:
    """Fill ``f`` (n,) with the time derivative of the state."""
    forces(data, t, y, memory)
    n = y.size // 2
    for i in range(n):
        f[i] = y[n + i]
        f[n + i] = memory.scratch.total[i] / data.constants.inertia[i]


@entry
def jac(
    t: float, y: FloatArray, data: JournalData, memory: JournalMemory, f: FloatArray, jacobian: FloatArray
) -> None:
    """Fill ``f`` (n,) and its derivative ``jacobian`` (n, n)."""
    forces_and_gradient(data, t, y, memory)
    gradient = memory.scratch.wrench_jacobian
    clear(jacobian)
    n = y.size // 2
    for i in range(n):
        f[i] = y[n + i]
        f[n + i] = memory.scratch.total[i] / data.constants.inertia[i]
        jacobian[i, n + i] = 1.0
        for k in range(n):
            jacobian[n + i, k] = gradient[i, k] / data.constants.inertia[i]
            jacobian[n + i, n + k] = gradient[i, 4 + k] / data.constants.inertia[i]


@entry
def enter(t: float, y: FloatArray, data: JournalData, memory: JournalMemory) -> None:
    """Begin a segment: set the direction of rotation and where the pieces of tables end."""
    begin_segment(data.actions, t, memory.segment)
    ledger.begin(data, t, y, memory)


@entry
def advance(t_a: float, t_b: float, y_b: FloatArray, data: JournalData, memory: JournalMemory) -> None:
    """Add the path integrals of the energy ledger over ``[t_a, t_b]``."""
    ledger.add_part(data, t_b, y_b, memory)


@entry
def accept(t: float, y: FloatArray, data: JournalData, memory: JournalMemory) -> None:
    """Update entry velocities, count rebounds and watch the range of the law at the end of a step."""
    place(data, t, y, memory)
    gap = least_gap(data.joint, memory.scratch.state)
    ledger.count_rebound(data, gap, memory)
    if gap < data.constants.deepest:
        memory.course.beyond = 1.0
    update_entry_velocity(data.joint, memory.joint, memory.joint.scratch.pose, 0.0)


@entry
def picture(t: float, y: FloatArray, data: JournalData, memory: JournalMemory, fields: FloatArray) -> None:
    """Fill ``fields`` (1, n_z + 2, n_theta) with the contact pressure [Pa]."""
    place(data, t, y, memory)
    pressure_field(data.joint, memory.joint, memory.joint.scratch.pose, fields[0])


@kernel
def static_residual(
    q: FloatArray, data: JournalData, memory: JournalMemory, residual: FloatArray, jacobian: FloatArray
) -> None:
    """Fill the generalised load on a journal whose axis is at rest at t = 0, and its derivative.

    Parameters
    ----------
    q
        Attitude, (e_x, e_y) or (e_x, e_y, φ_x, φ_y), shape (n,).
    data, memory
        As for ``rhs``.
    residual
        Generalised loads [N, N m], shape (n,).
    jacobian
        Derivative in ``q``, shape (n, n).
    """
    n = q.size
    y = memory.scratch.rest[: 2 * n]
    for i in range(n):
        y[i] = q[i]
        y[n + i] = 0.0
    forces_and_gradient(data, 0.0, y, memory)
    for i in range(n):
        residual[i] = memory.scratch.total[i]
        for k in range(n):
            jacobian[i, k] = memory.scratch.wrench_jacobian[i, k]
