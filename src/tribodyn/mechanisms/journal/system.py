"""A case of the journal as a system to integrate, and what its runs tell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.cases.beyond import FollowedTable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, Stopped
from tribodyn.core.problem import Problem
from tribodyn.core.quantities import names
from tribodyn.core.signals import constant
from tribodyn.integrate import INTERRUPTED
from tribodyn.kernels.journal.quantities import FILM, OBSERVED, WATCHED
from tribodyn.lubrication import explain
from tribodyn.mechanisms.base import FinishedRun, ResultPart, Worn
from tribodyn.mechanisms.bushing import (
    bushing_facts,
    bushing_of,
    force_parts,
    grid_force_error,
    loading,
    of_temperature,
    pressure_at_rest,
)
from tribodyn.mechanisms.checks import (
    beyond_law,
    extremes,
    instant,
    of_clearance,
    of_damping_pressure,
    of_tables,
)
from tribodyn.mechanisms.flash import flash_of_bushing
from tribodyn.mechanisms.journal.case import JournalCase
from tribodyn.mechanisms.journal.checks import warnings
from tribodyn.mechanisms.journal.course import angle
from tribodyn.mechanisms.journal.equilibrium import Equilibrium, equilibrium
from tribodyn.mechanisms.journal.ledger import ledger_columns, residual_fraction
from tribodyn.mechanisms.journal.loads import terms_of
from tribodyn.mechanisms.journal.parameters import Journal, Loads
from tribodyn.mechanisms.journal.problem import journal_problem
from tribodyn.mechanisms.peaks import of_run

SETTLED: Final = 0.01
"""Distance from the static equilibrium, over the clearance, within which a journal has settled."""


def journal_of(case: JournalCase) -> Journal:
    """Return the journal that a case describes."""
    shaft, loads, joint = case.journal, case.loads, bushing_of(case)
    return Journal(
        mass=shaft.mass,
        transverse_inertia=shaft.transverse_inertia,
        spin_inertia=shaft.spin_inertia,
        tilts=shaft.tilt,
        speed=shaft.speed,
        spin=None if case.drive.speed is None else case.drive.speed.curve(),
        terms=tuple(terms_of(case)),
        slip_velocity=case.slip_velocity,
        loads=Loads(loads.force_x, loads.force_y, loads.moment_x, loads.moment_y),
        joint=joint,
        film=case.film.film(joint.geometry, case.surfaces) if case.film.lubricated else None,
    )


@dataclass(frozen=True)
class JournalSystem:
    """The journal of a case; see :class:`~tribodyn.mechanisms.base.SimulatedSystem`."""

    case: JournalCase

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
        return journal_problem(
            self.journal, duration=duration, start=start, atol=self.case.solver.atol.as_tuple
        )

    def output_times(self, duration: float) -> FloatArray:
        """Return the times of the rows [s], uniform, the end included."""
        times = np.arange(0.0, duration, self.case.run.output_interval)
        return np.append(times[times < duration * (1.0 - 1.0e-9)], duration)

    def picture_times(self, duration: float) -> FloatArray:
        """Return no times: no field is kept."""
        return np.empty(0)

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return what the mechanism knows about a run."""
        rows = run.rows(OBSERVED)
        # Whoever wants to stop does not wait for what takes many evaluations of a fine film.
        balance = None if run.solution.failure == INTERRUPTED else self.balance
        columns = self._columns(rows)
        residual = residual_fraction(columns, self.journal)
        grid_error = grid_force_error(self.journal.joint, rows)
        found = run.problem.memory.joint.extremes
        largest = of_run(run.problem.memory.peaks, WATCHED)
        law = self.case.contact.law_of(self.case.surface_pair)
        joint, pressure = self.journal.joint, largest["pressure_peak"]
        load = loading(law, joint.touch, pressure, float(found.separation_least))
        at_rest, speed = pressure_at_rest(joint, rows), rows["omega"] * joint.geometry.radius
        damped = of_damping_pressure(pressure, at_rest)
        return ResultPart(
            columns=columns,
            fields=self._numbers(run, rows, balance),
            attributes={
                **self._facts(),
                "energy_residual": residual,
                "grid_force_error": grid_error,
                "pressure_at_rest": at_rest,
                **load,
                **flash_of_bushing(self.case.surfaces, law, joint, rows, speed),
            },
            warnings=[
                *warnings(
                    found,
                    self.journal.joint,
                    load,
                    residual=residual,
                    grid_error=grid_error,
                    t_end=float(run.solution.t_end),
                    statistics=run.cost,
                    when=instant(largest["pressure_peak_time"]),
                ),
                *of_tables(
                    self.case.followed(), run.solution.t, partial(self._followed, rows, run.solution.t)
                ),
            ],
            notes=[*of_temperature(self.case), *([damped] if damped else [])],
            failure=self._failure(run),
        )

    def _followed(
        self, rows: Mapping[str, FloatArray], times: FloatArray, table: FollowedTable
    ) -> FloatArray:
        """Return what a table follows at times [s]: angle [rad], speed [rad/s], or speed of the centre."""
        if table.over == "speeds":
            return np.asarray(rows["omega"])
        if table.over == "velocities":
            return np.asarray(portable.hypot(rows["e_x_dot"], rows["e_y_dot"]))
        spin = self.journal.spin
        return angle(constant(self.journal.speed) if spin is None else spin, times)

    def _columns(self, rows: dict[str, FloatArray]) -> dict[str, FloatArray]:
        """Return what is stored over time."""
        oil = self.journal.film is not None
        kept = {name: values for name, values in force_parts(rows).items() if oil or name not in names(FILM)}
        return kept | ledger_columns(rows, lubricated=oil)

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
        self, run: FinishedRun, rows: dict[str, FloatArray], balance: Equilibrium | None
    ) -> dict[str, FloatArray]:
        """Return what a run has one of, arrays of shape ()."""
        found = {
            "settling_time": self._settling_time(run, rows, balance),
            "contact_start": _contact_start(run, rows),
            **of_run(run.problem.memory.peaks, WATCHED),
            **extremes(run.problem.memory.joint.extremes, run.problem.memory.counts),
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
        memory, reason = run.problem.memory, str(run.solution.failure)
        if memory.course.beyond > 0.0:
            return beyond_law(self.journal.joint.table.h_first, run.solution.t_end, "journal and bushing")
        if memory.scratch.film_status > 0.0:
            reason += f"; the film had no answer: {explain(int(memory.scratch.film_status))}"
        return reason


def _contact_start(run: FinishedRun, rows: dict[str, FloatArray]) -> float:
    """Return the first output time at which any point is in contact [s]; NaN if there is none."""
    touching = np.flatnonzero(rows["contact_fraction"] > 0.0)
    return float(run.solution.t[touching[0]]) if touching.size else np.nan


SYSTEM: Final = JournalSystem
