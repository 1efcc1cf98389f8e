"""Rows of observed quantities."""

from __future__ import annotations

import math
from typing import Any, Final

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.mechanism.data import (
    ANGLE,
    CONTACT,
    DAMPING,
    FRICTION,
    POSITION,
    WORK,
    MechanismData,
    MechanismMemory,
    Now,
    Parts,
)
from tribodyn.kernels.mechanism.quantities import BODY, COUPLING, WHOLE
from tribodyn.kernels.mechanism.vectors import turn, turn_back

N_WHOLE: Final = len(WHOLE)
N_BODY: Final = len(BODY)
N_COUPLING: Final = len(COUPLING)


@kernel
def fill_row(data: MechanismData, memory: MechanismMemory, row: FloatArray) -> None:
    """Fill a row with what stands settled."""
    _whole(data.parts, memory.now, memory.books, row[:N_WHOLE])
    first = N_WHOLE
    for b in range(data.parts.bodies.size):
        _body(memory.now.bodies[b], row[first : first + N_BODY], memory.now.rest[0, :3])
        first += N_BODY
    for k in range(data.parts.couplings.size):
        coupling, out = data.parts.couplings[k], row[first : first + N_COUPLING]
        _coupling(coupling, memory.now.couplings[k], memory.books[k], out)
        if coupling.force == CONTACT:
            _contact(data.contact, memory.contact, coupling.contact, out)
        first += N_COUPLING


@kernel
def _whole(data: Parts, memory: Now, books: Any, out: FloatArray) -> None:
    """Energies, works, momenta and impulses of the whole, and how well constraints hold."""
    course, n = memory.course, data.couplings.size
    for i in range(out.size):
        out[i] = 0.0
    out[0], out[1] = course.kinetic, course.potential
    for k in range(n):
        now, book = memory.couplings[k], books[k]
        out[2] += now.stored
        out[3] += book.sums[WORK]
        out[4] += book.sums[DAMPING]
        out[5] += book.sums[FRICTION]
        for m in range(data.couplings[k].n_rows):
            out[18] = max(out[18], abs(now.residual[m]))
            out[19] = max(out[19], abs(now.rate[m]))
    for i in range(6):
        out[6 + i] = course.momentum[i]
    for i in range(3):
        out[12 + i], out[15 + i] = books[n].sums[i], books[n + 1].sums[i]


@kernel
def _body(now: Record, out: FloatArray, turned: FloatArray) -> None:
    """Position, quaternion, velocity and acceleration of a body, in global axes."""
    for i in range(4):
        out[3 + i] = now.p[i]
    for i in range(3):
        out[i], out[7 + i], out[13 + i] = now.r[i], now.v[i], now.acceleration[i]
    turn(now.A, now.w, turned)
    for i in range(3):
        out[10 + i] = turned[i]
    turn(now.A, now.acceleration[3:6], turned)
    for i in range(3):
        out[16 + i] = turned[i]


@kernel
def _coupling(coupling: Record, now: Record, book: Record, out: FloatArray) -> None:
    """Motion of the shaft, wrench of the joint and of its drives on it, and books of a coupling."""
    axis, driving = now.pose.rotation[:, 2], now.work[0, :6]
    _drive(coupling, now, driving)
    out[0] = now.angle
    out[4], out[5] = -axis[1] / axis[2], axis[0] / axis[2]
    for i in range(3):
        out[1 + i] = now.pose.d[i]
    for i in range(6):
        out[6 + i] = now.twist[i]
        out[12 + i] = now.wrench[i] + now.constraint[i] - driving[i]
    turn_back(now.RT, out[12:15], out[18:21])
    turn_back(now.RT, out[15:18], out[21:24])
    out[24], out[25] = driving[5], driving[2]
    for i in range(3):
        out[26 + i] = book.sums[i]
    out[29] = now.stored
    for i in range(30, 35):
        out[i] = 0.0
    out[35], out[36] = now.powers[FRICTION], now.powers[DAMPING]


@kernel
def _drive(coupling: Record, now: Record, out: FloatArray) -> None:
    """Fill the wrench of the drives of a joint on its shaft (6,)."""
    for i in range(6):
        out[i] = 0.0
    out[5], out[2] = now.effort[0], now.effort[1]
    for m in range(coupling.n_rows):
        if coupling.row_kind[m] == ANGLE or coupling.row_kind[m] == POSITION:
            for i in range(6):
                out[i] += now.N[m, i] * now.multiplier[m]


@kernel
def _contact(joints: SurfaceData, memory: SurfaceMemory, j: int, out: FloatArray) -> None:
    """Add up the surfaces of a joint with clearance."""
    out[34] = math.inf
    for s in range(joints.joints[j], joints.joints[j + 1]):
        report = memory.reports[s]
        out[30] += report.F_cx
        out[31] += report.F_cy
        out[32] += report.F_cz
        out[33] = max(out[33], report.p_max)
        out[34] = min(out[34], report.separation_min)
