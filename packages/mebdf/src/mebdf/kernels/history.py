"""Backward differences: change of step, the newest value, and the polynomial through them."""

from typing import Annotated

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.kernels.jit import entry, inlined, kernel
from mebdf.kernels.state import HISTORY, N_DIFFERENCES, NUMBERS, SCRATCH, Numbers


@kernel
def rescale(rows: FloatArray, degree: int, factor: float, shift: float) -> None:
    """Make the differences ∇^0 … ∇^degree those of the same polynomial with steps ``factor`` times as long.

    The polynomial through y_n, y_{n-1}, … is evaluated at the new points by Newton's formula and
    differenced again. The newest of them lies ``shift`` steps after the present one. Higher differences
    are dropped.
    """
    n = rows.shape[1]
    for i in range(n):
        for j in range(degree + 1):
            rows[SCRATCH + j, i] = value_at(rows, HISTORY, degree, shift - j * factor, i)
        for m in range(1, degree + 1):
            for j in range(degree, m - 1, -1):
                rows[SCRATCH + j, i] = rows[SCRATCH + j - 1, i] - rows[SCRATCH + j, i]
    for m in range(degree + 1):
        for i in range(n):
            rows[HISTORY + m, i] = rows[SCRATCH + m, i]
    for m in range(degree + 1, N_DIFFERENCES):
        for i in range(n):
            rows[HISTORY + m, i] = 0.0


@inlined
def value_at(rows: FloatArray, first: int, degree: int, s: float, i: int) -> float:
    """Return component ``i`` of the polynomial, ``s`` steps after its newest value (s ≤ 0 is inside).

    Horner's form of Σ_m ∇^m y_n s (s + 1) … (s + m − 1)/m!.
    """
    total = 0.0
    for m in range(degree, 0, -1):
        total = (s + m - 1.0) / m * (rows[first + m, i] + total)
    return rows[first, i] + total


@inlined
def push(rows: FloatArray, newest: int, size: int, first: int) -> None:
    """Write ``size`` differences of the history after row ``newest`` has joined it, from row ``first``.

    ``first`` may be HISTORY itself.
    """
    for i in range(rows.shape[1]):
        value = rows[newest, i]
        for m in range(size):
            older = rows[HISTORY + m, i]
            rows[first + m, i] = value
            value -= older


@entry
def state_at(state: Annotated[Numbers, NUMBERS], rows: FloatMatrix, t: float, y: FloatArray) -> None:
    """Fill ``y`` with the solution at a time inside the last accepted step."""
    s = (t - state.t) / state.h_last
    for i in range(y.size):
        y[i] = value_at(rows, HISTORY, state.k_last + 1, s, i)
