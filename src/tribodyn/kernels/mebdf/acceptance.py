"""Whether a stage whose Newton correction is small solves its formula.

A correction is the residual divided by 1 − hβJ. Where J is large by mistake, because it was differenced
across a jump, is stale or wrong, the correction is tiny whatever the residual, and so is the error
estimate, which is made of corrections too. Where J is right at one point only, as on the steep flank of
a switch narrower than the tolerance, the same holds beside it. Only an evaluation after the correction tells.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.mebdf.mass import is_algebraic
from tribodyn.kernels.mebdf.state import (
    CARRIED,
    DELTA,
    DOUBTFUL,
    EXPLAINED,
    HIGHER,
    ITERATION,
    LAST_NORM,
    MAGNITUDE,
    OVERSHOT,
    OWED,
    RESIDUAL,
    ROW_WEIGHT,
    SEEN,
    SMALL,
    STAGE,
    TINY,
    UNSOLVED,
    UNSOLVED_BEFORE,
    WARY,
    WEIGHT,
    Y,
)

SOLVED: Final = 1
OPEN: Final = 0
"""An evaluation must tell."""
FALSE: Final = -1
DIVERGED: Final = -2
IN_DOUBT: Final = 2
"""The rounding of the residual must tell."""
UNPROVED: Final = 3
"""The same, of algebraic equations alone."""

PROVED: Final = 0.5
"""What a correction must leave of the residual, at most, to prove the Jacobian."""
REFUTED: Final = 0.9
"""What it leaves, at least, where the Jacobian is wrong."""
TRUSTED: Final = 10.0
"""Residual that is no reason for doubt, relative to what the Jacobian was seen to remove."""
FADING: Final = 0.97
"""What a step leaves of that trust."""
NOTHING: Final = 1.0e-6
"""Residual in units of the tolerance that needs no proof."""
HARMLESS: Final = 0.1
"""Residual, or magnified correction, in units of the tolerance that does no harm."""
NOISE: Final = 10.0 * float(np.finfo(np.float64).eps)
"""Rounding of the residual relative to its terms."""
ABOVE_NOISE: Final = 10.0
"""How far a magnified correction must change the residual beyond rounding."""


@inlined
def judge(real: FloatArray, count: NDArray[np.int64], size: float) -> int:
    """Return SOLVED, FALSE or IN_DOUBT for a stage whose correction, of norm ``size``, is small enough."""
    unsolved, before = real[UNSOLVED], real[UNSOLVED_BEFORE]
    if real[OVERSHOT] > 0.0:
        return SOLVED if abs(unsolved / (real[OVERSHOT] * before) - 1.0) <= PROVED else FALSE
    if _left(real, count) <= PROVED:
        real[EXPLAINED] = max(real[EXPLAINED], before)
        real[OWED] = 0.0
        return SOLVED
    if unsolved <= NOTHING or (count[WARY] == 0 and not _is_doubtful(real, size)):
        return SOLVED
    return IN_DOUBT


@inlined
def _left(real: FloatArray, count: NDArray[np.int64]) -> float:
    """Return what the last but one correction has left of the residual; 1 where that is not known."""
    unsolved = real[UNSOLVED]
    return unsolved / real[UNSOLVED_BEFORE] if count[ITERATION] > 1 and unsolved > 0.0 else 1.0


@kernel
def has_unproved(rows: FloatArray, places: NDArray[np.int64]) -> bool:
    """Tell whether an algebraic equation has a residual beyond what the Jacobian was seen to remove.

    There is no scale for it but that: the Jacobian's may be wrong.
    """
    for i in range(rows.shape[1]):
        if is_algebraic(places, i) and abs(rows[RESIDUAL, i]) > TRUSTED * rows[SEEN, i]:
            return True
    return False


@kernel
def note_removed(rows: FloatArray, i: int, residual: float) -> None:
    """Remember what the last correction has removed of the residual of an algebraic equation."""
    before = abs(rows[RESIDUAL, i])
    if abs(residual) <= PROVED * before:
        rows[SEEN, i] = max(rows[SEEN, i], before)


@kernel
def judge_algebraic(rows: FloatArray, places: NDArray[np.int64], scaled: float) -> int:
    """Return SOLVED, or OPEN where such a residual is not rounding, with the row MAGNITUDE filled."""
    for i in range(rows.shape[1]):
        residual = abs(rows[RESIDUAL, i])
        if is_algebraic(places, i) and residual > TRUSTED * rows[SEEN, i]:
            if residual > NOISE * rows[MAGNITUDE, i] / abs(scaled):
                return OPEN
            rows[SEEN, i] = residual
    return SOLVED


@kernel
def judge_beside_rounding(real: FloatArray, count: NDArray[np.int64], rows: FloatArray, massive: bool) -> int:
    """Return SOLVED, OPEN or FALSE for a stage in doubt, with its row MAGNITUDE filled."""
    unsolved, size = real[UNSOLVED], real[LAST_NORM]
    # A stage that was predicted with its slope begins with a residual that was not evaluated.
    predicted = count[STAGE] == 1 and count[CARRIED] == 1 and not massive
    given = predicted or (count[STAGE] == 3 and count[HIGHER] == 0)
    evaluated = count[ITERATION] - (1 if given else 0)
    noise = _noise(rows, ROW_WEIGHT if massive else WEIGHT)
    if unsolved <= noise:
        factor = ABOVE_NOISE * noise / unsolved
        if unsolved <= HARMLESS or factor * size > HARMLESS:
            return SOLVED
        return _overshoot(real, rows, factor) if evaluated > 0 else OPEN
    return FALSE if evaluated > 1 and _left(real, count) > REFUTED else OPEN


@inlined
def _is_doubtful(real: FloatArray, size: float) -> bool:
    """Tell whether a small correction leaves more than may be left without a proof; else note what it leaves.

    One that is not tiny is trusted where a Jacobian was lately seen to remove a tenth of such a residual.
    """
    unsolved, enough = real[UNSOLVED], real[DOUBTFUL]
    if size <= real[TINY] and unsolved > enough:
        return True
    if size > real[SMALL] * math.sqrt(unsolved) or unsolved <= TRUSTED * real[EXPLAINED]:
        return False
    owed = real[OWED] + unsolved
    if owed <= enough:
        real[OWED] = owed
    return owed > enough


@kernel
def _noise(rows: FloatArray, weight: int) -> float:
    """Return the norm of the residual that the rounding of y, magnified by the Jacobian, may leave."""
    total = 0.0
    for i in range(rows.shape[1]):
        total += (NOISE * rows[MAGNITUDE, i] * rows[weight, i]) ** 2
    return math.sqrt(total / rows.shape[1])


@kernel
def _overshoot(real: FloatArray, rows: FloatArray, factor: float) -> int:
    """Magnify the correction, so that the next residual tells; return OPEN.

    A right Jacobian makes the residual 1 − ``factor`` of itself, a wrong one leaves it.
    """
    real[OVERSHOT] = factor
    real[LAST_NORM] = 0.0
    for i in range(rows.shape[1]):
        rows[Y, i] += (factor - 1.0) * rows[DELTA, i]
    return OPEN
