"""Jacobians by differences, dense and of known pattern, also where large terms cancel."""

from collections.abc import Callable
from typing import Any, Final, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.integrate._ivp.common import num_jac
from scipy.optimize._numdiff import group_columns
from scipy.sparse import csc_array

from mebdf.arrays import FloatArray
from mebdf.kernels.ahead import LARGE, LEAST, LOST, SMALL, STRIDE

_EPS: Final = float(np.finfo(np.float64).eps)
#: Values of states evaluated at once: a dense row makes each column a group of its own.
AT_ONCE: Final = 2**22
#: Shortest move of a variable near zero, in roundings of the size at which its tolerances are equal.
ROUNDINGS: Final = 100.0
SHORT: Final = 1e-7  #: Move relative to the size of a variable where nothing is known of rounding.
FAR: Final = 1e-6  #: The same where that does not show, relative to the largest variable.
CLEAR: Final = 1e3  #: Least ratio of a visible change to its rounding.

Rates = Callable[[FloatArray], FloatArray]


class Differences(Protocol):
    """Finite differences; each call may learn from the last ones."""

    def __call__(self, rates: Rates, y: FloatArray, f: FloatArray) -> Any:
        """Return the Jacobian at ``y``, shape (n, n).

        ``rates``: right-hand sides, shape (n, m), of m states, shape (n, m); ``y``, ``f``: state and its
        right-hand side, shape (n,) each: the moves go where it goes.
        """
        ...


def typical_sizes(rtol: FloatArray, atol: FloatArray, *, algebraic: bool = False) -> FloatArray:
    """Return sizes below which those of variables do not shrink their moves, shape (n,).

    SciPy's own solvers take absolute tolerances. Moves by a share ``LEAST`` of these are lost in rounding if
    relative tolerances are small: equations of a variable near zero have other terms, and their rounding is
    that of the size at which both tolerances are equal. No move of these sizes exceeds an absolute tolerance.

    Some hundred roundings leave a Jacobian wrong by per cents, which only slows Newton's iteration. But where
    rows of a differential-algebraic system cancel (charges of capacitors that touch no ground), short steps
    magnify that without bound: moves of its variables near zero are those of the size at which both
    tolerances are equal, as far as the absolute tolerance allows.

    ``rtol``, ``atol``: relative and absolute tolerance of each variable, shape (n,) each; ``rtol`` at least
    100 roundings; ``algebraic``: whether some equations have no derivatives.
    """
    if algebraic:
        return np.asarray(atol * np.minimum(1.0 / rtol, 1.0 / LEAST))
    return np.asarray(atol * np.maximum(1.0, ROUNDINGS * _EPS / (LEAST * rtol)))


class DenseDifferences:
    """Those of SciPy's own solvers, but for the shortest move.

    ``typical``: sizes below which those of the variables do not shrink their moves, shape (n,).
    """

    def __init__(self, typical: FloatArray) -> None:
        self._typical = typical
        self._share: FloatArray | None = None

    def __call__(self, rates: Rates, y: FloatArray, f: FloatArray) -> FloatArray:
        """See :class:`Differences`."""
        difference: Any = num_jac
        matrix: FloatArray
        matrix, share = difference(lambda t, states: rates(states), 0.0, y, f, self._typical, self._share)
        self._share = np.maximum(share, LEAST)
        return matrix


class DifferencesOfTerms:
    """Differences of equations of which some are zero all along: their terms show how large a move must be.

    ``differences``: which moves they heed; ``algebraic``: which equations have no derivatives, shape (n,).
    """

    def __init__(self, differences: Differences, algebraic: NDArray[np.bool_]) -> None:
        self._differences, self._algebraic = differences, algebraic
        self._terms = np.zeros(algebraic.size)

    def __call__(self, rates: Rates, y: FloatArray, f: FloatArray) -> Any:
        """See :class:`Differences`; the terms are known from the last Jacobian."""
        terms = self._terms
        matrix = self._differences(lambda states: rates(states) + terms[:, None], y, f + terms)
        with np.errstate(over="ignore", invalid="ignore"):
            newest = np.where(self._algebraic, abs(matrix) @ np.abs(y), 0.0)
        if np.isfinite(newest).all():
            self._terms = newest
        return matrix


def plain_jacobian(
    fun: Callable[[float, FloatArray], FloatArray], typical: FloatArray
) -> Callable[[float, FloatArray], FloatArray]:
    """Return the Jacobian by differences with two moves of each variable, where nothing is known of rounding.

    Entries that do not rise above the rounding of their equation at the first move are those of the second.

    ``fun``: right-hand side ``fun(t, y)``, shape (n,); ``typical``: sizes below which those of the variables
    do not shrink the first moves, shape (n,).
    """

    def columns(t: float, y: FloatArray, f: FloatArray, moves: FloatArray) -> FloatArray:
        moved = y + moves
        with np.errstate(all="ignore"):
            found = [fun(t, np.where(unit, moved, y)) - f for unit in np.eye(y.size, dtype=bool)]
            return np.array(found).T / (moved - y)

    def jacobian(t: float, y: FloatArray) -> FloatArray:
        f, size = fun(t, y), np.maximum(np.abs(y), typical)
        least = SHORT * np.maximum(size, np.finfo(np.float64).tiny / _EPS**2)
        near = columns(t, y, f, least)
        far = columns(t, y, f, np.full(y.size, FAR * max(1.0, float(np.max(np.abs(y), initial=0.0)))))
        far[~np.isfinite(far)] = 0.0
        rounding = CLEAR * _EPS * (np.abs(far) @ np.abs(y) + np.abs(f))
        return np.where(np.abs(near * least) <= rounding[:, None], far, near)

    return jacobian


class _Changes(NamedTuple):
    """Changes by moves: entry by entry, and the largest of each column with the size of its rate."""

    entries: FloatArray
    largest: FloatArray
    size: FloatArray


class GroupedDifferences:
    """Differences of known pattern: columns that share no equation are moved in one evaluation.

    Their moves heed the rounding that the last ones met, as those of SciPy's own solvers.

    ``pattern``: where entries may differ from zero: compressed columns of these alone, shape (n, n);
    ``typical``: sizes below which those of the variables do not shrink their moves, shape (n,).

    Attributes
    ----------
    evaluations
        How many evaluations it takes, unless columns must be moved further.

    References
    ----------
    A. R. Curtis, M. J. D. Powell, J. K. Reid, J. Inst. Math. Appl. 13 (1974) 117-119 (groups); D. E. Salane,
    Adaptive routines for forming Jacobians numerically, SAND86-1319, 1986 (moves).
    """

    def __init__(self, pattern: Any, typical: FloatArray) -> None:
        n = typical.size
        self._row, self._starts = pattern.indices, pattern.indptr
        self._column = np.repeat(np.arange(n), np.diff(pattern.indptr))
        self._group: NDArray[np.int64] = group_columns(pattern)
        self._typical = typical
        self._share = np.full(n, _EPS**0.5)
        self.evaluations = int(np.max(self._group, initial=-1)) + 1

    def __call__(self, rates: Rates, y: FloatArray, f: FloatArray) -> Any:
        """Return the Jacobian in compressed columns; see :class:`Differences`."""
        size = np.where(f < 0.0, -1.0, 1.0) * np.maximum(self._typical, np.abs(y))
        moves = self._moves(y, size)
        found = self._changes(rates, y, f, moves, np.arange(self._row.size))
        lost = np.flatnonzero(found.largest < LOST * found.size)
        if lost.size:
            further = np.zeros_like(y)
            further[lost] = y[lost] + STRIDE * self._share[lost] * size[lost] - y[lost]
            which = np.flatnonzero(np.isin(self._column, lost))
            self._take_better(found, self._changes(rates, y, f, further, which), lost, which, moves, further)
        self._share[found.largest < SMALL * found.size] *= STRIDE
        self._share[found.largest > LARGE * found.size] *= 1.0 / STRIDE
        np.maximum(self._share, LEAST, out=self._share)
        entries = found.entries / moves[self._column]
        return csc_array((entries, self._row, self._starts), shape=(y.size, y.size))

    def _moves(self, y: FloatArray, size: FloatArray) -> FloatArray:
        """Return the move of each variable, in full although ``y`` rounds it."""
        while True:
            moves: FloatArray = y + self._share * size - y
            none = moves == 0.0
            if not none.any():
                return moves
            self._share[none] *= STRIDE

    def _changes(
        self, rates: Rates, y: FloatArray, f: FloatArray, moves: FloatArray, which: NDArray[np.int64]
    ) -> _Changes:
        """Return the changes of the entries ``which`` by moves, in order: all those of their columns."""
        row, column = self._row[which], self._column[which]
        group = self._group[column]
        there = np.empty(row.size)
        groups = np.flatnonzero(np.bincount(group))
        for some in np.array_split(groups, -(-groups.size * y.size // AT_ONCE) or 1):
            moved = rates(np.where(self._group == some[:, None], y + moves, y).T)
            inside = np.isin(group, some)
            there[inside] = moved[row[inside], np.searchsorted(some, group[inside])]
        entries = there - f[row]
        sizes = np.where(np.isnan(entries), np.inf, np.abs(entries))
        begins = np.flatnonzero(np.diff(column, prepend=-1))
        largest, size = np.zeros_like(y), np.zeros_like(y)
        largest[column[begins]] = np.maximum.reduceat(sizes, begins)
        at = np.flatnonzero(sizes == largest[column])
        at = at[np.searchsorted(at, begins)]  # the first of each column
        size[column[at]] = np.maximum(np.abs(f[row[at]]), np.abs(there[at]))
        return _Changes(entries, largest, size)

    def _take_better(
        self,
        found: _Changes,
        new: _Changes,
        lost: NDArray[np.int64],
        which: NDArray[np.int64],
        moves: FloatArray,
        further: FloatArray,
    ) -> None:
        """Take over, in ``found`` and ``moves``, the columns that stand out more when moved further."""
        better = lost[found.largest[lost] * new.size[lost] < new.largest[lost] * found.size[lost]]
        taken = np.isin(self._column[which], better)
        found.entries[which[taken]] = new.entries[taken]
        for old, other in ((found.largest, new.largest), (found.size, new.size), (moves, further)):
            old[better] = other[better]
        self._share[better] *= STRIDE
