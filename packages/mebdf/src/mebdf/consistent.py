"""Consistent values where an integration with a singular mass matrix starts.

The algebraic equations are P f(t, y) = 0, with P the left null space of M. Equations that hold no algebraic
variable are differentiated along the solution, once or twice as the index allows, until they do. What was
differentiated must hold for the values given. The last derivatives give the algebraic variables by Newton's
iteration. Its matrix is P J (M⁺ J)^k Z after k derivatives, where M⁺ gives y' and Z the algebraic directions.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lstsq
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

from mebdf.algebra import is_sparse
from mebdf.arrays import FloatArray
from mebdf.mass import LARGEST, MassMatrix, Split, split

#: Time over which derivatives are differenced, in times that change the solution by itself.
SHORT: Final = (0.0, 1.0e-5, 1.0e-3)
CERTAIN: Final = 4.0  #: Least ratio of a difference that breaks an equation to its own error.
#: Least slope of a derivative that depends on algebraic variables, relative to the steepest.
DEPENDS: Final = 1.0e-7
#: The same of an equation itself, relative to its terms: rounding of differences may look like a slope.
ROUNDING: Final = 2.0e-7
#: Share of the largest singular value below which one of Newton's matrix is rounding of differences.
SINGULAR: Final = 1.0e-7
SOLVED: Final = 0.5  #: Share of the residual that a change may leave to first order.
#: Change, relative to the largest algebraic variable, that is left alone at an index above 1: derivatives are
#: differences.
UNCHANGED: Final = 1.0e-3
#: The same at index 1, relative to the terms of the equation that determines a variable best.
ROUNDED: Final = 1.0e-10
ITERATIONS: Final = 40
MOST_HALVINGS: Final = 30

Function = Callable[[float, FloatArray], FloatArray]
Jacobian = Callable[[float, FloatArray], Any]


def consistent(
    fun: Function,
    jacobian: Jacobian,
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
    fun, jacobian
        Right-hand side, and its Jacobian, shape (n, n), dense or sparse.
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
    parts = split(mass)
    f = fun(t, y)
    if parts.free.shape[1] == 0 or not np.all(np.isfinite(f)):
        return y, parts.slope(f), ""
    start = _Start(fun, jacobian, t, y, t_end, parts, int(mass.index.max()) - 1, names)
    found, least = start.solved(scale)
    changed = np.abs(found - y) > least
    if not np.any(changed):
        return y, parts.slope(f), ""
    new = np.where(changed, found, y)
    return new, parts.slope(fun(t, new)), changes(t, y, new, changed, names)


def changes(
    t: float, y: FloatArray, new: FloatArray, changed: NDArray[np.bool_], names: Sequence[str]
) -> str:
    """Return in words which values at the start were changed."""
    listed = ", ".join(f"{names[int(i)]} from {y[i]:g} to {new[i]:g}" for i in np.flatnonzero(changed))
    return f"The values at t = {t:g} were not consistent; changed {listed}."


class _Start:
    """The equations that values at the start must fulfil."""

    def __init__(
        self,
        fun: Function,
        jacobian: Jacobian,
        t: float,
        y: FloatArray,
        t_end: float,
        parts: Split,
        highest: int,
        names: Sequence[str],
    ) -> None:
        self._names = names
        self._fun, self._jacobian, self._t, self._y, self._parts = fun, jacobian, t, y, parts
        self._highest = highest
        slope = parts.slope(fun(t, y))
        change = float(np.max(np.abs(slope) / (1.0 + np.abs(y)), initial=0.0))
        own = 1.0 / change if change > 0.0 else np.inf
        self._h = float(np.copysign(min(abs(t_end - t), own), t_end - t))

    def derivative(self, y: FloatArray, order: int, share: float = 1.0) -> FloatArray:
        """Return P f, or its first or second derivative along the solution, shape (m,)."""
        fun, t, h, parts = self._fun, self._t, self._h * SHORT[order] * share, self._parts
        f = fun(t, y)
        if order == 0:
            return np.asarray(parts.constraints @ f)
        slope = parts.slope(f)
        bend = np.zeros_like(y)
        if order == 2:
            bend = (parts.slope(fun(t + h, y + h * slope)) - slope) / h
        values = [parts.constraints @ f]
        for k in (1, 2, 3)[: order + 1]:
            s = k * h
            values.append(parts.constraints @ fun(t + s, y + s * slope + 0.5 * s * s * bend))
        weights = (-1.5, 2.0, -0.5) if order == 1 else (2.0, -5.0, 4.0, -1.0)
        difference: FloatArray = np.tensordot(weights, values, axes=1) / h**order
        return difference

    def slopes(self, y: FloatArray) -> tuple[list[Any], NDArray[np.int64]]:
        """Return the change of derivatives with the state, and the index of the one with algebraic variables.

        The slopes of each order have shape (m, n); rows that held algebraic variables before are zero. The
        number of derivatives of each equation, shape (m,), is −1 where none holds an algebraic variable.
        """
        jacobian, parts = self._jacobian(self._t, y), self._parts
        orders = [parts.constraints @ jacobian]
        levels = np.full(orders[0].shape[0], -1)
        for order in range(self._highest + 1):
            steep = _largest(orders[order] @ parts.free)
            least = self._rounding(y, orders[0]) if order == 0 else DEPENDS * np.max(steep)
            levels[(levels < 0) & (steep > least)] = order
            if order == self._highest or np.all(levels >= 0):
                break
            rows = orders[order]
            rows = (rows.toarray() if is_sparse(rows) else np.array(rows)) * (levels < 0)[:, None]
            orders.append(parts.along(rows) @ jacobian)
        return orders, levels

    def _uncertain(self, y: FloatArray, slopes: Any, residual: FloatArray) -> FloatArray:
        """Return the accuracy of each variable from equations with these slopes, shape (n,)."""
        free = self._parts.free
        if self._highest > 0:
            return np.full(y.size, UNCHANGED * np.max(np.abs(free.T @ y)))
        terms = np.maximum(abs(slopes) @ np.abs(y) + np.abs(residual), np.finfo(np.float64).tiny)
        determined = _largest((diags_array(1.0 / terms) @ (slopes @ free)).T)
        return np.asarray(abs(free) @ (ROUNDED / np.maximum(determined, ROUNDED)))

    def _rounding(self, y: FloatArray, slopes: Any) -> FloatArray:
        """Return the rounding of the slopes of equations along algebraic variables, shape (m,)."""
        terms = abs(slopes) @ np.abs(y) + np.abs(self.derivative(y, 0))
        largest = float(np.max(np.abs(self._parts.free.T @ y)))
        return np.asarray(ROUNDING * terms / max(1.0, largest))

    def solved(self, scale: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return values with consistent algebraic variables and the least change that counts, shape (n,)."""
        y = self._y.copy()
        orders, levels = self.slopes(y)
        if not all(np.isfinite(_largest(order)).all() for order in orders):
            raise ValueError(f"{self._broken} and the equations are not finite near by.")
        if np.any(levels < 0):
            raise ValueError(
                f"{self._name(int(np.argmin(levels))).capitalize()} holds no algebraic variable, nor do its "
                f"derivatives: the index is above {self._highest + 1}; give `index`, or check whether the "
                "equations determine the solution."
            )
        for order in range(int(levels.max(initial=0))):
            self._require(order, levels > order, orders[order], scale)
        residual = given = self._leading(y, levels)
        for _ in range(ITERATIONS):
            change = self._change(orders, levels, residual, scale)
            removed = _chosen([order @ change for order in orders], levels)
            if not np.linalg.norm(residual + removed) <= SOLVED * np.linalg.norm(residual):
                break
            least = np.maximum(scale, self._uncertain(y + change, orders[0], residual))
            if np.all(np.abs(change) <= 0.1 * least):
                return y + change, least
            y, residual = self._improved(y, change, residual, levels)
            orders, _ = self.slopes(y)
            if not all(np.isfinite(_largest(order)).all() for order in orders):
                break
        self._require_given(given, levels, scale, change)
        return self._y, scale

    def _require_given(
        self, residual: FloatArray, levels: NDArray[np.int64], scale: FloatArray, change: FloatArray
    ) -> None:
        """Refuse the values given if their residual is not within the tolerances."""
        orders, _ = self.slopes(self._y)
        allowed = _chosen([abs(order) @ scale for order in orders], levels)
        worst = int(np.argmax(np.abs(residual) - allowed))
        if np.abs(residual[worst]) <= allowed[worst]:
            return
        wrong = self._names[int(np.argmax(np.where(np.isfinite(change), np.abs(change) / scale, np.inf)))]
        raise ValueError(
            f"{self._broken}: {self._described(worst, int(levels[worst]))} leaves a residual of "
            f"{residual[worst]:.3g} and no consistent value was found for {wrong}; give values nearer to the "
            "solution."
        )

    def _change(
        self, orders: list[Any], levels: NDArray[np.int64], residual: FloatArray, scale: FloatArray
    ) -> FloatArray:
        """Return the change of algebraic variables that removes a residual to first order, shape (n,).

        What the equations do not determine is left as it is.
        """
        free = self._parts.free
        if free.shape[1] > LARGEST and len(orders) == 1:
            try:
                found: FloatArray = free @ splu(csc_array(orders[0] @ free)).solve(-residual)
            except RuntimeError:  # singular
                return np.full(scale.size, np.nan)
            return found
        matrix = _chosen([_dense(order @ free) for order in orders], levels)
        size = abs(free.T) @ scale
        equation = np.maximum(np.max(np.abs(matrix) * size, axis=1), np.finfo(np.float64).tiny)
        matrix, residual = matrix * size / equation[:, None], -residual / equation
        if not (np.isfinite(matrix).all() and np.isfinite(residual).all()):
            return np.full(scale.size, np.nan)
        scaled = lstsq(matrix, residual, cond=SINGULAR)[0]
        return np.asarray(free @ (size * scaled))

    def _improved(
        self, y: FloatArray, change: FloatArray, residual: FloatArray, levels: NDArray[np.int64]
    ) -> tuple[FloatArray, FloatArray]:
        """Return values a share of the change further, with a smaller residual, and that residual."""
        for halvings in range(MOST_HALVINGS):
            share = 0.5**halvings
            new = y + share * change
            with np.errstate(over="ignore", invalid="ignore"):
                left = self._leading(new, levels)
            if np.all(np.isfinite(left)) and np.linalg.norm(left) < (1.0 - 0.1 * share) * np.linalg.norm(
                residual
            ):
                break
        return new, left

    @property
    def _broken(self) -> str:
        return f"The values at t = {self._t:g} are not consistent"

    def _leading(self, y: FloatArray, levels: NDArray[np.int64]) -> FloatArray:
        """Return of each equation the derivative that holds algebraic variables, shape (m,)."""
        return _chosen([self.derivative(y, k) for k in range(int(levels.max(initial=0)) + 1)], levels)

    def _require(self, order: int, rows: NDArray[np.bool_], slopes: Any, scale: FloatArray) -> None:
        """Refuse values that break equations, or their derivatives, by more than the tolerances."""
        residual = self.derivative(self._y, order)
        rounding = CERTAIN * np.abs(residual - self.derivative(self._y, order, 0.5))
        if not np.all(np.isfinite(residual)):
            raise ValueError(f"{self._broken} and the equations are not finite near by.")
        excess = np.where(rows, np.abs(residual) - np.maximum(rounding, abs(slopes) @ scale), -np.inf)
        worst = int(np.argmax(excess))
        if excess[worst] <= 0.0:
            return
        slope = _dense(slopes[[worst]])[0]
        best = int(np.argmax(np.abs(slope) * scale))
        raise ValueError(
            f"{self._broken}: {self._described(worst, order)} does not hold; it would with "
            f"{self._names[best]} = {self._y[best] - residual[worst] / slope[best]:.6g} instead of "
            f"{self._y[best]:.6g}, for one."
        )

    def _described(self, i: int, order: int) -> str:
        """Return an algebraic equation, or a derivative of it, in words."""
        return ("", "the first derivative of ", "the second derivative of ")[order] + self._name(i)

    def _name(self, i: int) -> str:
        """Return the name of an algebraic equation."""
        return f"equation {int(np.argmax(np.abs(_dense(self._parts.constraints[[i]])[0])))}"


def _dense(matrix: Any) -> FloatArray:
    dense: FloatArray = matrix.toarray() if is_sparse(matrix) else np.asarray(matrix)
    return dense


def _largest(matrix: Any) -> FloatArray:
    """Return the largest absolute entry of each row."""
    largest = abs(matrix).max(axis=1)
    return np.asarray(largest.toarray() if is_sparse(largest) else largest).ravel()


def _chosen(found: list[FloatArray], levels: NDArray[np.int64]) -> FloatArray:
    """Return of each row that of its level."""
    chosen: FloatArray = np.array([found[level][i] for i, level in enumerate(levels)])
    return chosen
