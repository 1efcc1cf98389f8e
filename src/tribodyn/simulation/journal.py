"""Simulation of the journal: the contact laws of a case one after the other, side by side in one result."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.cases.journal import Journal as JournalCase
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import Problem, Solution
from tribodyn.core.quantities import names
from tribodyn.integrate import INTERRUPTED, integrate
from tribodyn.kernels.journal.quantities import FILM, OBSERVED
from tribodyn.lubrication import Film, FilmGrid, Roughness, explain
from tribodyn.mechanisms.journal import Equilibrium, Journal, Loads, equilibrium, journal_problem
from tribodyn.results import build
from tribodyn.simulation.checks import grid_force_error
from tribodyn.simulation.joint import joint
from tribodyn.simulation.journal_checks import warnings
from tribodyn.simulation.journal_ledger import ledger_columns, residual_fraction
from tribodyn.simulation.provenance import provenance

NOT_STORED: Final = ("work_", "heat_")
"""Observed quantities that reach the user under the names of the ledger instead."""
SETTLED: Final = 0.01
"""Distance from the static equilibrium, over the clearance, within which a journal has settled."""


def simulate_journal(
    case: JournalCase,
    *,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> xr.Dataset:
    """Simulate a ``journal`` case, see :func:`tribodyn.simulation.simulate`."""
    prepared = [_prepared(case, law) for law in case.laws]
    runs = []
    for number, (journal, problem) in enumerate(prepared):
        solution = integrate(
            problem,
            solver=case.solver.name,
            rtol=case.solver.rtol,
            output_times=_output_times(case),
            progress=_share(progress, number, len(prepared), case.duration),
            stop=stop,
        )
        runs.append(_Run(case.laws[number], journal, problem, solution, _balance(journal)))
        if solution.failure == INTERRUPTED:
            break
    return _dataset(case, runs)


def journal_of(case: JournalCase, law: str | None = None) -> Journal:
    """Return the journal that a case describes.

    Parameters
    ----------
    case
        The case.
    law
        Name of the contact law; that of ``contact.law`` by default.
    """
    shaft, loads = case.journal, case.loads
    return Journal(
        mass=shaft.mass,
        transverse_inertia=shaft.transverse_inertia,
        spin_inertia=shaft.spin_inertia,
        tilts=shaft.tilt,
        speed=shaft.speed,
        loads=Loads(loads.force_x, loads.force_y, loads.moment_x, loads.moment_y),
        joint=joint(case, law),
        film=_film(case),
    )


def _film(case: JournalCase) -> Film | None:
    """Return the oil film of a case, if there is oil."""
    film, size, surfaces = case.film, case.joint, case.surfaces
    if not film.lubricated:
        return None
    rms = (surfaces.trunnion.roughness, surfaces.bushing.roughness) if film.rough_flow else (0.0, 0.0)
    return Film(
        viscosity=film.viscosity,
        clearance=size.clearance,
        radius=size.radius,
        length=size.length,
        roughness=Roughness(rms, (film.peklenik_journal, film.peklenik_bushing)),
        cavitation=film.cavitation,
        boundary=film.boundary,
        grid=FilmGrid(film.grid.theta, film.grid.z),
    )


def _prepared(case: JournalCase, law: str) -> tuple[Journal, Problem]:
    """Return journal and problem of one contact law."""
    journal, run, atol = journal_of(case, law), case.run, case.solver.atol
    start = np.array([run.start_x, run.start_y, 0.0, 0.0])
    if run.start == "equilibrium":
        start = equilibrium(journal).attitude
    problem = journal_problem(
        journal,
        duration=case.duration,
        start=start,
        atol=(atol.position, atol.tilt, atol.velocity, atol.tilt_rate),
    )
    return journal, problem


def _output_times(case: JournalCase) -> FloatArray:
    """Return the times of the rows [s], uniform, the end included."""
    times = np.arange(0.0, case.duration, case.run.output_interval)
    return np.append(times[times < case.duration * (1.0 - 1.0e-9)], case.duration)


def _share(
    progress: Callable[[float], None] | None, number: int, total: int, duration: float
) -> Callable[[float], None] | None:
    """Return a progress of one run of several that together count as one ``duration`` [s]."""
    if progress is None:
        return None
    return lambda reached: progress((number * duration + reached) / total)


def _balance(journal: Journal) -> Equilibrium | None:
    """Return the static equilibrium, or nothing where there is none."""
    try:
        return equilibrium(journal)
    except InputError:
        return None


@dataclass(frozen=True)
class _Run:
    """The run of one contact law."""

    law: str
    journal: Journal
    problem: Problem
    solution: Solution
    balance: Equilibrium | None

    @property
    def rows(self) -> dict[str, FloatArray]:
        """Observed quantities by name, each of shape (n_t,)."""
        return {name: self.solution.rows[:, i] for i, name in enumerate(OBSERVED)}

    @property
    def failure(self) -> str:
        """Why the run stopped before its end, empty if it did not."""
        if self.solution.failure in (None, INTERRUPTED):
            return self.solution.failure or ""
        memory, reason = self.problem.memory, str(self.solution.failure)
        if memory.course.beyond > 0.0:
            reason = (
                f"stopped at t = {self.solution.t_end:.6g} s: the surfaces came closer than the contact law "
                f"reaches ({self.journal.joint.table.h_first:g} sigma); load or impact is too much for it"
            )
        elif memory.scratch.film_status > 0.0:
            reason += f"; the film had no answer: {explain(int(memory.scratch.film_status))}"
        return f"{self.law}: {reason}"

    def columns(self) -> dict[str, FloatArray]:
        """Return what is stored over time."""
        rows = self.rows
        kept = {name: values for name, values in rows.items() if not name.startswith(NOT_STORED)}
        if self.journal.film is None:
            kept = {name: values for name, values in kept.items() if name not in names(FILM)}
        kept["F_dx"] = rows["F_cx"] - rows["F_kx"]
        kept["F_dy"] = rows["F_cy"] - rows["F_ky"]
        kept["friction_power"] = -rows["friction_power"]
        return kept | ledger_columns(rows, lubricated=self.journal.film is not None)

    def numbers(self) -> dict[str, float]:
        """Return what a run has one of."""
        joint, journal = self.problem.memory.joint.peaks, self.problem.memory.peaks
        found = {
            "settling_time": self._settling_time(),
            "contact_start": self._contact_start(),
            "rebounds": float(journal.rebounds),
            "contact_force_peak": float(joint.contact_force_peak),
            "contact_force_peak_time": float(joint.contact_force_peak_time),
            "pressure_peak": float(joint.pressure_peak),
            "separation_least": float(joint.separation_least),
            "e_x_balance": np.nan if self.balance is None else float(self.balance.attitude[0]),
            "e_y_balance": np.nan if self.balance is None else float(self.balance.attitude[1]),
            "residual_fraction": residual_fraction(self.rows, self.journal),
        }
        if self.journal.film is not None:
            found["film_force_peak"] = float(journal.film_force_peak)
        if self.journal.speed != 0.0:
            found["friction_coefficient_end"] = self._friction_coefficient()
        return found

    def _settling_time(self) -> float:
        """Return the time after which the centre stays near the static equilibrium; NaN if it never does."""
        if self.balance is None or not self.solution.complete:
            return np.nan
        rows = self.rows
        off = np.hypot(rows["e_x"] - self.balance.attitude[0], rows["e_y"] - self.balance.attitude[1])
        outside = np.flatnonzero(off > SETTLED * self.journal.joint.geometry.clearance)
        if not outside.size:
            return 0.0
        after = outside[-1] + 1
        return float(self.solution.t[after]) if after < self.solution.t.size else np.nan

    def _contact_start(self) -> float:
        """Return the first output time at which any point is in contact; NaN if there is none."""
        touching = np.flatnonzero(self.rows["contact_fraction"] > 0.0)
        return float(self.solution.t[touching[0]]) if touching.size else np.nan

    def _friction_coefficient(self) -> float:
        """Return the friction moment over radius and load at the end."""
        force, rows = self.journal.loads.force, self.rows
        if force == 0.0 or not self.solution.t.size:
            return np.nan
        moment = abs(float(rows["M_jf"][-1] + rows["M_of"][-1]))
        return moment / (self.journal.joint.geometry.radius * force)


def _dataset(case: JournalCase, runs: list[_Run]) -> xr.Dataset:
    """Return the runs side by side; where one stopped earlier than another its values are NaN."""
    longest = max(runs, key=lambda run: run.solution.t.size)
    columns = [run.columns() for run in runs]
    numbers = [run.numbers() for run in runs]
    size = longest.solution.t.size
    return build(
        coordinates={"law": np.array([run.law for run in runs]), "time": longest.solution.t},
        columns={name: np.array([_padded(of[name], size) for of in columns]) for name in columns[0]}
        | {name: np.array([of[name] for of in numbers]) for name in numbers[0]},
        attributes=_attributes(case, runs),
    )


def _padded(values: FloatArray, size: int) -> FloatArray:
    return np.append(values, np.full(size - values.size, np.nan))


def _attributes(case: JournalCase, runs: list[_Run]) -> dict[str, object]:
    journal = runs[0].journal
    grid_error = max(grid_force_error(run.journal.joint, run.rows) for run in runs)
    residual = max(residual_fraction(run.rows, run.journal) for run in runs)
    reached = [float(run.solution.t_end) for run in runs] + [0.0] * (len(case.laws) - len(runs))
    facts: dict[str, Any] = {
        "title": case.title,
        "kind": case.kind(),
        "case": case.to_toml(),
        **provenance(),
        "solver": _solver(case, runs),
        "contact_law": ", ".join(run.law for run in runs),
        "clearance": case.joint.clearance,
        "roughness": journal.joint.roughness,
        "joint_length": case.joint.length,
        "load_x": case.loads.force_x,
        "load_y": case.loads.force_y,
        "speed": case.journal.speed,
        "energy_residual": residual,
        "grid_force_error": grid_error,
        "time_reached": min(reached),
        "failure": "; ".join(_failures(runs)),
        "warnings": [text for run in runs for text in _warnings(run)],
    }
    if case.joint.friction_coefficient > 0.0:
        facts["friction_coefficient"] = case.joint.friction_coefficient
    if case.film.lubricated:
        facts["viscosity"] = case.film.viscosity
    return facts


def _failures(runs: Iterable[_Run]) -> list[str]:
    return [run.failure for run in runs if run.failure]


def _warnings(run: _Run) -> list[str]:
    return [
        f"{run.law}: {text}"
        for text in warnings(
            run.problem.memory.joint.peaks,
            run.journal.joint,
            residual=residual_fraction(run.rows, run.journal),
            grid_error=grid_force_error(run.journal.joint, run.rows),
            t_end=float(run.solution.t_end),
            statistics=vars(run.solution.statistics),
        )
    ]


def _solver(case: JournalCase, runs: list[_Run]) -> dict[str, object]:
    """Return name, tolerance and what all runs together cost."""
    costs = [vars(run.solution.statistics) for run in runs]
    total = {name: sum(cost[name] for cost in costs) for name in costs[0]}
    return {"name": case.solver.name, "rtol": case.solver.rtol, **total}
