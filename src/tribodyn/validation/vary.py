"""Uncertainty of computed values: assumed inputs varied to both ends of their bands, one at a time."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.validation.base import Sides
from tribodyn.validation.catalogue import Input


@dataclass(frozen=True)
class Varied:
    """Values at the inputs and at the ends of their bands.

    Attributes
    ----------
    values
        At the inputs as given, shape (n,).
    ends
        By input: values at the lower and the upper end of its band, shape (2, n).
    """

    values: FloatArray
    ends: Mapping[str, FloatArray]

    @property
    def sides(self) -> FloatArray:
        """Widths of the intervals below and above the values, shape (2, n); see :func:`sides_of`."""
        return sides_of(self.values, self.ends.values())

    def sides_at(self, k: int) -> Sides:
        """Return the widths of the interval of one value, below and above it."""
        below, above = self.sides[:, k]
        return float(below), float(above)

    def spread(self, *names: str) -> FloatArray:
        """Return the lowest and highest values over the bands of some inputs, shape (2, n)."""
        values = np.vstack([self.values, *(self.ends[name] for name in names)])
        return np.array([values.min(axis=0), values.max(axis=0)])


def sides_of(values: FloatArray, ends: Iterable[FloatArray]) -> FloatArray:
    """Return the root sum of squares of the largest changes by each input, below and above the values.

    An input that only lowers a value widens its interval below and not above.

    Parameters
    ----------
    values
        Shape (n,).
    ends
        For each input the values at other inputs, shape (m, n).

    Returns
    -------
    FloatArray
        Shape (2, n).
    """
    squares = np.zeros((2, *values.shape))
    for found in ends:
        change = found - values
        squares += np.square([np.minimum(change, 0.0).min(axis=0), np.maximum(change, 0.0).max(axis=0)])
    return np.asarray(np.sqrt(squares))


def varied(compute: Callable[[Mapping[str, float]], FloatArray], inputs: Iterable[Input]) -> Varied:
    """Return values of a function at inputs and at the ends of their bands, one input at a time.

    Parameters
    ----------
    compute
        From inputs by name [SI] to values, shape (n,).
    inputs
        The inputs; those without a band keep their value.
    """
    known = list(inputs)
    given = {one.name: one.value for one in known}
    ends = {
        one.name: np.array([compute(given | {one.name: end}) for end in (one.low, one.high)])
        for one in known
        if one.low != one.high
    }
    return Varied(compute(given), ends)
