"""Samples of a sweep: the samplers, and the distributions that parameters are drawn from, each listed once.

All arguments of a distribution are values of the parameter itself, in its unit: ``lognormal(20 um, 2 um)``
has a mean of 20 µm and a standard deviation of 2 µm. Formulas of the underlying laws: scipy.stats, imported
only where something is drawn, because that takes long.
"""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray


def latin_hypercube(samples: int, dimensions: int, seed: int) -> FloatArray:
    """Return points of which each coordinate has one in every ``1/samples`` of its range.

    McKay, Beckman, Conover, Technometrics 21 (1979) 239.
    """
    from scipy.stats import qmc

    sampler = qmc.LatinHypercube(dimensions, seed=np.random.default_rng(seed))
    return np.asarray(sampler.random(samples))


def sobol(samples: int, dimensions: int, seed: int) -> FloatArray:
    """Return the first points of a scrambled Sobol sequence: more samples keep those already taken.

    Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86; scrambling: Owen, J. Complexity 14 (1998) 466.
    """
    from scipy.stats import qmc

    sampler = qmc.Sobol(dimensions, scramble=True, seed=np.random.default_rng(seed))
    with warnings.catch_warnings():
        # Any number may be asked for; the manual says why powers of two are best.
        warnings.filterwarnings("ignore", message="The balance properties of Sobol")
        return np.asarray(sampler.random(samples))


def saltelli(samples: int, dimensions: int, seed: int) -> FloatArray:
    """Return the points that Sobol' indices are made of: A, B, and A with each column of B in turn.

    Saltelli et al., Comput. Phys. Commun. 181 (2010) 259. These are ``samples·(dimensions + 2)`` points.
    """
    both = sobol(samples, 2 * dimensions, seed)
    a, b = both[:, :dimensions], both[:, dimensions:]
    columns = np.eye(dimensions, dtype=bool)
    return np.concatenate([a, b, *(np.where(column, b, a) for column in columns)])


SAMPLERS: Final[dict[str, Callable[[int, int, int], FloatArray]]] = {
    "lhs": latin_hypercube,
    "sobol": sobol,
    "saltelli": saltelli,
}
"""Every sampler by the name it has after ``--method``.

Takes the number of samples, of dimensions, and a seed; returns shape (samples, dimensions), of ``saltelli``
(samples·(dimensions + 2), dimensions).
"""


#: Least distance of a probability from 0 and 1, where an unbounded distribution is infinite.
_EDGE: Final = 1e-12


class DistributionProblem(ValueError):
    """The arguments give no distribution; the message says why."""


@dataclass(frozen=True)
class Distribution:
    """One family of distributions."""

    arguments: tuple[str, ...]  #: Names of the arguments, in order.
    optional: tuple[str, ...]  #: Names of further arguments, given all or not at all.
    frozen: Callable[..., Any]  #: Returns the distribution with its arguments, as SciPy has it.

    @property
    def usage(self) -> str:
        """The arguments as a person writes them."""
        required = ", ".join(self.arguments)
        return f"({required}[, {', '.join(self.optional)}])" if self.optional else f"({required})"

    def quantiles(self, arguments: tuple[float, ...], probabilities: FloatArray) -> FloatArray:
        """Return the values below which the given shares of a population lie.

        ``arguments``: as many as :attr:`arguments`, or with all :attr:`optional` ones; ``probabilities``:
        between 0 and 1, any shape. Raises DistributionProblem if there is no such distribution.
        """
        counts = {len(self.arguments), len(self.arguments) + len(self.optional)}
        if len(arguments) not in counts:
            raise DistributionProblem(f"{len(arguments)} arguments are given")
        law = self.frozen(*arguments)
        return np.asarray(law.ppf(np.clip(probabilities, _EDGE, 1.0 - _EDGE)))


def _demand(condition: bool, message: str) -> None:
    if not condition:
        raise DistributionProblem(message)


def _normal(mean: float, deviation: float, least: float = -math.inf, most: float = math.inf) -> Any:
    from scipy import stats

    _demand(deviation > 0.0, "the standard deviation must be above 0")
    _demand(least < most, "the least value must be below the largest")
    if math.isinf(least) and math.isinf(most):
        return stats.norm(mean, deviation)
    low, high = (least - mean) / deviation, (most - mean) / deviation
    return stats.truncnorm(low, high, loc=mean, scale=deviation)


def _lognormal(mean: float, deviation: float) -> Any:
    from scipy import stats

    _demand(mean > 0.0 and deviation > 0.0, "mean and standard deviation must be above 0")
    spread = math.log1p((deviation / mean) ** 2)
    return stats.lognorm(math.sqrt(spread), scale=mean * math.exp(-0.5 * spread))


def _uniform(least: float, most: float) -> Any:
    from scipy import stats

    _demand(least < most, "the least value must be below the largest")
    return stats.uniform(least, most - least)


def _triangular(least: float, likeliest: float, most: float) -> Any:
    from scipy import stats

    _demand(least < most, "the least value must be below the largest")
    _demand(least <= likeliest <= most, "the likeliest value must lie between the least and the largest")
    return stats.triang((likeliest - least) / (most - least), loc=least, scale=most - least)


#: Every distribution by the name it has after ``--vary PATH=``.
DISTRIBUTIONS: Final[dict[str, Distribution]] = {
    "normal": Distribution(("mean", "deviation"), ("least", "most"), _normal),
    "lognormal": Distribution(("mean", "deviation"), (), _lognormal),
    "uniform": Distribution(("least", "most"), (), _uniform),
    "triangular": Distribution(("least", "likeliest", "most"), (), _triangular),
}
