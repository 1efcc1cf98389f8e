"""One row of observed quantities, see ``kernels/journal/quantities.py``."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import entry
from tribodyn.kernels.journal import ledger
from tribodyn.kernels.journal.data import OPPOSED, JournalData, JournalMemory
from tribodyn.kernels.journal.quantities import Film, Forces, Loads, Row, States


@entry
def observe(t: float, y: FloatArray, data: JournalData, memory: JournalMemory, row: FloatArray) -> None:
    """Fill ``row`` with the quantities of the journal, SI units."""
    scratch, joint, out = memory.scratch, memory.joint.scratch, row.view(Row)[0]
    ledger.evaluate(data, t, y, memory)
    out.states = scratch.state.view(States)[0]
    out.joint = joint.report
    out.film = scratch.film.view(Film)[0]
    out.loads = scratch.load[:OPPOSED].view(Loads)[0]
    out.rotation.omega = scratch.speed
    out.energies.energy_kinetic = ledger.kinetic_energy(data.constants.inertia, scratch.state)
    out.works = memory.books.works[: memory.books.works.size - 1].view(Forces)[0]
