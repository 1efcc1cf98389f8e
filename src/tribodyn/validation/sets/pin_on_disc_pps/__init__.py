"""Wear of equal pins: the loss of height of a repeat, and running-in by two rates."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot, rms
from tribodyn.validation.catalogue import ValidationSet
from tribodyn.wear import Archard

#: Rates [um/m], distance of running-in [m], loss at the beginning [um].
PARAMETERS: Final = (
    FitParameter("first_rate", 0.0, 5.0),
    FitParameter("later_rate", 0.0, 5.0),
    FitParameter("distance", 1.0, 500.0, True),
    FitParameter("zero", -50.0, 50.0),
)
#: Share of PTFE [%], load and run of each open curve.
CURVES: Final = (
    *(("30", "60N", "1"), ("30", "60N", "2"), ("30", "100N", "1"), ("30", "100N", "2")),
    *(("15", "60N", "1"), ("0", "60N", "1"), ("0", "60N", "2")),
)
REPEATED: Final = (("30", "60N"), ("30", "100N"))
LOADS: Final = {"60N": "59.8", "100N": "98.1"}  #: Loads by the names of files, as in the table.


@dataclass(frozen=True)
class Loss:
    """Loss of height [um] over distance [m], shapes (n,)."""

    distance: FloatArray
    height: FloatArray

    @property
    def last_half(self) -> "Loss":
        """The last half of the distance."""
        late = self.distance >= 0.5 * (self.distance[0] + self.distance[-1])
        return Loss(self.distance[late], self.height[late])

    @property
    def rate(self) -> float:
        """Slope of a straight line [um/m]."""
        return float(np.polyfit(self.distance, self.height, 1)[0])


def measured(one: ValidationSet, share: str, load: str, run: str) -> Loss:
    """Return a curve of the set."""
    file = f"curve_ptfe{share}_{load}_run{run}.csv"
    distance, height = one.columns(file, "distance_m", "pin_height_um")
    return Loss(distance, -height)


def table_row(one: ValidationSet, share: str, load: str, run: str) -> dict[str, str]:
    """Return the row of the table for a curve."""
    wanted = (share, LOADS[load], run)
    rows = one.rows("summary.csv")
    return next(row for row in rows if (row["ptfe_percent"], row["load_N"], row["run"]) == wanted)


def two_stages(given: Mapping[str, float], distance: FloatArray) -> FloatArray:
    """Return the loss of height by two rates, of which the first dies away over a distance [um]."""
    run_in = given["distance"] * -np.expm1(-distance / given["distance"])
    extra = given["first_rate"] - given["later_rate"]
    return np.asarray(given["zero"] + given["later_rate"] * distance + extra * run_in)


def fitted(loss: Loss) -> LeastSquares:
    """Return the fit of both stages to a curve; residuals in um."""
    return fit(lambda given: two_stages(given, loss.distance) - loss.height, PARAMETERS)


def repeat_factor(one: ValidationSet, share: str, load: str) -> float:
    """Return by what factor the loss that run 1 predicts for the last half of run 2 is missed, above 1."""
    first, second = (measured(one, share, load, run).last_half for run in ("1", "2"))
    law = Archard(first.rate)
    predicted = float(law.depth(np.array(np.ptp(second.distance))))
    ratio = predicted / (second.rate * float(np.ptp(second.distance)))
    return max(ratio, 1.0 / ratio)


def compare(one: ValidationSet) -> Outcome:
    """Return the factors between repeats, and the fits of running-in."""
    rows = []
    for share, load in REPEATED:
        rates = [float(table_row(one, share, load, run)["rate_last_half_um_per_m"]) for run in ("1", "2")]
        name = f"{share} % PTFE, {load}, loss of run 2 by the rate of run 1, factor"
        values = repeat_factor(one, share, load), max(rates) / min(rates)
        rows.append(Comparison(name, "", *values, null=1.0, band=one.bands["repeat"]))
    for share, load, run in CURVES:
        loss, name = measured(one, share, load, run), f"{share} % PTFE, {load}, run {run}"
        found = fitted(loss)
        line = loss.height - np.polyval(np.polyfit(loss.distance, loss.height, 1), loss.distance)
        row = table_row(one, share, load, run)
        error, band = rms(found.residuals), one.bands["two_stages"]
        of_error = f"{name}, two stages, root mean square error"
        rows.append(Comparison(of_error, "um", error, null=rms(line), band=band))
        pair = found.named["later_rate"], float(row["rate_last_half_um_per_m"])
        widths = found.half_width("later_rate"), 2.0 * float(row["rate_standard_error_um_per_m"])
        rows.append(Comparison(f"{name}, later rate", "um/m", *pair, *widths, loss.rate))
    return Outcome(tuple(rows), _plot(one))


def _plot(one: ValidationSet) -> Plot:
    curves = []
    for share, load, run in CURVES[:2]:
        loss = measured(one, share, load, run)
        distance, name = loss.distance, f"{share} % PTFE, {load}, run {run}"
        curves.append(Curve(f"{name}, measured", "measured", distance, loss.height))
        values = two_stages(fitted(loss).named, loss.distance)
        curves.append(Curve(f"{name}, two stages", "computed", distance, values))
    return Plot("distance [m]", "loss of height [um]", tuple(curves))
