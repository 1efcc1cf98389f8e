"""Key results as quadratics of scattering keys, and by them the cheapest tolerances that keep limits."""

import heapq
import importlib
import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, NoReturn

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.cases.units import from_si
from tribodyn.core.errors import TribodynError
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.search import Limit
from tribodyn.studies.tolerances import Tolerance

_DRAWN: Final = 2**15  #: Samples over which a probability is counted.
_MOST_TRIED: Final = 20_000  #: Choices of steps that are tried.
_MISSED: Final = 0.3  #: Largest part of a number's spread that its quadratic may miss at points left out.
#: Methods in their order with their options: shares of samples have no derivatives on a small scale.
_SEARCHES: Final = {
    "COBYLA": {"rhobeg": 0.5, "tol": 1e-3},
    "SLSQP": {"eps": 3e-2, "maxiter": 20, "ftol": 1e-6},
}
_SAME: Final = 1e-12  #: Relative difference below which costs are equal.


@dataclass(frozen=True)
class Choice:
    """A width for each tolerance."""

    #: As the file names them, and SI.
    labels: tuple[str, ...]
    widths: tuple[float, ...]
    cost: float  #: Sum over all.
    probability: float  #: Share of samples that keep all limits, by the quadratics.


@dataclass(frozen=True)
class Scattering:
    """Keys that scatter by tolerances."""

    tolerances: tuple[Tolerance, ...]  #: What scatters.
    acts: FloatArray  #: Whether a tolerance acts on a key, shape (n_tolerances, n_keys).

    @property
    def span(self) -> FloatArray:
        """Largest deviations of the keys with the widest tolerances [SI], shape (n_keys,)."""
        return 0.5 * np.array([abs(one.share) * one.widest for one in self.tolerances]) @ self.acts

    def draw(self, method: str, samples: int, seed: int) -> FloatArray:
        """Return samples of each tolerance for a width of 1, shape (samples, n_tolerances)."""
        cube = SAMPLERS[method](samples, len(self.tolerances), seed)
        return np.column_stack([one.scatter(cube[:, i]) for i, one in enumerate(self.tolerances)])

    def deviations(self, scatter: FloatArray, widths: Sequence[float]) -> FloatArray:
        """Return deviations of the keys [SI] from such samples, shape (n, n_keys)."""
        return np.asarray(scatter * np.array(widths) @ self.acts)


def are_kept(numbers: FloatArray, limits: Sequence[Limit]) -> NDArray[np.bool_]:
    """Return the mask of rows of numbers, shape (n, n_limits), that keep all limits."""
    return np.asarray(np.all(_excess(numbers, limits) <= 0.0, axis=1))


def _excess(numbers: FloatArray, limits: Sequence[Limit]) -> FloatArray:
    """Return by how much numbers miss their limits, shape of ``numbers``."""
    signs = np.array([-1.0 if one.at_least else 1.0 for one in limits])
    return np.asarray((numbers - np.array([one.value for one in limits])) * signs)


class QuadraticModel:
    """Limited numbers as quadratics of deviations, with the rest as normal noise.

    ``scattering``, ``limits``: what scatters, and what is limited; ``deviations``, ``numbers``: simulated,
    shapes (n, n_keys) [SI] and (n, n_limits). Raises TribodynError if a number is no quadratic: too much of
    its spread is missed at points left out.
    """

    def __init__(
        self, scattering: Scattering, limits: tuple[Limit, ...], deviations: FloatArray, numbers: FloatArray
    ) -> None:
        self._scattering, self._limits, self._span = scattering, limits, scattering.span
        terms = quadratic(deviations / self._span)
        self._factors, *_ = np.linalg.lstsq(terms, numbers, rcond=None)
        hat = np.einsum("ij,ji->i", terms, np.linalg.pinv(terms))
        left_out = (numbers - terms @ self._factors) / (1.0 - np.minimum(hat, 0.999))[:, np.newaxis]
        noise = np.sqrt(np.mean(left_out**2, axis=0))
        self.missed: FloatArray = noise / _or_one(np.std(numbers, axis=0))
        for one, missed in zip(limits, self.missed, strict=True):
            if missed > _MISSED:
                raise TribodynError(
                    f"{one.name} follows no quadratic of the keys within these tolerances: {missed:.0%} of "
                    "its spread is missed; `tribodyn slopes` shows where a number has a slope"
                )
        self._drawn = scattering.draw("sobol", _DRAWN, 1)
        self._rest = np.random.default_rng(2).standard_normal((_DRAWN, len(limits))) * noise
        self._counted: dict[tuple[float, ...], float] = {}

    def cheapest(self, probability: float) -> Choice:
        """Return the cheapest choice with a probability; of equally cheap ones the most probable.

        Raises TribodynError if there is none, or too many would have to be tried.
        """
        curves = self._scattering.tolerances[0].curve is not None
        return self._on_curves(probability) if curves else self._of_steps(probability)

    def known(self, probability: float) -> Choice | None:
        """Return the cheapest choice with a probability, None where there is none."""
        try:
            return self.cheapest(probability)
        except TribodynError:
            return None

    def contributions(self, widths: Sequence[float]) -> FloatArray:
        """Return the part of each tolerance alone in the variance of each number.

        Shape (n_limits, n_tolerances); what is missing to 1 they cause together, or is noise.
        """
        whole = _or_one(np.var(self._numbers(widths), axis=0))
        alone = np.eye(len(widths))[:, np.newaxis] * self._drawn
        parts = [np.var(self._smooth(one, widths), axis=0) for one in alone]
        return np.asarray(np.array(parts).T / whole[:, np.newaxis])

    def _smooth(self, scatter: FloatArray, widths: Sequence[float]) -> FloatArray:
        deviations = self._scattering.deviations(scatter, widths)
        return np.asarray(quadratic(deviations / self._span) @ self._factors)

    def _numbers(self, widths: Sequence[float]) -> FloatArray:
        """Return the numbers at the samples, shape (n_drawn, n_limits)."""
        return np.asarray(self._smooth(self._drawn, widths) + self._rest)

    def _choice(self, labels: tuple[str, ...], widths: tuple[float, ...], cost: float) -> Choice:
        if widths not in self._counted:
            self._counted[widths] = float(np.mean(are_kept(self._numbers(widths), self._limits)))
        return Choice(labels, widths, cost, self._counted[widths])

    def _of_steps(self, probability: float) -> Choice:
        best: Choice | None = None
        for tried, one in enumerate(self._by_cost()):
            if best is not None and one.cost > best.cost * (1.0 + _SAME):
                return best
            if tried == _MOST_TRIED:
                raise TribodynError(f"none of the {_MOST_TRIED} cheapest choices keeps the limits")
            if one.probability >= (probability if best is None else best.probability):
                best = one
        return best or _never(one)

    def _by_cost(self) -> Iterator[Choice]:
        """Yield all choices of steps in the order of their cost."""
        steps = [[(label, *pair) for label, pair in one.steps.items()] for one in self._scattering.tolerances]
        waiting: list[tuple[float, tuple[int, ...]]] = []
        seen = set()

        def add(places: tuple[int, ...]) -> None:
            if places not in seen and all(place < len(of) for place, of in zip(places, steps, strict=True)):
                seen.add(places)
                cost = math.fsum(of[place][2] for place, of in zip(places, steps, strict=True))
                heapq.heappush(waiting, (cost, places))

        add((0,) * len(steps))
        while waiting:
            cost, places = heapq.heappop(waiting)
            labels, widths, _ = zip(
                *(of[place] for place, of in zip(places, steps, strict=True)), strict=True
            )
            yield self._choice(labels, widths, cost)
            for k in range(len(places)):
                add((*places[:k], places[k] + 1, *places[k + 1 :]))

    def _on_curves(self, probability: float) -> Choice:
        """Minimise the cost over the logarithms of widths, by linear and then by quadratic models of it."""
        minimize: Any = importlib.import_module("scipy.optimize").minimize
        tolerances = self._scattering.tolerances
        finest, widest = np.log([one.curve[2:] for one in tolerances if one.curve is not None]).T
        scale = _or_one(np.std(self._numbers(np.exp(widest).tolist()), axis=0))

        def cost(x: FloatArray) -> float:
            return math.fsum(one.cost(width) for one, width in zip(tolerances, np.exp(x), strict=True))

        def reserve(x: FloatArray) -> float:
            excess = _excess(self._numbers(np.exp(x).tolist()), self._limits) / scale
            return -float(np.quantile(np.max(excess, axis=1), probability))

        def choice(x: FloatArray) -> Choice:
            widths = tuple(np.exp(x).tolist())
            return self._choice(
                tuple(from_si(float(f"{width:.3g}"), "um") for width in widths), widths, cost(x)
            )

        if reserve(finest) < 0.0:
            return _never(choice(finest))
        found: FloatArray = finest
        for method, options in _SEARCHES.items():
            found = minimize(
                lambda x: cost(x) / cost(widest),
                found,
                method=method,
                bounds=list(zip(finest.tolist(), widest.tolist(), strict=True)),
                constraints={"type": "ineq", "fun": reserve},
                options=options,
            ).x
        return choice(_last_within(reserve, finest, found))


def _last_within(reserve: Callable[[FloatArray], float], inside: FloatArray, found: FloatArray) -> FloatArray:
    """Return the last point on the way from a point that keeps the limits to one that may just miss them."""
    if reserve(found) >= 0.0:
        return found
    near, far = 0.0, 1.0
    for _ in range(40):
        middle = 0.5 * (near + far)
        kept = reserve(inside + middle * (found - inside)) >= 0.0
        near, far = (middle, far) if kept else (near, middle)
    return inside + near * (found - inside)


def _never(finest: Choice) -> NoReturn:
    raise TribodynError(
        f"not even the finest tolerances keep the limits so often: {finest.probability:.2%} of machines do; "
        "widen a limit, or give finer steps"
    )


def _or_one(numbers: FloatArray) -> FloatArray:
    """Return numbers to divide by, 1 in place of 0."""
    return np.where(numbers > 0.0, numbers, 1.0)


def quadratic(x: FloatArray) -> FloatArray:
    """Return the terms of a quadratic at points of shape (n, n_variables), shape (n, n_terms)."""
    pairs = itertools.combinations_with_replacement(x.T, 2)
    return np.column_stack([np.ones(len(x)), x, *(a * b for a, b in pairs)])
