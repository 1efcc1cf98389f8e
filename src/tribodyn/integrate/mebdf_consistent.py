"""Consistent values where an integration with a singular mass matrix starts.

The algebraic equations are P f(t, y) = 0, with P the left null space of M. Equations that hold no algebraic
variable are differentiated along the solution, once or twice as the index allows, until they do; what was
differentiated must hold for the values given, and the last derivatives give the algebraic variables.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lstsq, svd
from scipy.sparse.linalg import splu

from tribodyn.core.arrays import FloatArray
from tribodyn.integrate.mebdf_mass import MassMatrix

LARGEST: Final = 500
"""Number of equations up to which values are checked and found: every one is varied."""
VARIATION: Final = (1.0e-6, 1.0e-3, 1.0)
"""Change of a value that shows in equations, their first and their second derivatives; relative, or to one.

Where second derivatives hold algebraic variables they do so linearly, and rounding is large.
"""
SHORT: Final = (0.0, 1.0e-5, 1.0e-3)
"""Time over which derivatives are differenced, in times that change the solution by itself."""
CERTAIN: Final = 4.0
"""How many times as large as its own error a difference must be to break an equation."""
DEPENDS: Final = 1.0e-7
"""Least slope of a derivative that depends on algebraic variables, relative to the steepest."""
ROUNDING: Final = 1.0e3 * float(np.finfo(np.float64).eps)
"""The same of an equation itself, relative to the terms whose rounding may look like a slope."""
UNCHANGED: Final = 1.0e-3
"""Change, relative to the largest algebraic variable, that is left alone: differences are no better."""
ITERATIONS: Final = 40
MOST_HALVINGS: Final = 30

Function = Callable[[float, FloatArray], FloatArray]


def consistent(
    fun: Function,
    t: float,
    y: FloatArray,
    t_end: float,
    mass: MassMatrix,
    scale: FloatArray,
    names: Sequence[str],
) -> tuple[FloatArray, FloatArray, str]:
    """Return consistent values, y' there, and what was changed in words, empty if nothing was.

    Parameters
    ----------
    fun
        Right-hand side.
    t, y
        Start, and values as given, shape (n,).
    t_end
        End, to whose side of ``t`` the right-hand side is evaluated.
    mass
        Mass matrix.
    scale
        Error of each value that its tolerance allows, shape (n,).
    names
        Names of the values.

    Raises
    ------
    ValueError
        If equations without algebraic variables, or their derivatives, do not hold.
    """
    split = _split(mass, y.size)
    f = fun(t, y)
    if split.free.shape[1] == 0 or y.size > LARGEST or not np.all(np.isfinite(f)):
        return y, split.slope(f), ""
    start = _Start(fun, t, y, t_end, split, int(mass.index.max()) - 1, names)
    found = start.solved(scale)
    changed = np.abs(found - y) > np.maximum(scale, UNCHANGED * np.max(np.abs(split.free.T @ found)))
    if not np.any(changed):
        return y, split.slope(f), ""
    new = np.where(changed, found, y)
    changes = ", ".join(f"{names[int(i)]} from {y[i]:g} to {new[i]:g}" for i in np.flatnonzero(changed))
    told = f"The values at t = {t:g} were not consistent; changed {changes}."
    return new, split.slope(fun(t, new)), told


@dataclass(frozen=True)
class _Split:
    """What a singular mass matrix leaves algebraic.

    Attributes
    ----------
    constraints
        P: combinations of equations without derivatives, shape (m, n).
    free
        Directions in which M does not hold the state, shape (n, m).
    slope
        Returns y' of least size for M y' = f.
    """

    constraints: FloatArray
    free: FloatArray
    slope: Callable[[FloatArray], FloatArray]


def _split(mass: MassMatrix, n: int) -> _Split:
    """Split equations and variables; by rows and columns of zeros where that is all."""
    equations, variables = ~mass.algebraic_equations, ~mass.algebraic_variables
    if np.count_nonzero(equations) == np.count_nonzero(variables):
        try:
            factors: Any = splu(mass.matrix[equations][:, variables].tocsc()) if equations.any() else None
        except RuntimeError:  # singular
            factors = None
        if factors is not None or not equations.any():

            def slope(f: FloatArray) -> FloatArray:
                y = np.zeros(n)
                if factors is not None:
                    y[variables] = factors.solve(f[equations])
                return y

            if n > LARGEST:
                return _Split(np.zeros((0, n)), np.zeros((n, 0)), slope)
            unit = np.eye(n)
            return _Split(unit[~equations], unit[:, ~variables], slope)
    if n > LARGEST:
        raise ValueError(f"`mass` of more than {LARGEST} equations must be singular by rows of zeros alone.")
    left, values, right = svd(mass.matrix.toarray())
    rank = int(np.count_nonzero(values > n * np.finfo(np.float64).eps * values.max(initial=0.0)))
    inverse = right[:rank].T @ (left[:, :rank] / values[:rank]).T
    return _Split(left[:, rank:].T, right[rank:].T, lambda f: inverse @ f)


class _Start:
    """The equations that values at the start must fulfil."""

    def __init__(
        self,
        fun: Function,
        t: float,
        y: FloatArray,
        t_end: float,
        split: _Split,
        highest: int,
        names: Sequence[str],
    ) -> None:
        self._names = names
        self._fun, self._t, self._y, self._split = fun, t, y, split
        self._highest = highest
        slope = split.slope(fun(t, y))
        change = float(np.max(np.abs(slope) / (1.0 + np.abs(y)), initial=0.0))
        own = 1.0 / change if change > 0.0 else np.inf
        self._h = float(np.copysign(min(abs(t_end - t), own), t_end - t))

    def derivative(self, y: FloatArray, order: int, share: float = 1.0) -> FloatArray:
        """Return P f, or its first or second derivative along the solution, shape (m,)."""
        fun, t, h, split = self._fun, self._t, self._h * SHORT[order] * share, self._split
        f = fun(t, y)
        if order == 0:
            return split.constraints @ f
        slope = split.slope(f)
        bend = np.zeros_like(y)
        if order == 2:
            bend = (split.slope(fun(t + h, y + h * slope)) - slope) / h
        values = [split.constraints @ f]
        for k in (1, 2, 3)[: order + 1]:
            s = k * h
            values.append(split.constraints @ fun(t + s, y + s * slope + 0.5 * s * s * bend))
        weights = (-1.5, 2.0, -0.5) if order == 1 else (2.0, -5.0, 4.0, -1.0)
        difference: FloatArray = np.tensordot(weights, values, axes=1) / h**order
        return difference

    def slopes(self, y: FloatArray, order: int, directions: FloatArray) -> FloatArray:
        """Return how a derivative changes along each column of ``directions``, shape (m, columns)."""
        base = self.derivative(y, order)
        found = np.empty((base.size, directions.shape[1]))
        size = self._variation(y, order, directions)
        for k, direction in enumerate(directions.T):
            found[:, k] = (self.derivative(y + size * direction, order) - base) / size
        return found

    def _variation(self, y: FloatArray, order: int, directions: FloatArray) -> float:
        return VARIATION[order] * max(1.0, float(np.max(np.abs(directions.T @ y))))

    def levels(self, y: FloatArray) -> NDArray[np.int64]:
        """Return how often each equation must be differentiated until it holds an algebraic variable."""
        levels = np.full(len(self._split.constraints), -1)
        for order in range(self._highest + 1):
            steep = np.max(np.abs(self.slopes(y, order, self._split.free)), axis=1)
            least = self._rounding(y) if order == 0 else DEPENDS * np.max(steep)
            levels[(levels < 0) & (steep > least)] = order
        return levels

    def _rounding(self, y: FloatArray) -> FloatArray:
        """Return what rounding may leave of the slopes of equations along algebraic variables, shape (m,)."""
        terms = np.abs(self.slopes(y, 0, np.eye(y.size))) @ np.abs(y) + np.abs(self.derivative(y, 0))
        least: FloatArray = ROUNDING * terms / self._variation(y, 0, self._split.free)
        return least

    def solved(self, scale: FloatArray) -> FloatArray:
        """Return values with consistent algebraic variables, shape (n,)."""
        y, levels = self._y.copy(), self.levels(self._y)
        if np.any(levels < 0):
            equation = self._name(int(np.argmin(levels))).capitalize()
            raise ValueError(
                f"{equation} holds no algebraic variable, nor do its derivatives: the index is above "
                f"{self._highest + 1}, to be told by `index`, or the equations do not determine the solution."
            )
        for order in range(int(levels.max(initial=0))):
            self._require(order, levels > order, scale)
        residual = self._leading(y, levels, self.derivative)
        for _ in range(ITERATIONS):
            matrix = self._leading(y, levels, lambda at, order: self.slopes(at, order, self._split.free))
            if not np.all(np.isfinite(matrix)) or not np.all(np.isfinite(residual)):
                raise ValueError(f"{self._broken} and the equations are not finite near by.")
            change = self._split.free @ lstsq(matrix, -residual)[0]
            size = np.max(np.abs(self._split.free.T @ (y + change)))
            if np.all(np.abs(change) <= np.maximum(0.1 * scale, 0.1 * UNCHANGED * size)):
                return y + change
            y, residual = self._improved(y, change, residual, levels)
        worst = int(np.argmax(np.abs(change) / scale))
        raise ValueError(f"{self._broken} and no consistent value was found for {self._names[worst]}.")

    def _improved(
        self, y: FloatArray, change: FloatArray, residual: FloatArray, levels: NDArray[np.int64]
    ) -> tuple[FloatArray, FloatArray]:
        """Return values a share of the change further, with a smaller residual, and that residual."""
        for halvings in range(MOST_HALVINGS):
            share = 0.5**halvings
            new = y + share * change
            with np.errstate(over="ignore", invalid="ignore"):
                left = self._leading(new, levels, self.derivative)
            if np.all(np.isfinite(left)) and np.linalg.norm(left) < (1.0 - 0.1 * share) * np.linalg.norm(
                residual
            ):
                break
        return new, left

    @property
    def _broken(self) -> str:
        return f"The values at t = {self._t:g} are not consistent"

    def _leading(
        self,
        y: FloatArray,
        levels: NDArray[np.int64],
        evaluate: Callable[[FloatArray, int], FloatArray],
    ) -> FloatArray:
        """Return of each equation what belongs to the derivative that holds algebraic variables."""
        found = [evaluate(y, order) for order in range(int(levels.max(initial=0)) + 1)]
        chosen: FloatArray = np.array([found[level][i] for i, level in enumerate(levels)])
        return chosen

    def _require(self, order: int, rows: NDArray[np.bool_], scale: FloatArray) -> None:
        """Refuse values that break equations, or their derivatives, by more than the tolerances."""
        residual = self.derivative(self._y, order)[rows]
        rounding = CERTAIN * np.abs(residual - self.derivative(self._y, order, 0.5)[rows])
        residual[np.abs(residual) <= rounding] = 0.0
        slopes = self.slopes(self._y, order, np.eye(self._y.size))[rows]
        if not np.all(np.isfinite(slopes)) or not np.all(np.isfinite(residual)):
            raise ValueError(f"{self._broken} and the equations are not finite near by.")
        change = scale * lstsq(slopes * scale, -residual)[0]
        worst = int(np.argmax(np.abs(change) / scale))
        if np.abs(change[worst]) <= scale[worst]:
            return
        equation = self._name(int(np.flatnonzero(rows)[np.argmax(np.abs(residual))]))
        what = ("", "the first derivative of ")[order]
        raise ValueError(
            f"{self._broken}: {what}{equation} does not hold; it would with {self._names[worst]} = "
            f"{self._y[worst] + change[worst]:.6g} instead of {self._y[worst]:.6g}, for one."
        )

    def _name(self, i: int) -> str:
        """Return the name of an algebraic equation."""
        equation = int(np.argmax(np.abs(self._split.constraints[i])))
        return f"equation {equation}"
