"""Whether a stage whose Newton correction is small solves its formula.

A correction is the residual divided by 1 − hβJ. Where J is large by mistake, because it was differenced
across a jump, is stale or wrong, the correction is tiny whatever the residual, and so is the error
estimate, which is made of corrections too. Only an evaluation after the correction tells.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.mebdf.state import (
    CARRIED,
    DOUBTFUL,
    ITERATION,
    LAST_JACOBIAN,
    RESIDUAL,
    SCALED,
    STAGE,
    TINY,
    UNSOLVED,
    UNSOLVED_BEFORE,
    WARY,
    Y,
)

SOLVED: Final = 1
OPEN: Final = 0
"""An evaluation must tell."""
FALSE: Final = -1

PROVED: Final = 0.5
"""What a correction must leave of the residual, at most, to prove the Jacobian."""
REFUTED: Final = 0.9
"""What it leaves, at least, where the Jacobian is wrong."""
NOTHING: Final = 1.0e-6
"""Residual in units of the tolerance that needs no proof."""
NOISE: Final = 10.0 * float(np.finfo(np.float64).eps)
"""Rounding of the residual relative to its terms."""


@inlined
def judge(
    real: FloatArray, count: NDArray[np.int64], rows: FloatArray, matrices: FloatArray, size: float
) -> int:
    """Return SOLVED, OPEN or FALSE for a stage whose correction, of norm ``size``, is small enough."""
    unsolved = real[UNSOLVED]
    left = unsolved / real[UNSOLVED_BEFORE] if count[ITERATION] > 1 and unsolved > 0.0 else 1.0
    if left <= PROVED or (count[WARY] == 0 and (unsolved <= real[DOUBTFUL] or size > real[TINY])):
        return SOLVED
    if unsolved <= NOTHING or _is_noise(real, rows, matrices):
        return SOLVED
    # A stage that was predicted with its slope begins with a residual that was not evaluated.
    given = count[STAGE] == 3 or (count[STAGE] == 1 and count[CARRIED] == 1)
    evaluated = count[ITERATION] - (1 if given else 0)
    return FALSE if evaluated > 1 and left > REFUTED else OPEN


@kernel
def _is_noise(real: FloatArray, rows: FloatArray, matrices: FloatArray) -> bool:
    """Tell whether every residual may be the rounding of y, magnified by the Jacobian."""
    scaled = abs(real[SCALED])
    for i in range(rows.shape[1]):
        noise = abs(rows[Y, i])
        for j in range(rows.shape[1]):
            noise += scaled * abs(matrices[LAST_JACOBIAN, i, j] * rows[Y, j])
        if abs(rows[RESIDUAL, i]) > NOISE * noise:
            return False
    return True
