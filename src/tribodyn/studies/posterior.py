"""Posterior distribution of fitted keys by the ensemble sampler of emcee, an optional package.

The logarithm of the likelihood is minus the cost of the fit over its scatter, so that near the best values it
agrees with the covariance of the fit; the prior is uniform over the range of each key
(D. Foreman-Mackey, D. W. Hogg, D. Lang, J. Goodman, Publications of the Astronomical Society of the Pacific
125, 306, 2013).
"""

import importlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.studies.calibration import Calibration
from tribodyn.studies.least_squares import CONFIDENCE, LeastSquares, cost_of

OPTION: Final = "--posterior"
LEAST_STEPS: Final = 10
SAMPLES: Final = "posterior.csv"
#: Steps over the autocorrelation time from which on the latter, and the quantiles, can be trusted.
_LONG: Final = 50.0
_SPREAD: Final = 1e-3  #: Least spread of the first walkers, as a share of the range.


@dataclass(frozen=True)
class Posterior:
    """Samples of a posterior distribution."""

    paths: tuple[str, ...]  #: Keys.
    #: Values of the keys [SI], shape (n_samples, n); the first half of the chain is left out.
    samples: FloatArray
    correlation_time: float  #: Largest autocorrelation time of a key [steps].
    steps: int  #: Steps of the chain.

    def interval(self, which: int) -> tuple[float, float]:
        """Return the central 95 % interval of a key [SI]."""
        ends = np.quantile(self.samples[:, which], [0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE])
        return float(ends[0]), float(ends[1])

    @property
    def statements(self) -> list[str]:
        """Sentences on whether the chain was long enough."""
        if self.steps >= _LONG * self.correlation_time:
            return []
        return [
            f"The chain of the posterior has {self.steps} steps, {self.steps / self.correlation_time:.2g} "
            f"autocorrelation times: below {_LONG:g} its intervals are rough. Give more steps to {OPTION}."
        ]

    def table(self) -> str:
        """Return all samples as CSV, SI units."""
        rows = (",".join(f"{value:.9g}" for value in sample) for sample in self.samples.tolist())
        return "\n".join([",".join(self.paths), *rows]) + "\n"


def sampler_package() -> Any:
    """Return the module emcee.

    Raises InputError if it is not installed.
    """
    try:
        return importlib.import_module("emcee")
    except ImportError as error:
        raise InputError(
            "posterior distributions need the package emcee: install tribodyn[posterior], or leave out the "
            "option",
            key=OPTION,
        ) from error


def sample(calibration: Calibration, found: LeastSquares, steps: int, seed: int = 0) -> Posterior:
    """Sample the posterior distribution around a fit.

    ``calibration``, ``found``: the fit, with its noise; ``steps``: steps of each walker, :data:`LEAST_STEPS`
    or more; there are two walkers for each key and two more; ``seed``: of the random numbers: the same seed
    gives the same chain, also after an interruption. Raises InputError if emcee is not installed, or there
    are too few steps.
    """
    emcee = sampler_package()
    if steps < LEAST_STEPS:
        raise InputError(f"given {steps} steps; allowed: {LEAST_STEPS} or more", key=OPTION)
    names = [one.name for one in found.parameters]
    walkers = 2 * len(names) + 2

    def logarithm(shares: FloatArray) -> float:
        if np.any(shares < 1.0) or np.any(shares > 2.0):
            return -math.inf
        given = dict(zip(names, map(float, shares), strict=True))
        return -cost_of(calibration.residuals(given), found.loss) / found.scatter

    chain = emcee.EnsembleSampler(walkers, len(names), logarithm)
    state = np.random.RandomState(seed)
    deviations = np.maximum(np.sqrt(np.diag(found.covariance())), _SPREAD)
    first = found.values + deviations * state.standard_normal((walkers, len(names)))
    begin = emcee.State(np.clip(first, 1.0 + 1e-9, 2.0 - 1e-9), random_state=state.get_state())
    chain.run_mcmc(begin, steps)
    shares = chain.get_chain(discard=steps // 2, flat=True) - 1.0
    times = chain.get_autocorr_time(tol=0)
    return Posterior(
        tuple(one.key.path for one in calibration.keys),
        _values(calibration, shares),
        float(np.nanmax(times)) if np.isfinite(times).any() else float(steps),
        steps,
    )


def _values(calibration: Calibration, shares: Sequence[Sequence[float]] | FloatArray) -> FloatArray:
    """Return values of the keys [SI] from shares of their ranges, shape (n_samples, n)."""
    low = np.array([one.low for one in calibration.keys])
    high = np.array([one.high for one in calibration.keys])
    return np.asarray(low + np.asarray(shares) * (high - low))
