"""The loop around the MEBDF core: evaluations, Jacobians, and the walk over accepted steps.

The compiled counterpart of ``tribodyn.integrate.driver``, with the same order of calls. One source serves
compiled problems and those in plain Python.
"""

import hashlib
import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any, Final, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray, FloatMatrix, IntArray, IntMatrix
from mebdf.compiled.kernel import ENTRIES, Kernel, enlisted
from mebdf.compiled.layouts import Absent, Array, Layouts, Tuple, of_hint
from mebdf.kernels import state as at
from mebdf.kernels.core import resume
from mebdf.kernels.history import state_at
from mebdf.kernels.jit import copy
from mebdf.kernels.matrix import is_algebraic, magnitude_of_mass
from mebdf.kernels.phases import FAILED, NEED_F, NEED_FACTORS, NEED_JACOBIAN, NEED_MAGNITUDE, NEED_SOLUTION
from mebdf.kernels.state import ATOL, DELTA, MAGNITUDE, RESIDUAL, RTOL, MebdfState, Y
from tribodyn.kernels.jit import SOURCES, entry


class OwnMatrix(NamedTuple):
    """Work arrays of a problem's own algebra."""

    places: IntMatrix  #: Row and column of the first entries of the Jacobian, shape (2, n), n ≤ n_entries.
    jacobian: FloatArray  #: Entries as filled in, shape (n_entries,).
    #: Those in use: the last ones that were finite, or those before them, shape (n_entries,).
    last: FloatArray
    previous: FloatArray  #: The finite ones before the last, shape (n_entries,).
    #: What the problem's ``factorise`` leaves for its ``solve``.
    factors: FloatArray
    pivots: IntArray


@entry
def take_over(own: OwnMatrix, back: int) -> bool:
    """Keep a new Jacobian if it is finite, and the newest before it; return whether it is."""
    total = 0.0
    for i in range(own.jacobian.size):
        total += own.jacobian[i]
    if not math.isfinite(total):
        return False
    if back == 0:
        copy(own.last, own.previous)
    copy(own.jacobian, own.last)
    return True


@entry
def trace(own: OwnMatrix) -> float:
    """Return the trace of the Jacobian in use, as far as its entries have places."""
    total = 0.0
    for k in range(own.places.shape[1]):
        if own.places[0, k] == own.places[1, k]:
            total += own.last[k]
    return total


@entry
def magnify(
    own: OwnMatrix, rows: FloatMatrix, mass: FloatArray, places: NDArray[np.int64], scaled: float
) -> None:
    """Fill the row MAGNITUDE, as :func:`mebdf.kernels.matrix.magnify` does."""
    for i in range(rows.shape[1]):
        rows[MAGNITUDE, i] = magnitude_of_mass(rows, mass, places, i)
    for k in range(own.places.shape[1]):
        i, j = own.places[0, k], own.places[1, k]
        size = abs(rows[Y, j])
        if places.size > 0 and is_algebraic(places, i):
            size += rows[ATOL, j] / rows[RTOL, j]
        rows[MAGNITUDE, i] += abs(scaled * own.last[k]) * size


@entry
def set_right_side(rows: FloatMatrix, places: NDArray[np.int64], scaled: float) -> None:
    """Copy the row RESIDUAL to DELTA, for a matrix that has the step in algebraic equations, too."""
    for i in range(rows.shape[1]):
        factor = scaled if places.size > 0 and is_algebraic(places, i) else 1.0
        rows[DELTA, i] = factor * rows[RESIDUAL, i]


ENDED: Final = 0
PAUSED: Final = 1

# When to pause.
AFTER_STEP: Final = 1
AFTER_EVALUATION: Final = 2

# Entries of ``Marks.position``.
NEXT_MARK: Final = 0
N_OUTPUTS: Final = 1
N_PICTURES: Final = 2
N_STEPS: Final = 3
WINDOW: Final = 4
SKIPPED: Final = 5


class Marks(NamedTuple):
    """Schedule of outputs and pictures, and those taken."""

    times: FloatArray  #: Times of outputs and pictures [s], shape (n_marks + 1,), the last one infinite.
    #: What is taken at each mark, shape (n_marks,).
    is_output: NDArray[np.bool_]
    is_picture: NDArray[np.bool_]
    tolerance: FloatArray  #: Times closer than this are the same [s], shape (1,).
    rows: FloatMatrix  #: Observed quantities, shape (n_outputs, n_observed).
    pictures: FloatArray  #: Fields, shape (n_pictures, ...).
    #: Stretches in which steps give rows, too [s], shape (n_windows + 1, 2), the last one at infinity.
    windows: FloatMatrix
    #: Times [s] and rows of these steps since the last pause, shapes (n,) and (n, n_observed); when they are
    #: full, the loop pauses.
    step_times: FloatArray
    step_rows: FloatMatrix
    #: Next mark, rows taken, pictures taken, steps that gave rows since the last pause, the first window that
    #: is not over, and how many of its steps gave none since the last one that did.
    position: IntArray
    stride: IntArray  #: Every how many steps in a window give a row, shape (1,).
    wanted: FloatArray  #: Above zero where the step gives one in any case, shape (1,).
    reached: FloatArray  #: Time up to which the accepted step has been walked [s], shape (1,).
    end: FloatArray  #: State at the end of a part of a step, shape (n,).


@entry
def _is_followed(
    windows: FloatMatrix, position: IntArray, stride: IntArray, wanted: FloatArray, t: float
) -> bool:
    """Tell whether the step that ends at ``t`` gives a row."""
    while windows[position[WINDOW], 1] < t:
        position[WINDOW] += 1
    if windows[position[WINDOW], 0] > t:
        return False
    position[SKIPPED] += 1
    if position[SKIPPED] < stride[0] and wanted[0] == 0.0:
        return False
    position[SKIPPED] = 0
    wanted[0] = 0.0
    return True


@cache
def loop(
    rhs: Callable[..., None],
    jac: Callable[..., None],
    advance: Callable[..., None],
    accept: Callable[..., None],
    observe: Callable[..., None],
    picture: Callable[..., None],
    factorise: Callable[..., int] | None = None,
    solve: Callable[..., None] | None = None,
) -> Callable[..., int]:
    """Return the loop over the steps of a problem with these functions, compiled if all of them are."""

    def run(
        state: MebdfState,
        data: Any,
        memory: Any,
        jacobian: FloatArray,
        own: OwnMatrix | None,
        marks: Marks,
        pause: IntArray,
    ) -> int:
        """Integrate until the end or until ``pause[0]``, zero for not at all; return ENDED, PAUSED or FAILED.

        Another thread may ask for the pause. Called again, the loop goes on to the same bits, for all that it
        needs stands in its arguments.
        """
        record, rows, matrices, pivots, mass, places = state
        numbers = record[0]
        y, f, newest = rows[at.Y], rows[at.F], rows[at.HISTORY]
        times, position, reached = marks.times, marks.position, marks.reached
        end, tolerance = marks.end, marks.tolerance[0]
        while True:
            request = resume(record, rows, matrices, pivots, mass, places)
            if request == NEED_F:
                rhs(numbers.t_eval, y, data, memory, f)
                if pause[0] == AFTER_EVALUATION:
                    return PAUSED
                continue
            if request == NEED_JACOBIAN:
                jacobian.fill(0.0)
                jac(numbers.t_eval, y, data, memory, f, jacobian)
                if own is not None:
                    numbers.finite = take_over(own, numbers.back)
                if pause[0] == AFTER_EVALUATION:
                    return PAUSED
                continue
            if request == FAILED:
                return FAILED
            if own is not None and factorise is not None and solve is not None:
                if request == NEED_FACTORS:
                    if numbers.back > 0:
                        copy(own.previous, own.last)
                    numbers.trace_of_j = trace(own)
                    numbers.sign = factorise(numbers.scaled, data, own.last, own.factors, own.pivots)
                    continue
                if request == NEED_SOLUTION:
                    set_right_side(rows, places, numbers.scaled)
                    solve(data, own.factors, own.pivots, rows[at.DELTA])
                    continue
                if request == NEED_MAGNITUDE:
                    magnify(own, rows, mass, places, numbers.scaled)
                    continue
            t = numbers.t
            ended = taken = False
            while not ended:
                mark = position[NEXT_MARK]
                inside = times[mark] < t - tolerance
                ended = not inside
                t_part = times[mark] if inside else t
                if inside:
                    state_at(numbers, rows, t_part, end)
                else:
                    copy(newest, end)
                advance(reached[0], t_part, end, data, memory)
                reached[0] = t_part
                if times[mark] <= t + tolerance:
                    if marks.is_output[mark]:
                        observe(t_part, end, data, memory, marks.rows[position[N_OUTPUTS]])
                        position[N_OUTPUTS] += 1
                        taken = ended
                    if marks.is_picture[mark]:
                        picture(t_part, end, data, memory, marks.pictures[position[N_PICTURES]])
                        position[N_PICTURES] += 1
                    position[NEXT_MARK] += 1
            if not taken and _is_followed(marks.windows, position, marks.stride, marks.wanted, t):
                observe(t, newest, data, memory, marks.step_rows[position[N_STEPS]])
                marks.step_times[position[N_STEPS]] = t
                position[N_STEPS] += 1
            accept(t, newest, data, memory)
            if t == numbers.t_end:
                return ENDED
            if pause[0] != 0 or position[N_STEPS] == marks.step_times.size:
                return PAUSED

    functions: list[Any] = [rhs, jac, advance, accept, observe, picture]
    functions += [] if factorise is None else [factorise, solve]
    if not all(isinstance(function, Kernel) for function in functions):
        return run
    names = " ".join(function.name for function in functions)
    run.__qualname__ = f"run_{hashlib.sha256(names.encode()).hexdigest()[:16]}"
    listed = all(function.name in ENTRIES for function in functions)
    made = Kernel(run, SOURCES, unlocked=True, layouts=_layouts(*functions) if listed else None)
    return enlisted(made) if listed else made


def _layouts(rhs: Kernel, jac: Kernel, *others: Kernel) -> Layouts:
    """Return the layouts of the arguments of the loop; pictures have a dimension more than one of them."""
    marks, place = cast("Tuple", of_hint(Marks)), Marks._fields.index("pictures")
    picture = cast("Array", others[3].layouts[-1])
    members = list(marks.members)
    members[place] = replace(picture, ndim=picture.ndim + 1)
    own = of_hint(OwnMatrix) if others[4:] else Absent()
    work = jac.layouts[-1], own, Tuple(Marks, tuple(members)), of_hint(IntArray)
    return (of_hint(MebdfState), *rhs.layouts[2:4], *work)
