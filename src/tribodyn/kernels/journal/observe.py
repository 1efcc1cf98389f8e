"""One row of observed quantities, in the order of :data:`OBSERVED`."""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import copy
from tribodyn.kernels.bushing import report as joint_report
from tribodyn.kernels.bushing.joint import stored
from tribodyn.kernels.bushing.names import REPORTED as JOINT
from tribodyn.kernels.bushing.names import STATES
from tribodyn.kernels.jit import entry
from tribodyn.kernels.journal import ledger
from tribodyn.kernels.journal.data import JournalData, JournalMemory

FILM: Final = ("F_ox", "F_oy", "M_ox", "M_oy", "M_of")
ENERGIES: Final = ("energy_kinetic",)
INTEGRALS: Final = ("work_loads", "work_friction", "heat_damping", "work_drive", "work_film")
OBSERVED: Final = STATES + JOINT + FILM + ENERGIES + INTEGRALS

_JOINT = len(STATES)
_FILM = _JOINT + len(JOINT)
_ENERGIES = _FILM + len(FILM)
_INTEGRALS = _ENERGIES + len(ENERGIES)


@entry
def observe(t: float, y: FloatArray, data: JournalData, memory: JournalMemory, row: FloatArray) -> None:
    """Fill ``row`` with the quantities named in :data:`OBSERVED`, SI units."""
    scratch = memory.scratch
    ledger.evaluate(data, y, memory)
    scratch.report[joint_report.STORED] = stored(data.joint, memory.entry_velocity, scratch.state)
    copy(scratch.state, row)
    for k in range(joint_report.N_REPORT):
        row[_JOINT + k] = scratch.report[k]
    for k in range(5):
        row[_FILM + k] = scratch.film[k]
    row[_ENERGIES] = ledger.kinetic_energy(data, scratch.state)
    for k in range(ledger.N_INTEGRALS):
        row[_INTEGRALS + k] = memory.integrals[k]
