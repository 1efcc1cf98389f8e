"""Errors of the copies of a pattern around their axis, and the copy furthest from the mean."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.mechanism.results.copies import copies_of, over_time, worst
from tribodyn.results.reading import column, settled
from tribodyn.results.variables import ERROR_UNITS
from tribodyn.views.charts import ChartCurve, Panel, over
from tribodyn.views.section import Payload, Section, choice

_ROOM: Final = 0.6  #: Radius of the inner circle over the range of all errors.
_AROUND: Final = 181  #: Points of a circle.


@dataclass(frozen=True)
class Around:
    """Errors of the copies of an output, at the angle of each."""

    name: str  #: Of the output.
    unit: str  #: Of the errors.
    angles: FloatArray  #: Of the copies, clockwise from above [rad], shape (n,).
    #: Least, largest and mean error over time, shape (n,).
    low: FloatArray
    high: FloatArray
    mean: FloatArray
    worst: int  #: Place of the copy furthest from the mean.
    limit: float  #: Of the error; NaN without one.

    @property
    def span(self) -> float:
        """Range of all errors."""
        return max(float(self.high.max() - self.low.min()), np.finfo(float).tiny)

    @property
    def middle(self) -> float:
        """Error in the middle of the picture."""
        return float(self.low.min()) - _ROOM * self.span

    def curve(
        self, name: str, angles: FloatArray, errors: FloatArray, colour: str, dash: str = "solid"
    ) -> ChartCurve:
        """Return a curve through errors at angles; it has a gap where the error is NaN."""
        way = errors - self.middle
        return ChartCurve(name, way * np.cos(angles), colour, dash, x=np.nan_to_num(way * np.sin(angles)))


def around(dataset: xr.Dataset) -> list[Around]:
    """Return the errors of each output that is repeated; none without rows, or where one has none."""
    found: list[Around] = []
    for name, numbers in copies_of(dataset).items() if dataset.sizes["time"] else ():
        unit = ERROR_UNITS[str(dataset["output_unit"].values[numbers[0]])]
        error = unit.scale * settled(dataset, column(dataset, "output_error")[:, numbers])
        if not np.isfinite(error).all():
            continue
        time = settled(dataset, column(dataset, "time"))
        angles = 2.0 * np.pi * np.arange(len(numbers)) / len(numbers)
        ends = error.min(axis=0), error.max(axis=0), over_time(error, time)
        limit = unit.scale * float(column(dataset, "output_error_limit")[numbers[0]])
        found.append(Around(name, unit.shown, angles, *ends, worst(error, time), limit))
    return found


def _payload(dataset: xr.Dataset) -> Payload | None:
    return choice("lines", "output", {one.name: _drawn(one) for one in around(dataset)})


def _drawn(one: Around) -> Payload:
    """Return a line from the least to the largest error of each copy, and what to compare it with."""
    gaps = np.column_stack([one.low, one.high, np.full(one.low.size, np.nan)])
    far = np.arange(one.low.size) == one.worst
    circle = np.linspace(0.0, 2.0 * np.pi, _AROUND)
    levels = {"mean of all": float(one.mean.mean()), "upper limit": one.limit, "lower limit": -one.limit}
    curves = [
        one.curve(f"{name}, {level:.3g} {one.unit}", circle, np.full(_AROUND, level), "grey", dash)
        for (name, level), dash in zip(levels.items(), ("dot", "longdash", "longdash"), strict=True)
        if one.middle < level <= float(one.high.max()) + one.span
    ]
    for chosen, name, colour in (
        (~far, "range over time", "blue"),
        (far, f"{one.name}[{one.worst + 1}], furthest from the mean", "vermilion"),
    ):
        curves.append(one.curve(name, np.repeat(one.angles[chosen], 3), gaps[chosen].ravel(), colour))
    angles, mean = (np.append(values, values[0]) for values in (one.angles, one.mean))
    curves.append(one.curve("mean over time", angles, mean, "ink"))
    label = f"error outwards, {one.middle:.3g} {one.unit} in the middle [{one.unit}]"
    return over(np.empty(0), label, [Panel(f"{one.name} around the axis", curves)], equal=True)


COPIES: Final = Section(
    name="copies",
    title="Copies around their axis",
    caption=(
        "Errors of the copies of a repeated output by their numbers, clockwise from the first one above, "
        "from least to largest over time."
    ),
    needs=("output_error", "output_error_limit", "output_unit", "output"),
    widget="choice",
    data=_payload,
    still="copies",
)
