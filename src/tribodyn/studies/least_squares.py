"""Least squares from several starts, with covariance and confidence intervals."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from scipy import optimize, stats

from mebdf.arrays import FloatArray

Loss = Literal["linear", "soft_l1"]
STARTS: Final = 8
CONFIDENCE: Final = 0.95


@dataclass(frozen=True)
class FitParameter:
    """A parameter of a fit."""

    name: str  #: Its name.
    #: Bounds; starts are spread between them.
    low: float
    high: float
    logarithmic: bool = False  #: Whether starts are spread evenly in its logarithm.

    def at(self, share: float) -> float:
        """Return the value at a share of the range [1], 0 at the lower bound."""
        if self.logarithmic:
            return float(self.low * (self.high / self.low) ** share)
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True)
class LeastSquares:
    """Fitted parameters."""

    parameters: tuple[FitParameter, ...]  #: What was fitted.
    values: FloatArray  #: Fitted values, shape (n,).
    residuals: FloatArray  #: Residuals there, over the uncertainty of the data, shape (m,).
    #: Derivatives of the residuals, shape (m, n); of a robust fit times √ψ', so that JᵀJ is the Hessian of
    #: the cost.
    jacobian: FloatArray
    cost: float  #: Half the sum of the losses.
    loss: Loss = "linear"  #: The loss.

    @property
    def named(self) -> dict[str, float]:
        """Fitted values by name."""
        names = (parameter.name for parameter in self.parameters)
        return dict(zip(names, map(float, self.values), strict=True))

    @property
    def freedoms(self) -> int:
        """Number of data less that of parameters, at least 1."""
        return max(self.residuals.size - self.values.size, 1)

    @property
    def scatter(self) -> float:
        """Mean square of the residuals per degree of freedom, or what takes its place under a robust loss.

        With the slope ψ of the loss the covariance of an M-estimate is (Σψ²/(m - n))/⟨ψ'⟩² times the inverse
        of JᵀJ (P. J. Huber, Robust Statistics, 1981, section 7.6); one ⟨ψ'⟩ is in :attr:`jacobian` already.
        """
        if self.loss == "linear":
            return float(self.residuals @ self.residuals) / self.freedoms
        steepness = 1.0 + self.residuals**2
        squares = float(np.sum(self.residuals**2 / steepness))
        return squares / self.freedoms / float(np.mean(steepness**-1.5))

    def covariance(self, *, known_noise: bool = False) -> FloatArray:
        """Return the covariance of the parameters, shape (n, n).

        ``known_noise``: whether residuals are over the true uncertainty of the data; otherwise their scatter
        gives it.
        """
        inverse = np.linalg.pinv(self.jacobian.T @ self.jacobian)
        return np.asarray((1.0 if known_noise else self.scatter) * inverse)

    def half_width(self, name: str, *, known_noise: bool = False) -> float:
        """Return the half width of the 95 % interval of a parameter, from the covariance."""
        k = [parameter.name for parameter in self.parameters].index(name)
        factor = stats.norm.ppf(0.5 + 0.5 * CONFIDENCE)
        if not known_noise:
            factor = stats.t.ppf(0.5 + 0.5 * CONFIDENCE, self.freedoms)
        return float(factor * np.sqrt(self.covariance(known_noise=known_noise)[k, k]))

    def interval(self, name: str, *, known_noise: bool = False) -> tuple[float, float]:
        """Return the 95 % interval of a parameter, from the covariance."""
        value, half = self.named[name], self.half_width(name, known_noise=known_noise)
        return value - half, value + half


def fit(
    residuals: Callable[[Mapping[str, float]], FloatArray],
    parameters: Sequence[FitParameter],
    *,
    starts: int = STARTS,
    loss: Loss = "linear",
    start: Mapping[str, float] | None = None,
    step: float | None = None,
    tolerance: float = 1e-8,
) -> LeastSquares:
    """Fit parameters by least squares, from the best of several starts.

    ``residuals``: from parameters by name to residuals over the uncertainty of the data, shape (m,);
    ``starts``: their number, the middle of the bounds, then points of a Halton sequence; ``loss``: ``linear``
    for least squares, ``soft_l1`` for a fit that single outliers hardly move; ``start``: values to begin
    with, instead of the starts; ``step``: of the differences that give derivatives, relative to the
    parameters, tiny by default; ``tolerance``: relative change of cost and parameters at which a fit ends.
    """
    names = [parameter.name for parameter in parameters]
    bounds = np.array([[parameter.low, parameter.high] for parameter in parameters]).T
    places = starting_points(parameters, starts) if start is None else [[start[name] for name in names]]

    def of_values(values: FloatArray) -> FloatArray:
        return residuals(dict(zip(names, map(float, values), strict=True)))

    best: Any = None
    for place in places:
        found = optimize.least_squares(
            of_values,
            place,
            bounds=(bounds[0], bounds[1]),
            loss=loss,
            x_scale="jac",
            diff_step=None if step is None else [step] * len(names),
            ftol=tolerance,
            xtol=tolerance,
        )
        if best is None or found.cost < best.cost:
            best = found
    return LeastSquares(
        tuple(parameters), np.array(best.x), np.array(best.fun), np.array(best.jac), float(best.cost), loss
    )


def cost_of(residuals: FloatArray, loss: Loss) -> float:
    """Return half the sum of the losses of residuals, shape (m,)."""
    squares = residuals**2
    return 0.5 * float(np.sum(squares if loss == "linear" else 2.0 * (np.sqrt(1.0 + squares) - 1.0)))


def starting_points(parameters: Sequence[FitParameter], starts: int) -> list[list[float]]:
    """Return points inside the bounds: the middle, then a Halton sequence; always the same ones."""
    shares = stats.qmc.Halton(len(parameters), scramble=False).random(starts)
    shares = np.clip(np.vstack([np.full((1, len(parameters)), 0.5), shares[1:]]), 0.02, 0.98)
    return [[one.at(float(share)) for one, share in zip(parameters, row, strict=True)] for row in shares]
