"""A case of the journal as a system to integrate, and what its runs return."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.cases.beyond import FollowedTable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, Stopped
from tribodyn.core.problem import Problem
from tribodyn.core.quantities import names
from tribodyn.integrate import INTERRUPTED
from tribodyn.kernels import dense
from tribodyn.kernels.joints.quantities import EXTREMES
from tribodyn.kernels.joints.surface.quantities import N_REPORT, REPORTED
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.kernels.mechanism.functions import observe_surfaces
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.results.mechanism_checks import failure
from tribodyn.mechanisms.base import FinishedRun, ResultPart
from tribodyn.mechanisms.bushing import (
    bushing_facts,
    bushing_of,
    force_parts,
    loading,
    of_temperature,
    on_finer_grid,
)
from tribodyn.mechanisms.checks import instant, of_clearance, of_damping_pressure, of_tables
from tribodyn.mechanisms.flash import flash_of_bushing
from tribodyn.mechanisms.wear_state import Worn
from tribodyn.presets.journal.case import JournalCase
from tribodyn.presets.journal.checks import warnings
from tribodyn.presets.journal.energy_balance import balance_columns, residual_fraction
from tribodyn.presets.journal.equilibrium import Equilibrium, equilibrium
from tribodyn.presets.journal.model import BEARING, inertia, mechanism_of
from tribodyn.presets.journal.parameters import Journal, Loads
from tribodyn.presets.journal.rows import (
    FILM,
    LOADS,
    TURNED,
    WATCHED,
    layout_of,
    peaks_of,
    rebounds_of,
    rows_of,
)

SETTLED: Final = 0.01
"""Distance from the static equilibrium, over the clearance, within which a journal has settled."""
_LOADS: Final = ("force_x", "force_y", "moment_x", "moment_y")
_TURN: Final = slice(ORIENTATION, VELOCITY)
_RELATIVE: Final = np.repeat([1.0, 0.0, 1.0], [ORIENTATION, VELOCITY - ORIENTATION, N_STATES - VELOCITY])
"""Share of the relative tolerance that holds for each state: the position is the eccentricity."""


def journal_of(case: JournalCase) -> Journal:
    """Return the journal that a case describes, as it is at the start."""
    joint, more = bushing_of(case), case.loads.more
    changes = bool(more) or case.drive.speed is not None
    return Journal(
        tilts=case.journal.tilt,
        speed=case.journal.speed if case.drive.speed is None else case.drive.speed.curve().at_start,
        loads=_loads_at_start(case) if more else Loads(**{key: getattr(case.loads, key) for key in _LOADS}),
        joint=joint,
        film=case.film.film(joint.geometry, case.surfaces) if case.film.lubricated else None,
        changes=changes,
    )


def _loads_at_start(case: JournalCase) -> Loads:
    """Return the loads at the start, of an axis at rest."""
    system = JournalSystem(case)
    problem = system.centred(case.duration)
    problem.functions.enter(0.0, problem.y0, problem.data, problem.memory)
    row = np.zeros(problem.n_observed)
    problem.functions.observe(0.0, problem.y0, problem.data, problem.memory, row)
    rows = system.rows(row[None, problem.kept])
    return Loads(*(float(rows[name][0]) for name in names(LOADS)))


@dataclass(frozen=True)
class JournalSystem:
    """The journal of a case; see :class:`~tribodyn.mechanisms.base.SimulatedSystem`.

    It moves as the mechanism that it is; results are in the coordinates and signs of the source paper.
    """

    case: JournalCase

    @cached_property
    def assembly(self) -> Assembly:
        """The journal, its bearing, drive and loads as a mechanism, put together."""
        found = assemble(model_of(mechanism_of(self.case)))
        found.require_sound()
        return found

    @cached_property
    def journal(self) -> Journal:
        """The journal in its bushing."""
        return journal_of(self.case)

    @cached_property
    def balance(self) -> Equilibrium | None:
        """The static equilibrium, None where there is none or the load changes."""
        if self.journal.changes:
            return None
        try:
            return equilibrium(self.journal)
        except (InputError, Stopped):
            return None

    def check(self) -> Sequence[str]:
        """Put the journal together, its joint, contact law and film with it."""
        return [text for text in [of_clearance(self.journal.joint.touch)] if text]

    def problem(self, duration: float, worn: Worn | None = None) -> Problem:
        """Return the initial value problem over ``duration`` [s]; a journal does not wear."""
        run = self.case.run
        start = np.array([run.start_x, run.start_y, 0.0, 0.0])
        if run.start == "equilibrium":
            start = equilibrium(self.journal).attitude
        return self._started(start, duration)

    def centred(self, duration: float) -> Problem:
        """Return the problem of a journal that starts in the middle of its bushing."""
        return self._started(np.zeros(4), duration)

    def _started(self, attitude: FloatArray, duration: float) -> Problem:
        """Return the problem of a journal whose axis starts at rest at (e_x, e_y, φ_x, φ_y) [m, rad]."""
        assembly, case = self.assembly, self.case
        state = assembly.state.copy()
        state[:2] += attitude[:2]
        state[_TURN] = _leaning(attitude[2:])
        problem = mechanism_problem(
            assembly,
            duration=duration,
            rtol=case.solver.rtol,
            atol=_tolerances(case),
            state=state,
            dense=case.solver.name != "mebdf",
        )
        places, report = layout_of(assembly.model.case).places, problem.n_observed + np.arange(N_REPORT)
        assert places is not None
        return replace(
            problem,
            functions=replace(problem.functions, observe=observe_surfaces),
            n_observed=problem.n_observed + N_REPORT,
            kept=np.append(places, report),
            relative=_RELATIVE,
        )

    def rows(self, values: FloatArray) -> dict[str, FloatArray]:
        """Return the observed quantities by name, in the terms of the paper; ``values`` are rows of a run."""
        first = values.shape[1] - N_REPORT
        case, mechanism = self.case, self.assembly.model.case
        loads = [(load.point or (0.0, 0.0, 0.0), load.frame) for load in mechanism.loads.values()]
        return rows_of(
            layout_of(mechanism).observed(values[:, :first]),
            dict(zip(names(REPORTED), values[:, first:].T, strict=True)),
            joints=len(mechanism.joints),
            heights=np.array([z for (_, _, z), _ in loads]),
            signs=np.array([-1.0 if frame == "body" else 1.0 for _, frame in loads]),
            spin_inertia=inertia(case)[2],
            tilts=case.journal.tilt,
        )

    def output_times(self, duration: float) -> FloatArray:
        """Return the times of the rows [s], uniform, the end included."""
        times = np.arange(0.0, duration, self.case.run.output_interval)
        return np.append(times[times < duration * (1.0 - 1.0e-9)], duration)

    def picture_times(self, duration: float) -> FloatArray:
        """Return no times: no field is kept."""
        return np.empty(0)

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return the mechanism's facts about a run."""
        rows = self.rows(run.solution.rows)
        # Whoever wants to stop does not wait for what takes many evaluations of a fine film.
        balance = None if run.solution.failure == INTERRUPTED else self.balance
        columns = self._columns(rows)
        residual = residual_fraction(columns, self.journal)
        at_steps = _at_steps(run)
        largest = peaks_of(run.solution.t, rows, at_steps)
        law = self.case.contact.law_of(self.case.surface_pair)
        joint, pressure = self.journal.joint, largest["pressure_peak"]
        load = loading(law, joint.touch, pressure, at_steps["separation_least"])
        finer, speed = on_finer_grid(joint, joint.data(), rows), rows["omega"] * joint.geometry.radius
        damped = of_damping_pressure(pressure, finer["pressure_at_rest"])
        return ResultPart(
            columns=columns,
            fields=self._numbers(run, rows, balance, largest | at_steps),
            attributes={
                **self._facts(),
                "energy_residual": residual,
                **finer,
                **load,
                **flash_of_bushing(self.case.surfaces, law, joint, rows, speed),
            },
            warnings=[
                *warnings(
                    at_steps,
                    self.journal.joint,
                    load,
                    residual=residual,
                    grid_error=finer["grid_force_error"],
                    t_end=float(run.solution.t_end),
                    statistics=run.cost,
                    when=instant(largest["pressure_peak_time"]),
                ),
                *of_tables(self.case.followed(), run.solution.t, partial(_followed, rows)),
            ],
            notes=[*of_temperature(self.case), *([damped] if damped else [])],
            failure=self._failure(run),
        )

    def _columns(self, rows: dict[str, FloatArray]) -> dict[str, FloatArray]:
        """Return the quantities over time."""
        oil = self.journal.film is not None
        left_out = {TURNED, *(() if oil else names(FILM))}
        kept = {name: values for name, values in force_parts(rows).items() if name not in left_out}
        return kept | balance_columns(rows, lubricated=oil)

    def _facts(self) -> dict[str, object]:
        case = self.case
        facts = {
            **bushing_facts(case),
            "load_x": case.loads.force_x,
            "load_y": case.loads.force_y,
            "speed": case.journal.speed,
        }
        if case.joint.friction_coefficient > 0.0:
            facts["friction_coefficient"] = case.joint.friction_coefficient
        if case.film.lubricated:
            facts["viscosity"] = case.film.viscosity
        return facts

    def _numbers(
        self,
        run: FinishedRun,
        rows: dict[str, FloatArray],
        balance: Equilibrium | None,
        largest: Mapping[str, float],
    ) -> dict[str, FloatArray]:
        """Return the single numbers of a run, arrays of shape (); ``largest`` are peaks and extremes."""
        found = {
            "settling_time": self._settling_time(run, rows, balance),
            "contact_start": _contact_start(run, rows),
            **largest,
            "rebounds": rebounds_of(rows),
            "e_x_balance": np.nan if balance is None else float(balance.attitude[0]),
            "e_y_balance": np.nan if balance is None else float(balance.attitude[1]),
        }
        if self.journal.film is None:
            found = {name: value for name, value in found.items() if not name.startswith("film_")}
        if self.journal.speed != 0.0 and not self.journal.changes:
            found["friction_coefficient_end"] = self._friction_coefficient(rows)
        return {name: np.array(value) for name, value in found.items()}

    def _settling_time(
        self, run: FinishedRun, rows: dict[str, FloatArray], balance: Equilibrium | None
    ) -> float:
        """Return the time after which the centre stays near the static equilibrium; NaN if it never does."""
        if balance is None or not run.solution.complete:
            return np.nan
        off = portable.hypot(rows["e_x"] - balance.attitude[0], rows["e_y"] - balance.attitude[1])
        outside = np.flatnonzero(off > SETTLED * self.journal.joint.geometry.clearance)
        if not outside.size:
            return 0.0
        after = outside[-1] + 1
        return float(run.solution.t[after]) if after < run.solution.t.size else np.nan

    def _friction_coefficient(self, rows: dict[str, FloatArray]) -> float:
        """Return the friction moment over radius and load at the end."""
        force = self.journal.loads.force
        if force == 0.0 or not rows["M_jf"].size:
            return np.nan
        moment = abs(float(rows["M_jf"][-1] + rows["M_of"][-1]))
        return moment / (self.journal.joint.geometry.radius * force)

    def _failure(self, run: FinishedRun) -> str:
        """Return why the run stopped before its end, empty if it did not."""
        if run.solution.failure in (None, INTERRUPTED):
            return run.solution.failure or ""
        reached = float(run.solution.t_end)
        found = failure(run.problem, self.assembly.model, (f"{BEARING}:bushing",), reached)
        return found or str(run.solution.failure)


def _followed(rows: Mapping[str, FloatArray], table: FollowedTable) -> FloatArray:
    """Return the coordinate of a table: angle [rad], speed [rad/s], or speed of the centre [m/s]."""
    if table.over == "velocities":
        return np.asarray(portable.hypot(rows["e_x_dot"], rows["e_y_dot"]))
    return rows["omega" if table.over == "speeds" else TURNED]


def _at_steps(run: FinishedRun) -> dict[str, float]:
    """Return peaks and extremes of contact and film that kernels noted at accepted steps, by name."""
    memory = run.problem.memory
    records = [*memory.contact.peaks, *memory.oil["peaks"]]
    wanted = (*(f"{name}_peak{time}" for name in names(WATCHED) for time in ("", "_time")), *names(EXTREMES))
    return {name: float(record[name]) for record in records for name in record.dtype.names if name in wanted}


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


def _contact_start(run: FinishedRun, rows: dict[str, FloatArray]) -> float:
    """Return the first output time at which any point is in contact [s]; NaN if there is none."""
    touching = np.flatnonzero(rows["contact_fraction"] > 0.0)
    return float(run.solution.t[touching[0]]) if touching.size else np.nan


SYSTEM: Final = JournalSystem
