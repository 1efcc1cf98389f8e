"""Assembly of a drawing: small gaps closed, velocities from drives, and what is wrong, in words."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.bodies import collect, place
from tribodyn.kernels.mechanism.data import N_STATES, MechanismData, MechanismMemory
from tribodyn.kernels.mechanism.redundancy import choose_rows, row_scale
from tribodyn.kernels.mechanism.solution import kinematics, set_compliance, set_offsets
from tribodyn.mechanism.assembly.closing import CLOSED, CLOSES, SIZE, System
from tribodyn.mechanism.assembly.decompositions import DEPENDENT
from tribodyn.mechanism.assembly.misfit import Misfit
from tribodyn.mechanism.assembly.odd_axes import odd_axes
from tribodyn.mechanism.assembly.parts_by_number import Model, ModelError
from tribodyn.mechanism.assembly.records import new_memory
from tribodyn.mechanism.assembly.start_speeds import speeds_of, start


@dataclass(frozen=True)
class Redundancy:
    """Constraints of a loop that say the same more than once."""

    number: int  #: How many of them.
    joints: tuple[str, ...]  #: Names of the joints that share them.


@dataclass(frozen=True)
class Assembly:
    """A mechanism put together."""

    model: Model  #: As drawn.
    findings: tuple[ModelError, ...]  #: What forbids a run; empty for a sound mechanism.
    freedoms: int  #: Degrees of freedom that drives leave.
    redundancy: Redundancy | None  #: Constraints beyond the independent ones; None without any.
    inexact: tuple[str, ...]  #: Warnings of bodies whose masses differ so much that reactions lose digits.
    moved: FloatArray  #: How far assembly has moved the mass centre of each body [m], shape (n,).
    state: FloatArray  #: State at the start, shape (13 n,).
    data: MechanismData  #: What the kernels read.
    ideal_rank: int  #: Number of independent constraints if all joints were ideal; in a mechanism with loops.
    #: Degrees of freedom that drives would leave if all joints were ideal; None where those do not fit.
    ideal_freedoms: int | None
    #: What the mechanism would be refused for if all its joints were ideal; whether clearances take it shows
    #: when it is led through its cycle.
    findings_if_ideal: tuple[ModelError, ...] = ()
    #: What kernels read of the mechanism with ideal joints in the place of clearances; None without any.
    ideal_data: MechanismData | None = None
    strain: str = ""  #: Which clearances take what ideal joints do not allow, in words; empty for none.

    @property
    def warnings(self) -> tuple[str, ...]:
        """Notes for a run: clearances that are needed to move, reactions not unique, or not exact."""
        strained = (self.strain,) if self.strain else ()
        if self.redundancy is None:
            return (*strained, *self.inexact)
        number, joints = self.redundancy.number, ", ".join(self.redundancy.joints)
        return (
            *strained,
            f"{number} constraint{'s' * (number > 1)} more than are independent, shared by {joints}: "
            "their reactions are those of least norm, and not the only ones possible",
            *self.inexact,
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """Remarks on it, in words."""
        return f"degrees of freedom: {self._freedoms}", *self.warnings, *self.notes

    @property
    def _freedoms(self) -> str:
        """Degrees of freedom in words: of ideal joints, with what holds too little, and of clearances."""
        ideal = self.ideal_freedoms
        if ideal is None:
            return f"{self.freedoms}; ideal joints do not fit"
        why = ""
        if ideal == 0:
            why = " (fully driven)" if self.model.case.drives else " (fully held)"
        elif ends := self.model.held_by_one:
            why = f": {', '.join(f'{body} is held by {joint} only' for body, joint in ends.items())}"
        what = " and ".join(
            ["clearances"] * bool(self.model.clearances) + ["beams"] * bool(self.model.elastic)
        )
        more = self.freedoms - ideal
        return f"{ideal} with ideal joints{why}" + (f"; {what} free {more} more" if more else "")

    @property
    def notes(self) -> tuple[str, ...]:
        """Return that bodies do not start where the model has them."""
        farthest = int(np.argmax(self.moved))
        if self.moved[farthest] <= CLOSED * SIZE:
            return ()
        body = self.model.bodies[farthest]
        return (f"assembly moved {body} by {self.moved[farthest] * 1e3:.4g} mm to close the joints",)

    def require_sound(self) -> None:
        """Raise ``InputError`` of the first finding, if there is one."""
        if self.findings:
            raise InputError(self.findings[0].text, key=self.findings[0].key)


def assemble(model: Model, worn: FloatArray | None = None) -> Assembly:
    """Put a mechanism together as drawn, worn at the nodes of all joints with clearance [m].

    Joints with clearance are closed as if they were ideal, so that each shaft starts in the middle. Findings
    that concern the model alone are part of the result.
    """
    findings = list(model.loose())
    closed, open_joints, findings_if_ideal = _closed(in_place := model.in_place)
    findings += open_joints
    as_drawn = not (model.yields or model.held) and in_place is model
    system = System(model, worn, data=closed.data if as_drawn else None)
    system.take_positions(closed)
    if (findings_if_ideal or in_place is not model) and system.close() >= CLOSES and not findings_if_ideal:
        findings.append(system.open_joint())
    rank, dependent = system.independence()
    redundancy = None
    if dependent.size:
        taking_part = _taking_part(system, dependent)
        names = (name.removeprefix("joint ") for name in model.owners({k for k, _ in taking_part}))
        redundancy = Redundancy(len(system.rows) - rank, tuple(names))
        findings += _loads_not_unique(model, redundancy)
    contradictions = _contradictions(system, dependent)
    findings += contradictions
    ideal_rank, ideal = rank, None
    ideal_rows: int | None = None if model.yields else rank
    if model.yields:
        ideal = Misfit(model, System(model.counterpart))
        ideal.system.take_positions(system if in_place is model else closed)
    if ideal and model.has_loops and not (contradictions or open_joints or findings_if_ideal):
        ideal_rank, dependent = ideal.system.independence()
        findings_if_ideal = _contradictions(ideal.system, dependent)
        ideal_rows = ideal_rank
    elif ideal and not model.has_loops:
        ideal_rows = len(ideal.system.rows)
    system.parts.constants.rank = rank
    unequal, inexact = system.unequal(rank)
    contrary = start(system, speeds_of(model), ideal, fits=not findings_if_ideal)
    findings += findings_if_ideal if findings_if_ideal and contrary else [*unequal, *contrary]
    moved = np.linalg.norm(system.now.bodies.r[:-1] - system.parts.bodies.centre, axis=1)
    state = np.zeros(N_STATES * len(model.bodies))
    collect(system.now.bodies, state)
    freedoms = 6 * len(model.bodies) - rank
    return Assembly(
        model,
        tuple(findings),
        freedoms,
        redundancy,
        tuple(inexact),
        moved,
        state,
        system.data,
        ideal_rank,
        None if ideal_rows is None else 6 * len(model.bodies) - ideal_rows,
        tuple(findings_if_ideal),
        None if ideal is None else ideal.system.data,
    )


def _closed(model: Model) -> tuple[System, list[ModelError], list[ModelError]]:
    """Close the joints as if they were ideal; where not all close, the bodies are where they miss least.

    Also returns what does not close, whatever the clearances, and what does not but for the clearances.
    """
    closed = System(model.as_drawn)
    found = closed.approach()
    if not (found and model.clearances):
        return closed, found, []
    closed = System(model.counterpart)
    found = closed.approach()
    fits = not found or Misfit(model, closed).close()
    return (closed, [], found) if fits else (closed, found, [])


def _taking_part(system: System, dependent: FloatArray) -> list[tuple[int, int]]:
    """Return the rows that depend on each other, as joint and row."""
    taking_part = np.max(np.abs(dependent), axis=0) > DEPENDENT
    return [row for row, part in zip(system.rows, taking_part, strict=True) if part]


def _loads_not_unique(model: Model, redundancy: Redundancy) -> list[ModelError]:
    """Return the elements that follow a reaction which is not unique."""
    found, sharing = [], ", ".join(redundancy.joints)
    for element in model.elements:
        table, itself = f"{element.keys.TABLE}.{element.name}", f"{element.keys.METHOD} {element.name}"
        for law in (equation.law for equation in element.equations if equation.law is not None):
            words = "is not unique: no friction follows from it"
            if law.load_of in redundancy.joints:
                words = f"the reaction of {law.load_of} {words}; give normal_load, or let joints hold less"
                found.append(ModelError(f"{table}.normal_load", f"{words}: {sharing}"))
            elif law.load_leg is not None and itself in redundancy.joints:
                words = f"the force of {itself} {words}; let joints hold less"
                found.append(ModelError(f"{table}.friction_coefficient", f"{words}: {sharing}"))
    return found


def _contradictions(system: System, dependent: FloatArray) -> list[ModelError]:
    """Return the finding that drives act where nothing is left to drive, if they do."""
    if not dependent.size:
        return []
    names = {(k, m): name for k, m, name in system.drive_rows()}
    drives = sorted({names[row] for row in _taking_part(system, dependent) if row in names})
    if not drives:
        return []
    if len(drives) == 1:
        locking = _locking(system, dependent, names)
        leave = "leaves" if len(locking) == 1 else "leave"
        text = (
            f"drive {drives[0]} has nothing to drive: {', '.join(locking) or 'the joints'} {leave} its "
            f"coordinate no degree of freedom; remove one of them, or the drive{_odd_axes(system, locking)}"
        )
    else:
        text = f"drives {' and '.join(drives)} drive one freedom; keep one of them"
    return [ModelError(f"drives.{drives[-1]}", text)]


def _locking(system: System, dependent: FloatArray, drives: Mapping[tuple[int, int], str]) -> list[str]:
    """Return the joints and elements that hold the coordinate of a drive."""
    of_drive = [row in drives for row in system.rows]
    combined = dense.product(dependent[:, of_drive].T, dependent)
    return system.model.owners({k for k, m in _taking_part(system, combined) if (k, m) not in drives})


def _odd_axes(system: System, locking: list[str]) -> str:
    """Return the axes out of plane among the joints on the path of a drive, in words."""
    joints = system.model.case.joints
    return odd_axes({name: keys for name, keys in joints.items() if f"joint {name}" in locking})


def memory_of(assembly: Assembly, state: FloatArray) -> MechanismMemory:
    """Return a memory in a state, in which rows have their scale and dependent ones are marked."""
    data, memory = assembly.data, new_memory(assembly.data)
    parts, now = data.parts, memory.now
    place(state, now.bodies)
    kinematics(parts, now, data.signals, 0.0)
    set_offsets(parts, now)
    row_scale(parts, now)
    set_compliance(parts, now)
    if parts.constants.rank < parts.constants.n_rows:
        choose_rows(parts, now, memory.independence)
    return memory
