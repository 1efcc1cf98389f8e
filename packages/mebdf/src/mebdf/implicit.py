"""Fully implicit equations F(t, y, y') = 0 in the solver class for SciPy.

A stage of the MEBDF gives y' = (y − c)/(hβ), so its equation is F(t, y, (y − c)/(hβ)) = 0, and Newton's
matrix ∂F/∂y' + hβ ∂F/∂y: that of M y' = f with M = ∂F/∂y' and J = −∂F/∂y. The compiled core takes these two,
and −F for the rest.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import lstsq, svd
from scipy.sparse import csc_array

from mebdf.algebra import Full
from mebdf.arrays import FloatArray
from mebdf.consistent import Function, changes
from mebdf.differences import DenseDifferences
from mebdf.kernels import state as entry
from mebdf.kernels.phases import FIRST_F, SECOND_F
from mebdf.kernels.state import Mass, MebdfState
from mebdf.mass import MassMatrix

UNCHANGED: Final = 1e-6  #: Relative change of the slope that ends the search for it.
#: Singular value of ∂F/∂y', relative to the largest one, that is zero: differences are no better.
ABSENT: Final = 1e-6
ITERATIONS: Final = 20
#: Change of a slope in differences, relative to it or to what changes the solution by itself.
VARIED: Final = 1e-6
CLEAR: Final = 1e4  #: Least ratio of a difference of F to its rounding.
LARGER: Final = 1e3
MOST_TRIES: Final = 8  #: Factor by which a change is enlarged that does not show, and how often.

Pair = tuple[FloatArray, FloatArray]


class Residual:
    """F(t, y, y') with the slope at which it is evaluated, called as a right-hand side is: it returns −F.

    ``fun``: ``fun(t, y, slope)``, shape (n,); ``slope``: y' at the start, shape (n,); ``jac``: ``jac(t, y,
    slope)`` gives ∂F/∂y and ∂F/∂y', each of shape (n, n); ``None`` for differences; ``n``: number of
    equations.
    """

    def __init__(self, fun: Callable[..., Any], slope: ArrayLike, jac: Any, n: int) -> None:
        if getattr(fun, "__module__", None) == solve_ivp.__module__:
            raise ValueError(
                "`args` are not passed on with `slope`; give `fun` and `jac` as functions of (t, y, slope) "
                "alone, for example `lambda t, y, slope: fun(t, y, slope, *args)`."
            )
        self._fun, self._jac = fun, jac
        self.slope = np.array(slope, dtype=np.float64)
        if self.slope.shape != (n,) or not np.isfinite(self.slope).all():
            raise ValueError(f"`slope` is expected to hold finite numbers, shape {(n,)}.")
        if jac is not None and not callable(jac):
            raise ValueError("`jac` of an implicit equation is a function `jac(t, y, slope)`.")
        self._differences: DenseDifferences | None = None
        self._least: FloatArray | None = None
        self._absent = np.zeros(n, dtype=bool)

    @property
    def evaluations(self) -> int:
        """Number of evaluations of F for a Jacobian."""
        return 0 if self._jac is not None else 2 * self.slope.size

    def __call__(self, t: float, y: FloatArray) -> FloatArray:
        """Return −F at the present slope, shape (n,)."""
        value: FloatArray = -np.asarray(self._fun(t, y.copy(), self.slope.copy()), dtype=np.float64)
        if value.shape != y.shape:
            raise ValueError(f"`fun` is expected to return shape {y.shape}, but returned {value.shape}.")
        return value

    def linearise(self, t: float, y: FloatArray, typical: FloatArray, h: float) -> Pair:
        """Return −∂F/∂y and ∂F/∂y'.

        ``t``, ``y``: where; ``typical``: size of each variable below which it is as good as zero, shape (n,);
        ``h``: time in which a variable of that size comes about.
        """
        if self._jac is not None:
            pair = [
                np.asarray(matrix, dtype=np.float64) for matrix in self._jac(t, y.copy(), self.slope.copy())
            ]
            if [matrix.shape for matrix in pair] != [(y.size, y.size)] * 2:
                raise ValueError(f"`jac` is expected to return two matrices of shape {(y.size, y.size)}.")
            return -pair[0], pair[1]
        f = self(t, y)
        if self._differences is None:
            self._differences = DenseDifferences(typical)
        of_y = self._differences(lambda states: self._columns(t, states), y, f)
        return of_y, -self._of_slope(t, y, f, of_y, VARIED * (np.abs(y) + typical) / abs(h))

    def _columns(self, t: float, states: FloatArray) -> FloatArray:
        return np.array([self(t, y) for y in states.T]).T

    def _of_slope(
        self, t: float, y: FloatArray, f: FloatArray, of_y: FloatArray, least: FloatArray
    ) -> FloatArray:
        """Return the derivative of −F by the slope, by differences.

        A change that does not rise above the rounding of F is enlarged, but not of components that did not
        show at the start, however large it was. What it took there is the least change later.
        """
        rounding = CLEAR * np.finfo(np.float64).eps * (np.abs(of_y) @ np.abs(y) + np.abs(f))
        slope, found = self.slope, np.zeros((y.size, y.size))
        least = least if self._least is None else self._least
        size, unseen = np.maximum(VARIED * np.abs(slope), least), np.arange(y.size)
        for _ in range(MOST_TRIES):
            for j in unseen:
                self.slope = slope.copy()
                self.slope[j] += size[j]
                found[:, j] = self(t, y) - f
            lost = unseen[np.all(np.abs(found[:, unseen]) <= rounding[:, None], axis=0)]
            found[:, lost] = 0.0
            unseen = lost[~self._absent[lost]]
            size[unseen] *= LARGER
        self.slope = slope
        self._absent[unseen] = True
        if self._least is None:
            self._least = np.where(self._absent, least, size)
        return found / size

    def explicit(self, mass: FloatArray) -> Function:
        """Return f of M y' = f(t, y), which agrees with F = 0 beside the present slope to first order.

        ``mass``: M = ∂F/∂y' there, shape (n, n).
        """
        slope = self.slope.copy()

        def fun(t: float, y: FloatArray) -> FloatArray:
            self.slope = slope.copy()
            return mass @ slope + self(t, y)

        return fun

    def move(self, state: MebdfState) -> None:
        """Take the slope at which the core wants an evaluation, or the Jacobian at the newest value."""
        rows = state.rows
        if state.number("phase") in (FIRST_F, SECOND_F):
            self.slope = rows[entry.F_1].copy()
        else:
            self.slope = (rows[entry.Y] - rows[entry.CONSTANT]) / state.number("scaled")

    def move_to_newest(self, state: MebdfState) -> None:
        """Take the slope of the polynomial through the history at its newest value."""
        m = np.arange(1, state.number("k") + 1)
        differences = state.rows[entry.HISTORY + m]
        self.slope = np.sum(differences / m[:, None], axis=0) / state.number("h")

    def consistent(
        self, t: float, y: FloatArray, h: float, tolerances: Pair, names: Sequence[str]
    ) -> tuple[FloatArray, str]:
        """Find values at which F = 0, and the slope; return them and what was changed in words.

        The slope is changed, and of the values those combinations that ∂F/∂y' does not hold.

        ``t``, ``y``: start, and values as given, shape (n,); ``h``: time that is left; ``tolerances``:
        relative and absolute tolerance of each value; ``names``: names of the values.
        """
        rtol, atol = tolerances
        scale, new = atol + rtol * np.abs(y), y.copy()
        for _ in range(ITERATIONS):
            f = self(t, new)
            of_y, of_slope = self.linearise(t, new, atol / rtol, h)
            if not all(np.isfinite(array).all() for array in (f, of_y, of_slope)):
                raise ValueError(f"The equations are not finite at t = {t:g}.")
            step, bend = _corrections(f, of_y, of_slope)
            new, self.slope = new + step, self.slope + bend
            settled = np.maximum(scale / abs(h), UNCHANGED * np.abs(self.slope))
            if np.all(np.abs(step) <= 0.1 * scale) and np.all(np.abs(bend) <= settled):
                break
        self._require(t, new, np.abs(of_y) @ scale + np.abs(of_slope) @ settled)
        changed = np.abs(new - y) > scale
        if not np.any(changed):
            return y, ""
        return new, changes(t, y, new, changed, names)

    def _require(self, t: float, y: FloatArray, allowed: FloatArray) -> None:
        """Refuse values at which an equation is further from holding than ``allowed``, shape (n,)."""
        f = np.abs(self(t, y))
        if np.any(f > allowed):
            worst = int(np.argmax(f - allowed))
            raise ValueError(
                f"The values at t = {t:g} are not consistent: equation {worst} does not hold, "
                "whatever `slope` is; give values that fulfil it."
            )


class ImplicitFull(Full):
    """LU decomposition of LAPACK where the mass matrix changes with the Jacobian.

    ``pair``: ``pair(t, y)``: −∂F/∂y and ∂F/∂y', shape (n, n) each; ``typical``: as for
    :class:`mebdf.algebra.Full`.
    """

    def __init__(self, pair: Callable[[float, FloatArray], Pair], typical: FloatArray) -> None:
        n = typical.size
        super().__init__(pair, csc_array((n, n)), np.zeros(n, dtype=bool), typical)
        self.dense_mass = np.zeros((n, n))

    def linearise(self, t: float, y: FloatArray) -> bool:
        """See :class:`mebdf.algebra.Algebra`."""
        self._newest, mass = self._jacobian(t, y)
        finite = bool(np.isfinite(self._newest).all() and np.isfinite(mass).all())
        if finite:
            self._previous, self._matrix, self.dense_mass = self._matrix, self._newest, mass
            self._mass, self._algebraic = csc_array(mass), ~mass.any(axis=1)
        return finite


def mass_at_start(mass: FloatArray, slope: FloatArray, read: MassMatrix) -> Mass:
    """Return the matrix ∂F/∂y' for the core, with room for any of its later values."""
    n = slope.size
    entries, places = np.zeros(n * n), np.zeros(n + 1 + n * n, dtype=np.int64)
    fill_mass(entries, places, mass)
    return Mass(entries, places, slope.copy(), read.index, read.tested, implicit=True)


def fill_mass(entries: FloatArray, places: NDArray[np.int64], mass: FloatArray) -> None:
    """Write a dense matrix by its rows; those of zeros are left empty."""
    n = mass.shape[0]
    used = mass.any(axis=1)
    places[: n + 1] = np.concatenate(([0], np.cumsum(n * used)))
    size = int(places[n])
    places[n + 1 : n + 1 + size] = np.tile(np.arange(n), int(used.sum()))
    entries[:size] = mass[used].ravel()


def _corrections(f: FloatArray, of_y: FloatArray, of_slope: FloatArray) -> Pair:
    """Return the changes of values and slope by which −F vanishes, where it is ``f``; to first order.

    The equations without slope give what ∂F/∂y' does not hold, the others the slope of least change.
    """
    left, values, right = svd(of_slope)
    rank = int(np.count_nonzero(values > ABSENT * values.max(initial=0.0)))
    constraints, free = left[:, rank:].T, right[rank:].T
    matrix = constraints @ of_y @ free
    matrix[np.abs(matrix) <= ABSENT * np.max(np.abs(of_y), initial=0.0)] = 0.0
    step = free @ lstsq(matrix, -constraints @ f)[0] if free.size else np.zeros_like(f)
    inverse = right[:rank].T @ (left[:, :rank] / values[:rank]).T
    return step, inverse @ (f + of_y @ step)
