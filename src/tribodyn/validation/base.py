"""Result of a validation set: numbers with uncertainties and verdicts, curves, and predictions."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray


class Verdict(StrEnum):
    """Verdict on one compared number."""

    WITHIN = "within the band"
    OUTSIDE = "outside"
    REPORTED = "reported only"


class Kind(StrEnum):
    """Kind of check that the numbers of a set are; they are counted apart, never as one sum."""

    PREDICTED = "predicted before measured"
    TABLES = "tables of others"
    FITS = "fits"
    CONSISTENCY = "self-consistency"
    OWN = "your own rig"


Sides: TypeAlias = tuple[float, float]  #: Widths of an interval below and above its value.


@dataclass(frozen=True)
class Band:
    """Acceptance band, fixed before any run.

    Exactly one kind of limit is given.
    """

    name: str  #: Its key in ``set.toml``.
    source: str  #: The text of the source that gives it.
    #: Largest difference of computed and measured value, over the measured value or as it is.
    relative: float | None = None
    absolute: float | None = None
    #: Limits of the computed value, one or both.
    at_least: float | None = None
    at_most: float | None = None
    must_exceed: float | None = None  #: Difference (absolute) that a model expected to fail has to exceed.
    covers: tuple[float, float] | None = None  #: Interval that the computed range has to contain.
    data: str = ""  #: File of the set that gives the limits, where the line names no number.

    def limits(self, measured: float | None) -> tuple[float, float] | None:
        """Return the interval of accepted computed values; None where it is no interval."""
        if self.covers is not None or self.must_exceed is not None:
            return None
        if self.relative is not None or self.absolute is not None:
            if measured is None:
                raise ValueError(f"band {self.name} needs a measured value")
            half = abs(measured) * self.relative if self.relative is not None else self.absolute
            assert half is not None
            return measured - half, measured + half
        low = -math.inf if self.at_least is None else self.at_least
        return low, math.inf if self.at_most is None else self.at_most

    def accepts(self, lowest: float, highest: float, measured: float | None) -> bool:
        """Return whether a computed range is accepted as a whole; ``covers`` asks what it contains."""
        if not (math.isfinite(lowest) and math.isfinite(highest)):
            return False
        if self.covers is not None:
            return bool(lowest <= self.covers[0] and self.covers[1] <= highest)
        if self.must_exceed is not None:
            assert measured is not None
            least = min(abs(lowest - measured), abs(highest - measured))
            return bool(least > self.must_exceed and (lowest - measured) * (highest - measured) > 0.0)
        limits = self.limits(measured)
        assert limits is not None
        return bool(limits[0] <= lowest and highest <= limits[1])


@dataclass(frozen=True)
class Comparison:
    """One number, measured and computed."""

    #: What it is, and the unit of all its values.
    name: str
    unit: str
    computed: float  #: Computed value.
    measured: float | None = None  #: Measured value; None where there is a limit alone.
    #: Half width of the interval of the computed value, or its widths below and above.
    u_computed: float | Sides = 0.0
    u_measured: float = 0.0  #: Half width of the interval of the measured value.
    null: float | None = None  #: What a hand formula or an interpolation gives; None where there is none.
    band: Band | None = None  #: Acceptance band; None if the number is reported only.
    #: Lowest and highest computed value for which the verdict holds; the computed value alone without it.
    spread: tuple[float, float] | None = None
    #: Why a number with a band is reported only: its computation was chosen with the measured values known.
    not_judged: str = ""
    note: str = ""  #: Remark on the number.

    @property
    def sides(self) -> Sides:
        """Widths of the interval of the computed value below and above it."""
        return self.u_computed if isinstance(self.u_computed, tuple) else (self.u_computed, self.u_computed)

    @property
    def error(self) -> float | None:
        """E = |difference| / sqrt(u_c² + u_m²) [1] with u_c on the side of the measured value.

        None without a measured value, or where neither has an uncertainty; infinite where the measured value
        lies on a side to which nothing moves the computed one.
        """
        if self.measured is None or not any((*self.sides, self.u_measured)):
            return None
        difference = abs(self.computed - self.measured)
        width = math.hypot(self.sides[int(self.measured > self.computed)], self.u_measured)
        if width == 0.0:
            return math.inf if difference else 0.0
        return difference / width

    @property
    def null_within(self) -> bool | None:
        """Whether the null model lies within the band; None without one, or with a band for intervals."""
        if self.null is None or self.band is None or self.band.covers is not None:
            return None
        return self.band.accepts(self.null, self.null, self.measured)

    @property
    def verdict(self) -> Verdict:
        """The verdict by the band."""
        if self.band is None or self.not_judged:
            return Verdict.REPORTED
        low, high = self.spread or (self.computed, self.computed)
        return Verdict.WITHIN if self.band.accepts(low, high, self.measured) else Verdict.OUTSIDE


Values: TypeAlias = Sequence[float] | NDArray[np.floating]


@dataclass(frozen=True)
class Curve:
    """A curve or points of a plot."""

    #: Its name, and whether its values are measured, computed or those of the null model.
    label: str
    kind: Literal["measured", "computed", "null"]
    #: Values.
    x: Values
    y: Values
    half_width: Values | None = None  #: Half widths of the intervals of ``y``.


def rms(values: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


@dataclass(frozen=True)
class Plot:
    """The plot of a set: labels of its axes with units, and curves."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]


@dataclass(frozen=True)
class Outcome:
    """Result of a set."""

    comparisons: tuple[Comparison, ...]
    plot: Plot | None = None


@dataclass(frozen=True)
class Prediction:
    """A number stated before its measured value is seen."""

    #: Validation set, what it is, and its unit.
    set: str
    name: str
    unit: str
    #: Value and interval.
    value: float
    low: float
    high: float
    #: Value and interval of the null model.
    null: float
    null_low: float
    null_high: float
    reading: str  #: How the measured value is read.
    half_width: float  #: Half width of that reading.

    @property
    def refuted_by(self) -> str:
        """Measured values that refute the prediction."""
        low, high = self.low - self.half_width, self.high + self.half_width
        return f"a measured value below {low:.4g} or above {high:.4g} {self.unit}"
