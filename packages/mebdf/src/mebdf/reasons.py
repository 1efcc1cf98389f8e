"""Why the MEBDF gave up, in words."""

from collections.abc import Callable, Sequence

import numpy as np

from mebdf.kernels import phases
from mebdf.kernels import state as entry
from mebdf.kernels.state import MebdfState

LATEST = 1.0e300  #: Time beyond which a step may lead out of the numbers.


def reason(
    state: MebdfState, names: Sequence[str], entry_not_finite: Callable[[MebdfState], tuple[int, int]]
) -> str:
    """Return the reason of a failure: what went wrong, and in which state.

    ``state``: after ``resume`` has returned FAILED; ``names``: names of the states; ``entry_not_finite``:
    tells row and column of the first entry of the Jacobian that is not finite.
    """
    if state.number("reason") == phases.JACOBIAN_NOT_FINITE:
        row, column = entry_not_finite(state)
        return f"the Jacobian entry d(rate of {names[row]})/d({names[column]}) is not finite"
    if state.number("cause") == phases.SINGULAR and state.number("worst") >= 0:
        return f"the matrix of Newton's iteration is singular{_undetermined(state, names)}"
    rows, worst = state.rows, state.number("worst")
    without = (rows[entry.ATOL] == 0.0) & (rows[entry.HISTORY] == 0.0) & (rows[entry.F_1] != 0.0)
    if without.any():
        name = names[int(np.argmax(without))]
        return f"{name} is 0, where its relative tolerance allows no error; give it an absolute one"
    if abs(state.number("t")) > LATEST:
        return "no end was met before the largest number; give a finite end or an event that ends"
    if state.number("reason") == phases.NO_PROGRESS:
        return (
            f"Newton's iteration fails again and again, worst in {names[worst]}, with hardly any progress: "
            "the rates jump there or the Jacobian is wrong"
        )
    text = "the step became shorter than the spacing between numbers"
    if (bad := state.number("bad")) >= 0:
        return f"{text}; the rate of {names[bad]} was not finite at t = {state.number('t_bad'):.9g}"
    if worst >= 0:
        cause = (
            "Newton's iteration did not converge"
            if state.number("cause") == phases.NEWTON
            else "the error stayed above the tolerance"
        )
        return f"{text}; {cause}, worst in {names[worst]}{_cure(state, names)}"
    newest = state.rows[entry.HISTORY + state.number("k_last") + 1]
    fastest = int(np.argmax(np.abs(newest * state.rows[entry.WEIGHT])))
    return f"{text}; the solution changes fastest in {names[fastest]}"


def _undetermined(state: MebdfState, names: Sequence[str]) -> str:
    """Return, in words, which state the equations do not determine, where that can be found."""
    if not state.matrices.size:
        return ": the equations do not determine all states"
    n = state.rows.shape[1]
    matrix = -state.number("scaled") * state.matrices[entry.LAST_JACOBIAN]
    if state.places.size:
        row, size = np.repeat(np.arange(n), np.diff(state.places[: n + 1])), state.places[n]
        matrix[row, state.places[n + 1 : n + 1 + size]] += state.mass[:size]
    else:
        matrix += np.eye(n)
    if not np.isfinite(matrix).all() or not matrix.any():
        return ": the equations do not determine all states"
    direction = np.linalg.svd(matrix / np.abs(matrix).max())[2][-1]
    name = names[int(np.argmax(np.abs(direction)))]
    return f": the equations do not determine {name}; see to them, the mass matrix and the index"


def _cure(state: MebdfState, names: Sequence[str]) -> str:
    """Return, in words, what helps where the error test of an algebraic variable failed."""
    worst, n = state.number("worst"), state.rows.shape[1]
    if state.number("cause") != phases.ERROR_TEST or not state.rows[entry.TESTED, worst]:
        return ""
    size = state.places[n]
    if worst in state.places[n + 1 : n + 1 + size][state.mass[:size] != 0.0]:
        return ""
    return f"; if {names[worst]} jumps, `test_algebraic=False` leaves it out of the error test"
