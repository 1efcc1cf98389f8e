"""Stages at the end of Newton's iteration: which ones are accepted, and those whose correction led too far.

A correction is the residual divided by 1 − hβJ. Where J is large by mistake (differenced across a jump, stale
or wrong) the correction is tiny whatever the residual is, and so is the error estimate, which is made of
corrections. Where J is right at one point only, as on the steep flank of a switch narrower than the
tolerance, the same holds beside it. Only an evaluation after the correction decides.

Where a rate has a vertical slope, as a root law at rest, Newton's corrections lead to and fro about the
solution for ever. Where a rate jumps against the motion the solution slides along the jump, as Filippov
defines it, and no value solves the formula with the rate of one side. In both cases the solution lies between
two values whose residuals point to each other. Their distance is halved until it is far below the tolerance.
The smallest residual of all mixtures of both is what the other equations still lack: one more correction
removes it.

Residuals of algebraic equations have no scale to be compared by. Nothing is looked for while they are larger
than what the Jacobian removes, or while they alone are left.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels import state as at
from mebdf.kernels.coefficients import SCALARS
from mebdf.kernels.control import MOST_CAUTION, TROUBLE, error_of, error_weight, largest_error, norm
from mebdf.kernels.jit import inlined, kernel
from mebdf.kernels.matrix import is_algebraic, product
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


# Values of ``state.between``: the solution lies between two values, their mixture is the stage, or the last
# change was an enlarged correction. It is 0 in all other cases.
HALVING: Final = 1
MIXED: Final = 2
GONE: Final = 3
TOO_FAR: Final = 4

WATCHED: Final = TROUBLE + 30  #: Trouble after a stage that was solved so.
#: Share of the residual that a correction leaves, at least, where Newton's iteration is not left alone.
SLOW: Final = 0.5
#: Such a share above which the Jacobian is wrong, unless a stage has ended between two values before.
WILD: Final = 10.0
#: Distance, in units of the tolerance, at which the values are not told apart. The mixture lies between them,
#: so that its error is less. With .1 power laws take 10 % less calls, switches of width 1e-10 a third more.
NARROW: Final = 0.03
#: Most halvings in one stage: more than lead from any step to the rounding of its values.
MOST_HALVINGS: Final = 60
#: Length of a first correction after a step that has ended between two values, in units of the tolerance.
NEAR: Final = 1.0
#: Residual of the mixture, in units of the tolerance, up to which its correction needs no proof.
LEFT: Final = 1.0
FARTHER: Final = 8.0  #: Distance of the next value over that of a correction that leaves its residual.
FARTHEST: Final = 10.0  #: Largest of these corrections, in units of the tolerance.

FAR_RESIDUAL: Final = at.SCRATCH + 1  #: Row of the residual at the other value.
LAST_RESIDUAL: Final = at.SCRATCH + 2  #: Row of the residual before the last change of the value.


@inlined
def keep_residual(rows: FloatArray) -> None:
    """Keep the residual before the next one is filled in."""
    for i in range(rows.shape[1]):
        rows[LAST_RESIDUAL, i] = rows[at.RESIDUAL, i]


@inlined
def begin_near(state: Numbers, rows: FloatArray) -> None:
    """Shorten a first correction where the last step has ended between two values: they are near."""
    size = norm(rows, at.DELTA, at.WEIGHT)
    if size > NEAR and state.iteration == 0:
        state.between = GONE
        state.halvings = 1
        for i in range(rows.shape[1]):
            rows[at.DELTA, i] *= NEAR / size


@kernel
def look_back(state: Numbers, rows: FloatArray, mass: FloatArray, places: NDArray[np.int64]) -> bool:
    """Move Y to the middle of two values with the solution between them; return whether there are such.

    Once they are close the row RESIDUAL becomes that of the mixture of both, for a last correction. Where all
    between them lies too far from the extrapolation the stage ends at once.
    """
    if has_unproved(state, rows, places, NOISE) or (places.size > 0 and state.unsolved <= NOTHING):
        return _leave(state)
    back = _along(rows, mass, places, at.RESIDUAL) < 0.0
    if state.between != HALVING:
        alone = state.overshot > 0.0 or (state.left <= SLOW and not (back and state.between == GONE))
        wild = state.trouble <= TROUBLE and (state.left > WILD or state.back > 0)
        if alone or wild or not _along(rows, mass, places, LAST_RESIDUAL) > 0.0:
            return _leave(state)
        if not back:
            return _go_further(state, rows)
    if state.halvings >= MOST_HALVINGS:
        return _leave(state)
    state.trouble = WATCHED
    state.wary = MOST_CAUTION
    state.trust, state.reached = 0.0, math.inf
    if state.fixed == 0 and state.stage < 3 and _is_too_far(state, rows, error_weight(places)):
        state.between = TOO_FAR
        return False
    state.between = HALVING
    if back:
        for i in range(rows.shape[1]):
            rows[at.DELTA, i] = -rows[at.DELTA, i]
            rows[FAR_RESIDUAL, i] = rows[LAST_RESIDUAL, i]
    if norm(rows, at.DELTA, at.WEIGHT) <= NARROW:
        _mix(state, rows, at.ROW_WEIGHT if places.size > 0 else at.WEIGHT)
        return False
    state.halvings += 1
    for i in range(rows.shape[1]):
        rows[at.DELTA, i] *= 0.5
        rows[at.Y, i] += rows[at.DELTA, i]
    return True


@inlined
def _is_too_far(state: Numbers, rows: FloatArray, weight: int) -> bool:
    """Tell whether all between two values fails the test of the stage."""
    size = SCALARS[state.k, 3] * norm(rows, at.DELTA, weight)
    return error_of(state, rows, at.Y, weight) - size > largest_error(state)


@inlined
def _leave(state: Numbers) -> bool:
    """Leave Newton's iteration alone: it knows nothing of a residual that it has not left itself."""
    if state.between != 0:
        state.left, state.iteration = 1.0, 0
    state.between = 0
    return False


@inlined
def _go_further(state: Numbers, rows: FloatArray) -> bool:
    """Move Y on along a small correction that has left the residual; return whether it was one.

    Near a jump the Jacobian by differences across it gives such corrections. The jump may lie behind.
    """
    last = state.halvings >= MOST_HALVINGS or norm(rows, at.DELTA, at.WEIGHT) > FARTHEST
    if last or state.trouble <= TROUBLE:
        return _leave(state)
    state.between = GONE
    state.halvings += 1
    for i in range(rows.shape[1]):
        rows[at.DELTA, i] *= FARTHER
        rows[at.Y, i] += rows[at.DELTA, i]
    return True


@kernel
def _along(rows: FloatArray, mass: FloatArray, places: NDArray[np.int64], row: int) -> float:
    """Return the product of a residual with the last change of Y, weighted as errors are."""
    total = 0.0
    for i in range(rows.shape[1]):
        if places.size == 0:
            total += rows[at.DELTA, i] * rows[row, i] * rows[at.WEIGHT, i] ** 2
        else:
            total += product(mass, places, rows, at.DELTA, i) * rows[row, i] * rows[at.ROW_WEIGHT, i] ** 2
    return total


@kernel
def _mix(state: Numbers, rows: FloatArray, weight: int) -> None:
    """Go to the mixture of both values with the smallest residual, and make that the residual."""
    whole, part = 0.0, 0.0
    for i in range(rows.shape[1]):
        difference = rows[at.RESIDUAL, i] - rows[FAR_RESIDUAL, i]
        whole += (difference * rows[weight, i]) ** 2
        part += difference * rows[at.RESIDUAL, i] * rows[weight, i] ** 2
    share = min(max(part / whole, 0.0), 1.0) if whole > 0.0 else 0.0
    for i in range(rows.shape[1]):
        rows[at.Y, i] += share * rows[at.DELTA, i]
        rows[at.RESIDUAL, i] += share * (rows[FAR_RESIDUAL, i] - rows[at.RESIDUAL, i])
    state.between = MIXED
    state.unsolved = norm(rows, at.RESIDUAL, weight)


@inlined
def judge_mixture(state: Numbers, size: float) -> int:
    """Return whether the stage is solved by the correction of a mixture; else Newton's iteration goes on."""
    state.between = 0
    state.iteration += 1
    state.last_norm = size
    small = size <= state.settings.kappa[state.stage - 1] and state.unsolved <= LEFT
    return SOLVED if small else OPEN
