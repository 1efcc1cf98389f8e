"""One run of one case: its system integrated, and what came of it as a dataset."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from tribodyn.core.platforms import provenance
from tribodyn.core.problem import Problem, Solution, Stop, skipped
from tribodyn.core.remembered import digest
from tribodyn.integrate import INTERRUPTED, integrate
from tribodyn.kernels.jit import made_by
from tribodyn.mechanisms.bushing import Worn
from tribodyn.mechanisms.mechanism_protocol import (
    FinishedRun,
    MechanismDescriptor,
    ResultPart,
    SimulatedSystem,
    SystemCase,
)
from tribodyn.results import build
from tribodyn.results.dataset import ASSUMED_WEAR, DATA_HASH, ROWS_HASH, WEAR_SCATTER
from tribodyn.simulation import session as hashes

if TYPE_CHECKING:
    import xarray as xr

Progress = Callable[[float], None] | None  #: Called with the simulated time [s] after every accepted step.


@dataclass(frozen=True)
class Session:
    """A case, its mechanism and its system, with what watches over the run."""

    #: What is simulated.
    case: SystemCase
    mechanism: MechanismDescriptor
    system: SimulatedSystem
    #: As for :func:`tribodyn.simulation.simulate`.
    progress: Progress = None
    stop: Stop = None
    notes: tuple[str, ...] = ()  #: Remarks on the case that it does not make itself.

    def integrated(self, duration: float, worn: Worn | None = None, progress: Progress = None) -> FinishedRun:
        """Integrate the system over ``duration`` [s] from its start, or from where another run ended."""
        system, solver = self.system, self.case.solver
        problem = system.problem(duration, worn)
        times = system.output_times(duration), system.picture_times(duration)
        data = hashes.of_data(problem, *times, solver.rtol, solver.name)
        solution = integrate(
            problem,
            solver=solver.name,
            rtol=solver.rtol,
            output_times=times[0],
            picture_times=times[1],
            progress=progress or self.progress,
            stop=self.stop,
        )
        carried = worn is not None and worn.carried is not None
        found = {DATA_HASH: data, ROWS_HASH: hashes.of_rows(solution)}
        return FinishedRun(problem, solution, vars(solution.statistics), carried, found)

    def dataset(self, run: FinishedRun, more: ResultPart) -> "xr.Dataset":
        """Return the result of a run, with what was added to it."""
        part = self.system.gather(run)
        solver, said = self.case.solver, self.case.remarks()
        # Without what was skipped a result is not whole, whatever its run reached.
        failure = part.failure or more.failure or (INTERRUPTED if skipped() else "")
        return build(
            variables=self.mechanism.variables,
            coordinates={"time": run.solution.t, **part.coordinates, **more.coordinates},
            columns={**part.columns, **more.columns},
            fields={**part.fields, **more.fields},
            attributes={
                "title": self.case.title,
                "kind": self.mechanism.kind,
                "case": self.case.to_toml(),
                **provenance(),
                "machine_code": made_by(),
                **run.hashes,
                "solver": {"name": solver.name, "rtol": solver.rtol, **run.cost},
                **part.attributes,
                **more.attributes,
                ASSUMED_WEAR: list(self.case.assumed_wear()),
                **{
                    name: {joint: ends[k] for joint, ends in self.case.wear_scatter().items()}
                    for k, name in enumerate(WEAR_SCATTER)
                },
                "time_reached": float(run.solution.t_end),
                "failure": failure,
                "warnings": [*said.warnings, *part.warnings, *more.warnings],
                "notes": [*said.notes, *self.notes, *part.notes, *more.notes],
            },
        )


def of_data(problem: Problem, *more: Any) -> str:
    """Return the hash of all that a run reads: constants, tables, start, times and tolerances.

    ``problem``: before it is integrated; ``more``: what the integrator is given besides: numbers, texts and
    arrays.
    """
    bounds = problem.t_span, problem.breakpoints, problem.longest_step
    return digest(problem.data, problem.y0, problem.atol, *bounds, *more)


def of_rows(solution: Solution) -> str:
    """Return the hash of the rows at output times, and of the state at the end."""
    return digest(solution.t, solution.rows, solution.t_end, solution.y_end)
