"""Where in the unit cube the samples lie, listed once (scipy.stats.qmc)."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray


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
