"""Several results on one page: common scales, and the same quantity curve over curve."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.results.dataset import CARRIED
from tribodyn.views.charts import LOOKS, ChartCurve, Panel, over
from tribodyn.views.playback import series
from tribodyn.views.section import Payload, Section

_SAME: Final = 1.0e-9  #: Times closer than this share of a drive cycle are the same.
_NEEDED: Final = {"cycle_period", "impact_time", "time_reached", "start"}


def in_common(results: Sequence[xr.Dataset]) -> tuple[list[xr.Dataset], str]:
    """Return of each result what all of them hold, and in a sentence what that is, empty where they agree.

    Runs that begin alike are cut to the time of the shortest. Where some continue another run and others do
    not, the last whole drive cycles are taken and the impacts after those reversals that all of them hold.

    ``results``: results, whole or partial.
    """
    whole = list(results)
    known = all("reversal_time" in result and result.attrs.keys() >= _NEEDED for result in whole)
    if not known or len(whole) < 2:
        return whole, ""
    periods = np.array([float(result.attrs["cycle_period"]) for result in whole])
    ends = np.array([float(result.attrs["time_reached"]) for result in whole])
    if np.ptp(periods) > _SAME * periods[0]:
        return (
            whole,
            "Drive cycles of these runs last differently: peaks are of different numbers of reversals.",
        )
    carried = {result.attrs["start"] == CARRIED for result in whole}
    if len(carried) == 1:
        return _first(whole, ends, periods[0])
    return _last(whole, ends, periods[0])


def _first(results: list[xr.Dataset], ends: FloatArray, period: float) -> tuple[list[xr.Dataset], str]:
    """Cut results that begin alike to the time of the shortest."""
    end = float(ends.min())
    if np.ptp(ends) <= _SAME * period:
        return results, ""
    cut = [_between(result, 0.0, end) for result in results]
    return cut, f"Numbers of the motion are of the first {end:.4g} s, which all runs hold."


def _last(results: list[xr.Dataset], ends: FloatArray, period: float) -> tuple[list[xr.Dataset], str]:
    """Cut results to their last drive cycles, and to the reversals that all of them hold there."""
    cycles = np.floor(ends / period + _SAME)
    n = int(cycles.min())
    if n == 0:
        return results, "These runs begin differently: peaks are of different numbers of reversals."
    cut = [_between(r, (c - n) * period, c * period) for r, c in zip(results, cycles, strict=True)]
    phases = [_phases(r, (c - n) * period) for r, c in zip(cut, cycles, strict=True)]
    shared = [t for t in phases[0] if all(_among(t, others, period) for others in phases[1:])]
    alike = [
        _without_impacts(r, (c - n) * period, np.array(shared), period)
        for r, c in zip(cut, cycles, strict=True)
    ]
    held = f"{len(shared)} reversal" + ("" if len(shared) == 1 else "s")
    what = "the last drive cycle" if n == 1 else f"the last {n} drive cycles"
    return (
        alike,
        f"Numbers of the motion are of {what} of each run, with the {held} that all of them hold there.",
    )


def _between(result: xr.Dataset, begin: float, end: float) -> xr.Dataset:
    """Return the rows and reversals of a stretch [s]."""
    near = _SAME * float(result.attrs["cycle_period"])
    time, turns = series(result, "time"), series(result, "reversal_time")
    rows = np.flatnonzero((time >= begin - near) & (time <= end + near))
    kept = np.flatnonzero((turns >= begin - near) & (turns < end - near))
    start = result.attrs["start"] if begin == 0.0 else CARRIED
    return result.isel(time=rows, reversal=kept).assign_attrs(time_reached=end, start=start)


def _phases(result: xr.Dataset, begin: float) -> FloatArray:
    """Return the times of a stretch's reversals after ``begin`` [s], shape (n,)."""
    turns, settling = series(result, "reversal_time"), float(result.attrs["impact_time"])
    held = turns + settling <= float(result.attrs["time_reached"])
    if result.attrs["start"] != CARRIED:
        held &= turns > 0.0
    return np.asarray(turns[held] - begin)


def _among(time: float, others: FloatArray, period: float) -> bool:
    return bool(np.any(np.abs(others - time) <= _SAME * period))


def _without_impacts(result: xr.Dataset, begin: float, shared: FloatArray, period: float) -> xr.Dataset:
    """Return a result without the impacts after reversals that are not shared."""
    turns, time = series(result, "reversal_time"), series(result, "time")
    settling = float(result.attrs["impact_time"])
    lost = np.array([not _among(turn - begin, shared, period) for turn in turns])
    quiet = np.ones(time.size, dtype=bool)
    for turn in turns[lost]:
        quiet &= (time < turn) | (time > turn + settling)
    without = result.isel(time=np.flatnonzero(quiet)).copy()
    for name in without.data_vars:
        if str(name).endswith(("_impact", "_impact_time")):
            without[name] = without[name].where(~xr.DataArray(lost, dims="reversal"), math.nan)
    return without


@dataclass(frozen=True)
class OverlayQuantity:
    """One quantity over time."""

    label: str  #: Name and unit.
    needs: tuple[str, ...]  #: Variables it is made of.
    values: Callable[[xr.Dataset], FloatArray]  #: Returns it in that unit, shape (n_t,).


@dataclass(frozen=True)
class Overlay:
    """One figure of a comparison."""

    name: str  #: Identifier in the page.
    title: str  #: What it shows.
    quantities: tuple[OverlayQuantity, ...]  #: A panel each.


def scaled(name: str, label: str, scale: float) -> OverlayQuantity:
    """Return a variable times ``scale``."""
    return OverlayQuantity(label, (name,), lambda dataset: series(dataset, name, scale))


#: Comparison of any shafts in their bushings.
BUSHING: Final = (
    Overlay(
        "force", "Contact force", (scaled("F_cx", "along X [N]", 1.0), scaled("F_cy", "along Y [N]", 1.0))
    ),
    Overlay(
        "place",
        "Offset in the bushing",
        (scaled("e_x", "along X [µm]", 1e6), scaled("e_y", "along Y [µm]", 1e6)),
    ),
    Overlay(
        "tilt",
        "Tilt in the bushing",
        (scaled("phi_x", "about X [mrad]", 1e3), scaled("phi_y", "about Y [mrad]", 1e3)),
    ),
    Overlay("pressure", "Peak pressure", (scaled("p_max", "peak pressure [MPa]", 1e-6),)),
)


def overlays(planned: Sequence[Overlay], runs: Mapping[str, xr.Dataset]) -> tuple[Section, ...]:
    """Return the figures of a comparison as sections.

    ``planned``: what is to be shown. ``runs``: results by the name of their run. A quantity is shown of those
    that hold it.
    """
    return tuple(
        Section(
            name=f"overlay-{overlay.name}",
            title=overlay.title,
            caption="",
            needs=(),
            widget="lines",
            data=_drawer(overlay.quantities, runs),
        )
        for overlay in planned
    )


def _drawer(
    quantities: Sequence[OverlayQuantity], runs: Mapping[str, xr.Dataset]
) -> Callable[[xr.Dataset], Payload | None]:
    """Return a maker of the data of one figure that ignores its result."""

    def data(_: xr.Dataset) -> dict[str, Any] | None:
        panels = [Panel(quantity.label, _curves(quantity, runs)) for quantity in quantities]
        drawn = [panel for panel in panels if len(panel.curves) > 0]
        return over(np.empty(0), "time [s]", drawn) if drawn else None

    return data


def _curves(quantity: OverlayQuantity, runs: Mapping[str, xr.Dataset]) -> list[ChartCurve]:
    """Return the curve of each run that holds the quantity."""
    curves = []
    for number, (name, dataset) in enumerate(runs.items()):
        if all(needed in dataset for needed in quantity.needs) and dataset["time"].size > 1:
            colour, dash = LOOKS[number % len(LOOKS)]
            values = quantity.values(dataset)
            curves.append(ChartCurve(name, values, colour, dash, x=series(dataset, "time")))
    return curves
