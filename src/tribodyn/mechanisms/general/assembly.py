"""Assembly of a drawing: small gaps closed, velocities from drives, and what is wrong, in words."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels.mechanism.bodies import collect, place
from tribodyn.kernels.mechanism.data import N_STATES, MechanismData, MechanismMemory
from tribodyn.kernels.mechanism.redundancy import choose_rows, row_scale
from tribodyn.kernels.mechanism.solution import kinematics, set_compliance
from tribodyn.mechanisms.general.closing import CLOSED, DEPENDENT, System
from tribodyn.mechanisms.general.description import Description
from tribodyn.mechanisms.general.equations import new_memory
from tribodyn.mechanisms.general.inspection import Finding, inspect


@dataclass(frozen=True)
class Redundancy:
    """Constraints of a loop that say the same more than once.

    Attributes
    ----------
    number
        How many of them.
    joints
        Names of the joints that share them.
    """

    number: int
    joints: tuple[str, ...]


@dataclass(frozen=True)
class Assembly:
    """A mechanism put together.

    Attributes
    ----------
    description
        As drawn.
    findings
        What forbids a run; empty for a sound mechanism.
    freedoms
        Degrees of freedom that drives leave.
    redundancy
        Constraints beyond the independent ones; None without any.
    moved
        How far assembly has moved the body that it moved farthest [m].
    state
        State at the start, shape (13 n,).
    data
        What the kernels read.
    """

    description: Description
    findings: tuple[Finding, ...]
    freedoms: int
    redundancy: Redundancy | None
    moved: float
    state: FloatArray
    data: MechanismData

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a run must repeat: reactions that are not unique."""
        if self.redundancy is None:
            return ()
        number, joints = self.redundancy.number, ", ".join(self.redundancy.joints)
        return (
            f"{number} constraint{'s' * (number > 1)} more than are independent, shared by {joints}: "
            "their reactions are those of least norm, and not the only ones possible",
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is worth knowing of it, in words."""
        n = self.freedoms
        free = "no degree of freedom is left" if n == 0 else f"{n} degree{'s' * (n > 1)} of freedom"
        remarks = [free, *self.warnings]
        if self.moved > CLOSED * float(self.data.parts.constants.size):
            remarks.append(f"assembly moved a body by {self.moved * 1e3:.4g} mm to close the joints")
        return tuple(remarks)

    def require_sound(self) -> None:
        """Raise ``InputError`` of the first finding, if there is one."""
        if self.findings:
            raise InputError(self.findings[0].text, key=self.findings[0].key)


def assemble(description: Description, worn: FloatArray | None = None) -> Assembly:
    """Put a mechanism together as drawn.

    Joints with clearance are closed as if they were ideal, so that each shaft starts in the middle.

    Parameters
    ----------
    description
        The drawing; findings that concern it alone are part of the result.
    worn
        Wear depth at the nodes of all joints with clearance [m], shape (n_nodes,); none by default.
    """
    findings = list(inspect(description))
    ideal = replace(description, joints=tuple(replace(joint, clearance=None) for joint in description.joints))
    closed = System(ideal)
    findings += closed.approach()
    system = System(description, worn)
    system.take_positions(closed)
    rank, dependent = system.independence()
    drives = {(k, m): name for k, m, name in system.drive_rows()}
    redundancy = None
    if dependent.size:
        taking_part = np.max(np.abs(dependent), axis=0) > DEPENDENT
        rows = [row for row, part in zip(system.rows, taking_part, strict=True) if part]
        driven = sorted({drives[row] for row in rows if row in drives})
        if driven:
            findings.append(_contradiction(driven))
        names = dict.fromkeys(description.joints[k].name for k, _ in rows)
        redundancy = Redundancy(len(system.rows) - rank, tuple(names))
    system.parts.constants.rank = rank
    findings += system.unequal(rank)
    findings += system.start(description.speeds)
    moved = float(np.max(np.linalg.norm(system.now.bodies.r[:-1] - system.parts.bodies.centre, axis=1)))
    state = np.zeros(N_STATES * len(description.bodies))
    collect(system.now.bodies, state)
    freedoms = 6 * len(description.bodies) - rank
    return Assembly(description, tuple(findings), freedoms, redundancy, moved, state, system.data)


def _contradiction(drives: list[str]) -> Finding:
    """Return the finding that drives act where nothing is left to drive."""
    if len(drives) == 1:
        text = f"drive {drives[0]} has nothing to drive: as drawn, the joints leave its coordinate no freedom"
    else:
        text = f"drives {' and '.join(drives)} drive one freedom; keep one of them"
    return Finding(f"drives.{drives[-1]}", text)


def memory_of(assembly: Assembly, state: FloatArray) -> MechanismMemory:
    """Return a memory in a state, in which rows have their scale and dependent ones are marked."""
    data, memory = assembly.data, new_memory(assembly.data)
    parts, now = data.parts, memory.now
    place(state, now.bodies)
    kinematics(parts, now, data.signals, 0.0)
    row_scale(parts, now)
    set_compliance(parts, now)
    if parts.constants.rank < parts.constants.n_rows:
        choose_rows(parts, now, memory.independence)
    return memory


def closes_until(assembly: Assembly, duration: float, n: int = 181) -> tuple[float, Finding] | None:
    """Return the first time at which a joint no longer closes under the drives, with the finding.

    Looked at where drives leave no freedom; None where all joints close, or where freedoms are left.

    Parameters
    ----------
    assembly
        A sound assembly.
    duration
        Until when [s].
    n
        Number of times looked at.
    """
    if assembly.freedoms > 0 or assembly.findings:
        return None
    system = System(assembly.description)
    place(assembly.state, system.now.bodies)
    for t in np.linspace(0.0, duration, n)[1:].tolist():
        system.t = t
        system.refresh()
        if system.close() > CLOSED:
            return t, system.open_joint()
    return None
