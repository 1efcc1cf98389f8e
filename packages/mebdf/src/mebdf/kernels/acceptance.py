"""Whether a stage whose Newton correction is small solves its formula.

A correction is the residual divided by 1 − hβJ. Where J is large by mistake (differenced across a jump, stale
or wrong) the correction is tiny whatever the residual is, and so is the error estimate, which is made of
corrections. Where J is right at one point only, as on the steep flank of a switch narrower than the
tolerance, the same holds beside it. Only an evaluation after the correction decides.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
from mebdf.kernels.control import norm
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.mass import is_algebraic
from mebdf.kernels.state import Numbers

# Verdicts. An open stage needs another evaluation; in doubt, the rounding of its residual decides.
SOLVED: Final = 1
OPEN: Final = 0
FALSE: Final = -1
IN_DOUBT: Final = 2

PROVED: Final = 0.5  #: Share of the residual that a correction must leave, at most, to prove the Jacobian.
REFUTED: Final = 0.9  #: Share that it leaves, at least, where the Jacobian is wrong.
#: Residual that needs no proof, at most, relative to the largest one that the Jacobian was seen to remove.
TRUSTED: Final = 10.0
#: Share of the trust to which a residual must have been reduced: beside a jump the Jacobian may by chance
#: lead to a smaller one on its other side, and no further.
REACHED: Final = 1.0e-2
NOTHING: Final = 1.0e-3  #: Residual in units of the tolerance that never needs a proof.
HARMLESS: Final = 0.1  #: Residual in units of the tolerance that may be left below rounding.
NOISE: Final = 10.0 * float(np.finfo(np.float64).eps)  #: Rounding of the residual relative to its terms.
ABOVE_NOISE: Final = 10.0  #: Least change of the residual by a magnified correction, over rounding.


@inlined
def judge(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> int:
    """Return SOLVED, FALSE or IN_DOUBT for a stage whose correction is small enough."""
    if state.overshot > 0.0 and abs(state.left / state.overshot - 1.0) > PROVED:
        return FALSE
    if state.left <= PROVED:
        # What curvature leaves, relative to the residual, grows with it.
        removed = state.unsolved / state.left
        state.trust = max(state.trust, removed * min(PROVED / state.left, TRUSTED))
        state.reached = min(state.reached, state.unsolved)
    return IN_DOUBT if _is_doubtful(state) or has_unproved(state, rows, places, 0.0) else SOLVED


@kernel
def judge_beside_rounding(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> int:
    """Return SOLVED, OPEN or FALSE for a stage in doubt, with its row MAGNITUDE filled."""
    verdict = _judge_residual(state, rows, places) if _is_doubtful(state) else SOLVED
    return OPEN if verdict == SOLVED and has_unproved(state, rows, places, NOISE) else verdict


@kernel
def _is_doubtful(state: Numbers) -> bool:
    """Tell whether the last correction leaves more than may be left without a proof."""
    if state.overshot > 0.0:
        return False
    if state.wary > 0:
        return state.left > PROVED and state.unsolved > NOTHING
    trusted = state.unsolved <= state.trust and state.reached <= max(
        state.settings.doubtful, REACHED * state.trust
    )
    if state.unsolved <= state.settings.doubtful or (trusted and state.left <= PROVED):
        return False
    return state.last_norm <= state.settings.tiny * (1.0 if trusted else state.unsolved)


@kernel
def _judge_residual(state: Numbers, rows: FloatArray, places: NDArray[np.int64]) -> int:
    """Return the verdict on the equations with derivatives."""
    noise = NOISE * norm(rows, at.MAGNITUDE, at.ROW_WEIGHT if places.size > 0 else at.WEIGHT)
    if state.unsolved > noise:
        return FALSE if state.evaluated > 1 and state.left > REFUTED else OPEN
    factor = ABOVE_NOISE * noise / state.unsolved
    if state.unsolved <= HARMLESS or factor * state.last_norm > 1.0:
        return SOLVED
    if state.evaluated > 0:
        # A right Jacobian makes the next residual 1 − ``factor`` of this one, a wrong one leaves it.
        state.overshot, state.last_norm = factor, 0.0
        for i in range(rows.shape[1]):
            rows[at.Y, i] += (factor - 1.0) * rows[at.DELTA, i]
    return OPEN


@kernel
def has_unproved(state: Numbers, rows: FloatArray, places: NDArray[np.int64], noise: float) -> bool:
    """Tell whether an algebraic equation has a residual that the Jacobian was not seen to remove.

    There is no scale for it but that: the Jacobian's may be wrong. Below ``noise`` times its terms it counts
    as removed.
    """
    for i in range(rows.shape[1] if places.size > 0 else 0):
        residual = abs(rows[at.RESIDUAL, i])
        if is_algebraic(places, i) and residual > TRUSTED * rows[at.SEEN, i]:
            if not residual * abs(state.scaled) <= noise * rows[at.MAGNITUDE, i]:
                return True
            rows[at.SEEN, i] = residual
    return False
