"""Uncertainty of computed values: assumed inputs varied to both ends of their bands, one at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
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
    def half_widths(self) -> FloatArray:
        """Root sum of squares of the largest change by each input, shape (n,)."""
        changes = [np.abs(ends - self.values).max(axis=0) for ends in self.ends.values()]
        return np.asarray(np.sqrt(np.sum(np.square(changes), axis=0))) if changes else 0.0 * self.values

    def spread(self, *names: str) -> FloatArray:
        """Return the lowest and highest values over the bands of some inputs, shape (2, n)."""
        values = np.vstack([self.values, *(self.ends[name] for name in names)])
        return np.array([values.min(axis=0), values.max(axis=0)])


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
