"""Parts of an evaluation of the general engine, called many times from compiled code."""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.mechanism.bodies import place, rates
from tribodyn.kernels.mechanism.data import PLAIN, REPORTS, MechanismData, MechanismMemory
from tribodyn.kernels.mechanism.equations import assemble, solve_rows
from tribodyn.kernels.mechanism.functions import touch
from tribodyn.kernels.mechanism.ledger import fill_totals
from tribodyn.kernels.mechanism.solution import (
    EXACT,
    correct_velocities,
    fill_velocities,
    forces,
    kinematics,
    take_accelerations,
)

PARTS: Final = (
    "states to bodies, and rates",
    "kinematics",
    "kinematics, velocities only",
    "forces",
    "forces with reports",
    "assembly and factorisation",
    "accelerations from the factors",
    "multipliers of one correction",
    "correction of velocities",
    "energies and momentum",
    "contact begins and ends",
)
"""What ``repeat`` calls, by number."""


@kernel
def repeat(
    part: int,
    calls: int,
    t: float,
    y: FloatArray,
    data: MechanismData,
    memory: MechanismMemory,
    f: FloatArray,
) -> None:
    """Call one of :data:`PARTS` ``calls`` times."""
    parts, now, blocks = data.parts, memory.now, memory.blocks
    for _ in range(calls):
        if part == 0:
            place(y, now.bodies)
            rates(now.bodies, f)
        elif part == 1:
            kinematics(parts, now, data.signals, t)
        elif part == 2:
            fill_velocities(parts, now)
        elif part == 3:
            forces(data, memory, t, PLAIN)
        elif part == 4:
            forces(data, memory, t, REPORTS)
        elif part == 5:
            assemble(parts, now, data.mass, blocks)
        elif part == 6:
            take_accelerations(parts, now, data.mass, blocks, 0.0)
        elif part == 7:
            solve_rows(parts, now, data.mass, blocks, 0.0, EXACT)
        elif part == 8:
            correct_velocities(parts, now, data.mass, blocks, 0.0)
        elif part == 9:
            fill_totals(parts, now)
        elif part == 10:
            touch(data, memory, 0.0)
