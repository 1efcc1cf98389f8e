"""A measured surface: heights on a regular grid."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final, Self, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError

#: Reads a length with its unit, such as ``0.5 um``, as metres; raises ValueError saying what is wrong.
Length: TypeAlias = Callable[[str], float]

MOST_POINTS: Final = 50_000_000
#: Steps for each point of a profile above which nearly all of it is missing, and no grid is made.
_SPARSEST: Final = 100
_JITTER: Final = 0.05  #: Part of a step by which the points of a profile may stand off equal steps.


@dataclass(frozen=True, eq=False)
class Scan:
    """A profile or a map of heights.

    Parameters
    ----------
    heights
        [m], shape (n,) for a profile, (n_y, n_x) for a map; NaN where nothing was measured.
    spacing
        Distance of neighbouring points [m]: (dx,) or (dy, dx).
    source
        File that it comes from.
    """

    heights: FloatArray
    spacing: tuple[float, ...]
    source: str = ""

    def __post_init__(self) -> None:
        """Refuse an array that is neither a profile nor a map."""
        if self.heights.ndim not in (1, 2) or len(self.spacing) != self.heights.ndim:
            raise InputError("a surface is a line or a table of heights with a spacing for each direction")
        if not all(0.0 < step < math.inf for step in self.spacing):
            raise InputError(f"must be positive and finite, not {self.spacing}", key="spacing")
        if self.heights.size > MOST_POINTS:
            raise InputError(f"the scan has more than {MOST_POINTS} points; cut out a part of it")

    @property
    def is_map(self) -> bool:
        """Whether it has two directions."""
        return self.heights.ndim == 2

    @property
    def extent(self) -> tuple[float, ...]:
        """Length in each direction [m], in the order of ``spacing``."""
        return tuple(step * (n - 1) for step, n in zip(self.spacing, self.heights.shape, strict=True))

    @property
    def missing(self) -> float:
        """Share of points without a height [1]."""
        return float(np.mean(np.isnan(self.heights))) if self.heights.size else 1.0

    def with_heights(self, heights: FloatArray) -> Self:
        """Return the same grid with other heights.

        Parameters
        ----------
        heights
            [m], of the same shape as those of this scan or a smaller one.

        Returns
        -------
        Scan
            With the spacing of this one.

        Raises
        ------
        InputError
            The heights are no grid that a scan can have.
        """
        return replace(self, heights=heights)

    def transposed(self) -> Self:
        """Return the surface with its axes swapped.

        Returns
        -------
        Scan
            Heights of shape (n_y, n_x), spacings in that order.
        """
        return replace(self, heights=self.heights.T, spacing=self.spacing[::-1])


def from_columns(x: FloatArray, heights: FloatArray, source: str) -> Scan:
    """Return the profile of points at equal steps; where whole steps were left out heights are missing.

    ``x``, ``heights``: position and height of every point [m], shape (n,); ``source``: file that they come
    from. Raises InputError if the steps are neither equal nor multiples of one step.
    """
    if x.size < 2:
        raise InputError("a profile of one point says nothing; more points are needed", source=source)
    steps = np.diff(x)
    if not np.all(np.isfinite(x)) or np.any(steps <= 0.0):
        raise InputError(_unsorted(x, steps), source=source)
    span = float(np.ptp(x))
    count = round(span / float(np.median(steps)))
    if count >= min(MOST_POINTS, _SPARSEST * x.size):
        raise InputError(_unequal(steps), source=source)
    places = (x - x[0]) * (count / span)
    index = np.rint(places).astype(np.int64)
    if np.max(np.abs(places - index)) > _JITTER or np.any(np.diff(index) == 0):
        raise InputError(_unequal(steps), source=source)
    grid = np.full(count + 1, np.nan)
    grid[index] = heights
    return Scan(grid, (span / count,), source)


def _unsorted(x: FloatArray, steps: FloatArray) -> str:
    place = int(np.argmax(~(steps > 0.0))) + 2
    return f"x must be a number that grows from point to point; it does not at point {place} of {x.size}"


def _unequal(steps: FloatArray) -> str:
    return (
        f"the points stand at unequal steps, from {steps.min():.4g} m to {steps.max():.4g} m; "
        "resample the profile to equal steps"
    )
