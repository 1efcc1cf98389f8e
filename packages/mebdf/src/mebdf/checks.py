"""Refusals and warnings of a solver class of SciPy in its own words, and why the MEBDF gave up."""

from collections.abc import Callable, Iterable, Sequence
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray
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


SMALLEST_TOLERANCE = 1.0e-299
SMALLEST_RTOL = 100.0 * float(np.finfo(np.float64).eps)
SMALLEST_ATOL = 1.0e-290
LARGEST_ATOL = 1.0e100  #: Divisors in the place of absolute tolerances of zero and of infinity.


def tolerances(rtol: ArrayLike, atol: ArrayLike, n: int) -> tuple[FloatArray, FloatArray]:
    """Return relative and absolute tolerances, each of shape (n,)."""
    relative = np.asarray(rtol, dtype=np.float64)
    if np.any(relative < SMALLEST_RTOL):
        warn(
            "At least one element of `rtol` is too small. "
            f"Setting `rtol = np.maximum(rtol, {SMALLEST_RTOL})`.",
            stacklevel=3,
        )
        relative = np.maximum(relative, SMALLEST_RTOL)
    return _vector("rtol", relative, n), _vector("atol", np.asarray(atol, dtype=np.float64), n)


def span(t0: float, t_bound: float) -> None:
    """Refuse a start or an end that is not a number."""
    if not np.isfinite(t0) or np.isnan(t_bound):
        raise ValueError(f"`t0` must be finite and `t_bound` a number, not {t0} and {t_bound}.")


def order(max_order: int, largest: int) -> int:
    """Return the largest order."""
    if max_order != int(max_order) or not 2 <= max_order <= largest:
        raise ValueError(f"`max_order` must be a whole number from 2 to {largest}, not {max_order}.")
    return int(max_order)


def bands(lower: int | None, upper: int | None, n: int) -> tuple[int, int] | None:
    """Return the numbers of diagonals below and above the main one; ``None`` if neither number is given."""
    if lower is None and upper is None:
        return None
    numbers = lower or 0, upper or 0
    for name, number in zip(("lband", "uband"), numbers, strict=True):
        if number != int(number) or not 0 <= number < max(n, 1):
            raise ValueError(f"`{name}` must be a whole number from 0 to {n - 1}, not {number}.")
    return int(numbers[0]), int(numbers[1])


def inner_times(times: ArrayLike, t0: float, t_bound: float) -> list[float]:
    """Return the times between start and end, each once, in the order in which they are met."""
    array = np.unique(np.asarray(times, dtype=np.float64))
    if np.any(np.isnan(array)):
        raise ValueError("`breakpoints` must be numbers.")
    inner: list[float] = array[(array > min(t0, t_bound)) & (array < max(t0, t_bound))].tolist()
    return inner if t_bound >= t0 else inner[::-1]


def resolved(y0: FloatArray, rtol: FloatArray, atol: FloatArray) -> None:
    """Refuse a tolerance too small for its value to be a number of full precision."""
    lost = (atol == 0.0) & (y0 != 0.0) & (rtol * np.abs(y0) < SMALLEST_TOLERANCE)
    if np.any(lost):
        i = int(np.argmax(lost))
        raise ValueError(
            f"`atol` must be positive for component {i}: with {y0[i]:g} the relative tolerance alone is "
            f"below {SMALLEST_TOLERANCE:g}; or take another unit."
        )


def sizes(y0: FloatArray, rtol: FloatArray, atol: FloatArray) -> FloatArray:
    """Return absolute tolerances that tell the sizes of the components: positive and finite, shape (n,)."""
    untested = np.maximum(np.abs(y0), 1.0) * rtol
    return np.where(atol >= LARGEST_ATOL, untested, np.maximum(atol, SMALLEST_ATOL))


def _vector(name: str, values: FloatArray, n: int) -> FloatArray:
    """Return ``values`` with shape (n,)."""
    if values.ndim > 0 and values.shape != (n,):
        raise ValueError(f"`{name}` has wrong shape.")
    if np.any(values < 0.0) or np.any(np.isnan(values)):
        raise ValueError(f"`{name}` must be positive.")
    return np.broadcast_to(values, (n,)).copy()


def largest_step(max_step: float) -> float:
    """Return the largest step."""
    if not max_step > 0:
        raise ValueError("`max_step` must be positive.")
    return float(max_step)


def starting_step(first_step: float | None, t0: float, t_bound: float) -> float:
    """Return the first step, 0 if the method is to choose it."""
    if first_step is None:
        return 0.0
    if not first_step > 0:
        raise ValueError("`first_step` must be positive.")
    if first_step > abs(t_bound - t0):
        raise ValueError("`first_step` exceeds bounds.")
    return float(first_step)


def warn_extraneous(names: Iterable[str]) -> None:
    """Warn of arguments that have no effect."""
    if listed := ", ".join(f"`{name}`" for name in names):
        warn(f"The following arguments have no effect for a chosen solver: {listed}.", stacklevel=3)
