"""Integrators: every one of them runs a :class:`~tribodyn.core.problem.Problem` by the same rules."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from tribodyn.core.errors import InputError
from tribodyn.core.problem import Problem, Solution
from tribodyn.integrate.driver import INTERRUPTED, IntegrationTask, Integrator, Stepwise
from tribodyn.integrate.following import make_schedule
from tribodyn.integrate.mebdf import MEBDF as COMPILED_MEBDF
from tribodyn.integrate.scipy_steps import BDF, CVODE, LSODA, RADAU

if TYPE_CHECKING:
    from mebdf import MEBDF

__all__ = ["INTERRUPTED", "MEBDF", "SOLVERS", "integrate"]

#: All integrators by name.
SOLVERS: Final[dict[str, Integrator]] = {
    "mebdf": COMPILED_MEBDF,
    "bdf": Stepwise(BDF),
    "radau": Stepwise(RADAU),
    "lsoda": Stepwise(LSODA),
    "cvode": Stepwise(CVODE),
}


def __getattr__(name: str) -> Any:
    """Import the solver class for SciPy when it is asked for: SciPy and numba take a while."""
    if name == "MEBDF":
        from mebdf import MEBDF

        return MEBDF
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def integrate(
    problem: Problem,
    *,
    solver: str = "mebdf",
    rtol: float = 1e-4,
    output_times: ArrayLike = (),
    picture_times: ArrayLike = (),
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Solution:
    """Integrate a problem with memory over its time span.

    Parameters
    ----------
    problem
        What to integrate. Its memory is changed in place.
    solver
        A key of ``SOLVERS``.
    rtol
        Relative tolerance; the absolute ones belong to the problem.
    output_times, picture_times
        When to call ``observe`` and ``picture`` [s]: increasing, inside the time span.
    progress
        Called with the simulated time [s] after accepted steps, by compiled ``mebdf`` ten times a second.
    stop
        Asked whenever ``progress`` is called; when true, the run ends with the failure
        ``"interrupted"``.

    Returns
    -------
    Solution
        What was reached. A run that fails midway is no exception but a ``Solution``
        whose ``failure`` holds the reason. Its times have the shape (n,), its rows (n, m) for the m
        quantities that the problem observes.

    Raises
    ------
    InputError
        There is no such solver, a tolerance is out of its range, times do not increase inside the span, or
        the solver takes no mass matrix.
    """
    if solver not in SOLVERS:
        raise InputError(f"unknown solver {solver!r}; choose one of {', '.join(SOLVERS)}", key="solver.name")
    if not 0.0 < rtol < 1.0:
        raise InputError(f"rtol must lie between 0 and 1, not {rtol}", key="solver.rtol")
    if problem.atol.shape != problem.y0.shape or not np.all(problem.atol > 0.0):
        raise InputError("every state needs an absolute tolerance above zero", key="solver.atol")
    if problem.mass is not None and solver != "mebdf":
        raise InputError(f"{solver!r} takes no mass matrix; choose mebdf", key="solver.name")
    schedule = make_schedule(problem.t_span, problem.breakpoints, output_times, picture_times)
    if problem.solved is not None:
        return problem.solved(schedule.output_times, schedule.picture_times, progress)
    return SOLVERS[solver](IntegrationTask(problem, schedule, rtol, progress, stop))
