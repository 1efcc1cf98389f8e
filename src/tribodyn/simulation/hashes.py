"""SHA-256 of what a run is computed from and of its rows: equal hashes mean equal numbers to the last bit."""

from __future__ import annotations

from typing import Any

from tribodyn.core.digests import digest
from tribodyn.core.problem import Problem, Solution


def of_data(problem: Problem, *more: Any) -> str:
    """Return the hash of all that a run reads: constants, tables, start, times and tolerances.

    Parameters
    ----------
    problem
        Before it is integrated.
    more
        What the integrator is given besides: numbers, texts and arrays.
    """
    bounds = problem.t_span, problem.breakpoints, problem.longest_step
    return digest(problem.data, problem.y0, problem.atol, *bounds, *more)


def of_rows(solution: Solution) -> str:
    """Return the hash of the rows at output times, and of the state at the end."""
    return digest(solution.t, solution.rows, solution.t_end, solution.y_end)
