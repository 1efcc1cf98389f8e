"""The loop around the core for compiled functions of users, which takes several steps ahead.

What it cannot do itself (functions in Python, large matrices) it leaves to its caller as the core does.
"""

import ctypes
from typing import Any, Final, NamedTuple

from mebdf.arrays import FloatArray, FloatCube, FloatMatrix, IntArray, IntMatrix
from mebdf.compiled.kernel import UNCOMPILED, Instruction, Kernel
from mebdf.kernels import phases
from mebdf.kernels import state as at
from mebdf.kernels.core import resume
from mebdf.kernels.jit import SOURCES, copy, entry, kernel
from mebdf.kernels.state import MebdfState

FUN: Final = 0
JAC: Final = 1
IN_PYTHON: Final = 0  #: Address of a function that the caller evaluates.
BY_DIFFERENCES: Final = 1  #: Address in the place of that of the Jacobian.

#: Jacobian that is compared with differences after the first, then at twice as many, and so on.
FIRST: Final = 32

# Rows of ``Calls.work``.
AT: Final = 0  #: State that a function is given: it may write there.
SHARE: Final = 1  #: Move of each variable in differences, as a share of its size.
TYPICAL: Final = 2  #: Size below which that of a variable does not shrink its move.
ALGEBRAIC: Final = 3  #: 1 for an equation without derivatives, whose terms cancel.
TERMS: Final = 4  #: Sizes of these terms by the last Jacobian.
RATE: Final = 5
MOVED: Final = 6
FURTHER: Final = 7
N_WORK: Final = 8

# Columns of ``Calls.counts``.
DEGREE: Final = 0
#: Degree of the polynomial of the step, then evaluations, Jacobians and decompositions so far.
N_COUNTS: Final = 4

# Roundings to the powers 7/8, 3/4, 1/4 and 1/2.
#: Change of a rate, relative to it, below which a variable is moved further at once: it is all rounding.
LOST: Final = float.fromhex("0x1.6a09e667f3bcdp-46")
SMALL: Final = 2.0**-39  #: Such a change below which it is moved further the next time.
LARGE: Final = 2.0**-13  #: Such a change above which it is moved less the next time.
STRIDE: Final = 10.0  #: Factor of a longer and of a shorter move.
LEAST: Final = 2.0**-26
"""Shortest move relative to the size of a variable: rounding is the larger error of a shorter one.

Where large rates cancel, a move that is right changes their sum by much.
"""


class Calls(NamedTuple):
    """Functions of a user, and the steps taken with them."""

    functions: IntArray  #: Addresses of ``fun`` and ``jac``, see above, shape (2,).
    data: FloatArray  #: Numbers that the functions are given.
    #: Time of the breakpoint that the integration leads to, infinite if to none, and the last time before,
    #: shape (2,).
    kink: FloatArray
    work: FloatMatrix  #: Rows named above, shape (N_WORK, n).
    ends: FloatMatrix  #: Time and signed size of each step, shape (m, 2).
    counts: IntMatrix  #: Columns named above, shape (m, N_COUNTS).
    differences: FloatCube  #: Backward differences at the end of each step, shape (m, N_DIFFERENCES, n).


SIGNATURE: Final = ctypes.CFUNCTYPE(None, ctypes.c_double, *(ctypes.c_void_p,) * 3)


def call_from_python(address: int, t: float, y: FloatArray, out: FloatArray, data: FloatArray) -> None:
    """Call a compiled function."""
    SIGNATURE(address)(t, *(array.ctypes.data for array in (y, out, data)))


_call: Final[Any] = (
    call_from_python if UNCOMPILED else Instruction(call_from_python, "mebdf.kernels.instructions", "call")
)


def walk(state: MebdfState, calls: Calls, taken: int, limit: int) -> tuple[int, int]:
    """Take steps; return how many have been taken, and the last request of the core.

    ``calls``: functions, and room for ``limit`` steps; ``taken``: steps that are there already, of a walk
    that was left for a request; ``limit``: number of steps at which to stop.
    """
    record, rows, matrices, pivots, mass, places = state
    numbers = record[0]
    while True:
        request = resume(record, rows, matrices, pivots, mass, places)
        t = numbers.t_eval
        if t == calls.kink[0]:
            t = calls.kink[1]
        if request == phases.NEED_F:
            _evaluate(calls, t, rows[at.Y], rows[at.F])
        elif request == phases.NEED_JACOBIAN and calls.functions[JAC] == BY_DIFFERENCES:
            _difference(calls, t, rows[at.Y], matrices[at.JACOBIAN])
        elif (
            request == phases.NEED_JACOBIAN
            and calls.functions[JAC] != IN_PYTHON
            and not _is_compared(numbers.n_j)
        ):
            matrices[at.JACOBIAN].fill(0.0)
            copy(rows[at.Y], calls.work[AT])
            _call(calls.functions[JAC], t, calls.work[AT], matrices[at.JACOBIAN].reshape(-1), calls.data)
        elif request == phases.STEP_ACCEPTED:
            _note(state, calls, taken)
            taken += 1
            if taken == limit or numbers.t == numbers.t_end:
                return taken, request
        else:
            return taken, request


walk = entry(walk if UNCOMPILED else Kernel(walk, SOURCES, unlocked=True))


@kernel
def _is_compared(count: int) -> bool:
    """Tell whether a Jacobian is left to the caller, who compares it with differences."""
    return count == 1 or (count >= FIRST and count & (count - 1) == 0)


@kernel
def _note(state: MebdfState, calls: Calls, k: int) -> None:
    """Keep the step that was accepted."""
    numbers = state.numbers[0]
    calls.ends[k, 0], calls.ends[k, 1] = numbers.t, numbers.h_last
    counts = calls.counts[k]
    counts[DEGREE] = numbers.k_last + 1
    counts[1], counts[2], counts[3] = numbers.n_f, numbers.n_j, numbers.n_lu
    for m in range(numbers.k_last + 2):
        for i in range(state.rows.shape[1]):
            calls.differences[k, m, i] = state.rows[at.HISTORY + m, i]


@kernel
def _evaluate(calls: Calls, t: float, y: FloatArray, f: FloatArray) -> None:
    """Fill the right-hand side."""
    copy(y, calls.work[AT])
    _call(calls.functions[FUN], t, calls.work[AT], f, calls.data)


@kernel
def _difference(calls: Calls, t: float, y: FloatArray, jacobian: FloatMatrix) -> None:
    """Fill the Jacobian by differences, whose moves heed the rounding that the last ones met.

    D. E. Salane, Adaptive routines for forming Jacobians numerically, SAND86-1319, 1986.
    """
    work = calls.work
    _evaluate(calls, t, y, work[RATE])
    for j in range(y.size):
        size = max(work[TYPICAL, j], abs(y[j]))
        if work[RATE, j] + work[TERMS, j] < 0.0:
            size = -size
        move = _move(y[j], work[SHARE, j] * size)
        while move == 0.0:
            work[SHARE, j] *= STRIDE
            move = _move(y[j], work[SHARE, j] * size)
        largest, scale = _column(calls, t, y, j, move, MOVED)
        column = MOVED
        if largest < LOST * scale:
            further = _move(y[j], STRIDE * work[SHARE, j] * size)
            larger, other = _column(calls, t, y, j, further, FURTHER)
            if largest * other < larger * scale:
                work[SHARE, j] *= STRIDE
                move, largest, scale, column = further, larger, other, FURTHER
        for i in range(y.size):
            jacobian[i, j] = (work[column, i] - work[RATE, i]) / move
        if largest < SMALL * scale:
            work[SHARE, j] *= STRIDE
        elif largest > LARGE * scale:
            work[SHARE, j] /= STRIDE
        work[SHARE, j] = max(work[SHARE, j], LEAST)
    _take_terms(work, y, jacobian)


@kernel
def _move(y: float, wanted: float) -> float:
    """Return a move as the rounding of the variable leaves it."""
    return (y + wanted) - y


@kernel
def _column(calls: Calls, t: float, y: FloatArray, j: int, move: float, row: int) -> tuple[float, float]:
    """Fill a row with the rates where a variable is moved; return the largest change and its scale."""
    work = calls.work
    copy(y, work[AT])
    work[AT, j] += move
    _call(calls.functions[FUN], t, work[AT], work[row], calls.data)
    largest, scale = -1.0, 0.0
    for i in range(y.size):
        change = abs(work[row, i] - work[RATE, i])
        if change > largest:
            largest = change
            scale = max(abs(work[RATE, i] + work[TERMS, i]), abs(work[row, i] + work[TERMS, i]))
    return largest, scale


@kernel
def _take_terms(work: FloatMatrix, y: FloatArray, jacobian: FloatMatrix) -> None:
    """Fill the sizes of terms of equations without derivatives, if all of them are finite."""
    finite = True
    for i in range(y.size):
        total = 0.0
        for j in range(y.size):
            total += abs(jacobian[i, j] * y[j])
        work[AT, i] = total * work[ALGEBRAIC, i]
        finite = finite and total - total == 0.0
    if finite:
        copy(work[AT], work[TERMS])
