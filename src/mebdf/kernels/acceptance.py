"""Whether a stage whose Newton correction is small solves its formula.

A correction is the residual divided by 1 − hβJ. Where J is large by mistake (differenced across a jump, stale
or wrong) the correction is tiny whatever the residual is, and so is the error estimate, which is made of
corrections. Where J is right at one point only, as on the steep flank of a switch narrower than the
tolerance, the same holds beside it. Only an evaluation after the correction decides.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.mass import is_algebraic
from mebdf.kernels.state import Numbers

SOLVED: Final = 1
OPEN: Final = 0
"""Another evaluation is needed."""
FALSE: Final = -1
DIVERGED: Final = -2
IN_DOUBT: Final = 2
"""Compare with the rounding of the residual."""

PROVED: Final = 0.5
"""What a correction must leave of the residual, at most, to prove the Jacobian."""
REFUTED: Final = 0.9
"""What it leaves, at least, where the Jacobian is wrong."""
TRUSTED: Final = 10.0
"""Residual that needs no proof, at most, relative to the largest one that the Jacobian was seen to remove."""
NOTHING: Final = 1.0e-3
"""Residual in units of the tolerance that never needs a proof."""
HARMLESS: Final = 0.1
"""Residual in units of the tolerance that does no harm."""
NOISE: Final = 10.0 * float(np.finfo(np.float64).eps)
"""Rounding of the residual relative to its terms."""
ABOVE_NOISE: Final = 10.0
"""How far a magnified correction must change the residual beyond rounding."""


@inlined
def judge(state: Numbers, rows: FloatArray, places: NDArray[np.int64], size: float) -> int:
    """Return SOLVED, FALSE or IN_DOUBT for a stage whose correction, of norm ``size``, is small enough."""
    before, overshot, left = state.unsolved_before, state.overshot, _left(state)
    if overshot > 0.0 and abs(state.unsolved / (overshot * before) - 1.0) > PROVED:
        return FALSE
    if left <= PROVED:
        # What curvature leaves, relative to the residual, grows with it.
        state.trust = max(state.trust, before * min(PROVED / left, TRUSTED))
    if _is_doubtful(state, size) or (places.size > 0 and _has_unproved(rows, places)):
        return IN_DOUBT
    return SOLVED


@kernel
def _left(state: Numbers) -> float:
    """Return what the last but one correction has left of the residual; 1 where that is not known."""
    unsolved = state.unsolved
    return unsolved / state.unsolved_before if state.iteration > 1 and unsolved > 0.0 else 1.0


@kernel
def _is_doubtful(state: Numbers, size: float) -> bool:
    """Tell whether a correction of norm ``size`` leaves more than may be left without a proof."""
    unsolved = state.unsolved
    if state.overshot > 0.0 or _left(state) <= PROVED:
        return False
    if state.wary > 0:
        return unsolved > NOTHING
    small = state.settings.tiny * (1.0 if unsolved <= state.trust else unsolved)
    return unsolved > state.settings.doubtful and size <= small


@kernel
def _has_unproved(rows: FloatArray, places: NDArray[np.int64]) -> bool:
    """Tell whether an algebraic equation has a residual that the Jacobian was not seen to remove.

    There is no scale for it but that: the Jacobian's may be wrong.
    """
    for i in range(rows.shape[1]):
        if is_algebraic(places, i) and abs(rows[at.RESIDUAL, i]) > TRUSTED * rows[at.SEEN, i]:
            return True
    return False


@kernel
def note_removed(rows: FloatArray, i: int, residual: float) -> None:
    """Store what the last correction has removed of the residual of an algebraic equation."""
    before = abs(rows[at.RESIDUAL, i])
    if abs(residual) <= PROVED * before:
        rows[at.SEEN, i] = max(rows[at.SEEN, i], before)


@kernel
def judge_beside_rounding(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> int:
    """Return SOLVED, OPEN or FALSE for a stage in doubt, with its row MAGNITUDE filled."""
    massive = places.size > 0
    if _is_doubtful(state, state.last_norm):
        noise = _noise(rows, at.ROW_WEIGHT if massive else at.WEIGHT)
        verdict = _judge_differential(state, rows, massive, noise)
        if verdict != SOLVED:
            return verdict
    for i in range(rows.shape[1] if massive else 0):
        residual = abs(rows[at.RESIDUAL, i])
        if is_algebraic(places, i) and residual > TRUSTED * rows[at.SEEN, i]:
            if residual > NOISE * rows[at.MAGNITUDE, i] / abs(state.scaled):
                return OPEN
            rows[at.SEEN, i] = residual
    return SOLVED


@kernel
def _judge_differential(state: Numbers, rows: FloatArray, massive: bool, noise: float) -> int:
    """Return the verdict on the equations with derivatives, whose residual may have an error ``noise``."""
    # A stage that was predicted with its slope begins with a residual that was not evaluated.
    predicted = state.stage == 1 and state.carried == 1 and not massive
    given = predicted or (state.stage == 3 and state.higher == 0)
    evaluated = state.iteration - (1 if given else 0)
    if state.unsolved > noise:
        return FALSE if evaluated > 1 and _left(state) > REFUTED else OPEN
    factor = ABOVE_NOISE * noise / state.unsolved
    if state.unsolved <= HARMLESS or factor * state.last_norm > 1.0:
        return SOLVED
    if evaluated > 0:
        # A right Jacobian makes the next residual 1 − ``factor`` of this one, a wrong one leaves it.
        state.overshot, state.last_norm = factor, 0.0
        for i in range(rows.shape[1]):
            rows[at.Y, i] += (factor - 1.0) * rows[at.DELTA, i]
    return OPEN


@kernel
def _noise(rows: FloatArray, weight: int) -> float:
    """Return the norm of the residual that the rounding of y, magnified by the Jacobian, may leave."""
    total = 0.0
    for i in range(rows.shape[1]):
        total += (NOISE * rows[at.MAGNITUDE, i] * rows[weight, i]) ** 2
    return math.sqrt(total / rows.shape[1])
