"""A case of the journal as the mechanism that it is, with its start, its tolerances and printed names."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, Stopped
from tribodyn.core.problem import Problem
from tribodyn.integrate import INTERRUPTED
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.mechanism_variables import observed
from tribodyn.mechanism.system import MechanismSystem
from tribodyn.mechanisms.bushing import bushing_facts
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart
from tribodyn.mechanisms.wear_state import Worn
from tribodyn.presets.journal.case import BEARING, JournalCase, mechanism_of
from tribodyn.presets.journal.equilibrium import Equilibrium, Journal, Loads, equilibrium, journal_in
from tribodyn.presets.journal.results import loads_as_printed, named_as_printed
from tribodyn.results.dataset import MODEL

_LOADS: Final = ("force_x", "force_y", "moment_x", "moment_y")
_TURN: Final = slice(ORIENTATION, VELOCITY)
#: Share of the relative tolerance that holds for each state: the position is the eccentricity.
_RELATIVE: Final = np.repeat([1.0, 0.0, 1.0], [ORIENTATION, VELOCITY - ORIENTATION, N_STATES - VELOCITY])


def journal_of(case: JournalCase) -> Journal:
    """Return the journal that a case describes, as it is at the start."""
    more, drive = case.loads.more, case.drive.speed
    return journal_in(
        model_of(mechanism_of(case)).clearances[BEARING],
        tilts=case.journal.tilt,
        speed=case.journal.speed if drive is None else drive.curve().at_start,
        loads=_loads_at_start(case) if more else Loads(**{key: getattr(case.loads, key) for key in _LOADS}),
        changes=bool(more) or drive is not None,
    )


def _loads_at_start(case: JournalCase) -> Loads:
    """Return the loads at the start, of an axis at rest in the middle of its bushing."""
    mechanism = mechanism_of(case)
    problem = MechanismSystem(mechanism).problem(case.duration)
    problem.functions.enter(0.0, problem.y0, problem.data, problem.memory)
    row = np.zeros((1, problem.n_observed))
    problem.functions.observe(0.0, problem.y0, problem.data, problem.memory, row[0])
    loads = loads_as_printed(observed(row, 1).couplings, mechanism)
    return Loads(*(float(component[0]) for component in loads.values()))


@dataclass(frozen=True, kw_only=True)
class JournalSystem(MechanismSystem):
    """The journal of a case; ``keys`` are its own, ``case`` those of the mechanism that it is."""

    keys: JournalCase

    @cached_property
    def journal(self) -> Journal:
        """The journal in its bushing."""
        return journal_of(self.keys)

    @cached_property
    def balance(self) -> Equilibrium | None:
        """The static equilibrium, None where there is none or the load changes."""
        if self.journal.changes:
            return None
        try:
            return equilibrium(self.journal)
        except (InputError, Stopped):
            return None

    def start(self) -> FloatArray:
        """Return the state in which the run begins, shape (13,)."""
        run, state = self.keys.run, self.assembly.state.copy()
        attitude = np.array([run.start_x, run.start_y, 0.0, 0.0])
        if run.start == "equilibrium":
            attitude = equilibrium(self.journal).attitude
        state[:2] += attitude[:2]
        state[_TURN] = _leaning(attitude[2:])
        return state

    def problem(self, duration: float, worn: Worn | None = None) -> Problem:
        """Return the initial value problem over ``duration`` [s]; a journal does not wear."""
        tolerances = np.repeat(_tolerances(self.keys), [3, 4, 3, 3])
        return replace(super().problem(duration), atol=tolerances, relative=_RELATIVE)

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return the facts about a run, with their names in the source paper."""
        part, native = super().gather(run), self._observed(run).couplings
        # Whoever wants to stop does not wait for what takes many evaluations of a fine film.
        balance = None if run.solution.failure == INTERRUPTED else self.balance
        rest = np.full(2, np.nan) if balance is None else balance.attitude[:2]
        drive = {"energy_drive": part.columns["energy_in"] - part.columns["energy_loads"]}
        printed = named_as_printed(part.columns, tilts=self.keys.journal.tilt)
        return replace(
            part,
            columns={**part.columns, **printed, **loads_as_printed(native, self.case), **drive},
            fields={**part.fields, "e_x_balance": rest[0], "e_y_balance": rest[1]},
            attributes={
                **part.attributes,
                **bushing_facts(self.keys),
                "start": self.keys.run.start,
                MODEL: self.case.to_toml(),
            },
            failure=part.failure.replace(f"joints.{BEARING}.clearance.bulk", "joint.bulk"),
        )


def _leaning(tilt: FloatArray) -> FloatArray:
    """Return the quaternion of an axis that leans by (φ_x, φ_y) [rad], shape (4,); φ_y is left-handed."""
    slope = portable.tan(tilt)
    axis = np.array([-slope[1], -slope[0], 1.0])
    axis /= dense.norm(axis)
    # The shortest turn from z to the axis: (1 + z·a, z × a), of any length.
    turn = np.array([1.0 + axis[2], -axis[1], axis[0], 0.0])
    return np.asarray(turn / dense.norm(turn))


def _tolerances(case: JournalCase) -> tuple[float, float, float, float]:
    """Return absolute tolerances of positions, orientations, velocities and angular velocities.

    A quaternion is of the order one however small a tilt is: the relative tolerance holds for a tilt across
    the clearance.
    """
    position, tilt, velocity, rate = case.solver.atol.as_tuple
    widest = 2.0 * case.joint.clearance / case.joint.length
    return position, tilt + case.solver.rtol * widest, velocity, rate


def system_of(case: JournalCase) -> JournalSystem:
    """Return the system of a case."""
    return JournalSystem(mechanism_of(case), keys=case)


SYSTEM: Final = system_of
