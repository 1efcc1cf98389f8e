"""Wear of the bushing: map of the depth, worn shape by stages, and history over the cycles of a campaign."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.views.bushing import unrolled
from tribodyn.views.charts import LOOKS, Chart, ChartCurve, Panel
from tribodyn.views.numbers import LENGTHS, in_words
from tribodyn.views.playback import peak, series
from tribodyn.views.section import Payload, Section

UNITS: Final = dict(reversed(LENGTHS[:-1]))  #: Units of depth [m], the coarsest first.
#: Chart below the depth where a result has one: label, size of its unit, and curves by their names.
PANELS: Final[tuple[tuple[str, float, Mapping[str, str]], ...]] = (
    (
        "peak pressure [MPa]",
        1e6,
        {
            "wear_pressure_max": "largest in the cycle, impacts included",
            "wear_pressure_mean": "mean over the cycle",
        },
    ),
    (
        "vane-angle error [°]",
        np.pi / 180.0,
        {"wear_angle_error_max": "largest in the cycle", "wear_angle_error_rms": "rms over the cycle"},
    ),
)


def fitting_unit(largest: float) -> tuple[str, float]:
    """Return name and size [m] of the coarsest unit in which ``largest`` [m] is at least one."""
    return next(((name, size) for name, size in UNITS.items() if largest >= size), ("nm", UNITS["nm"]))


def no_feedback(dataset: xr.Dataset) -> FloatArray:
    """Return the depth at a constant first rate [m], shape (n_jumps,)."""
    return series(dataset, "wear_cycles") * series(dataset, "wear_rate")[:1]


def _map(dataset: xr.Dataset) -> Payload | None:
    """Return the depth on the unrolled bushing as one field."""
    return _depths(dataset, dataset["wear_depth"].values[None], [])


def _stages(dataset: xr.Dataset) -> Payload | None:
    """Return the worn profiles of a campaign on the unrolled bushing, each with its cycles."""
    depths = dataset["stage_depth"].values
    words = [f"after {in_words(int(cycles))} cycles" for cycles in dataset["stage_cycles"].values]
    return _depths(dataset, depths, words) if depths.shape[0] > 1 else None


def _depths(dataset: xr.Dataset, depths: FloatArray, stages: list[str]) -> Payload | None:
    """Return depths, shape (n, n_theta, n_z) [m], in a unit that fits the largest; None if all are zero."""
    depths = np.nan_to_num(depths)
    largest = float(depths.max(initial=0.0))
    if not largest > 0.0:
        return None
    unit, size = fitting_unit(largest)
    depths = depths / size
    return unrolled(dataset, depths).payload(depths, "wear depth", unit, stages=stages)


def _history(dataset: xr.Dataset) -> list[Panel]:
    """Return the depth and the other numbers of the simulated cycles."""
    depth = series(dataset, "wear_depth_max")
    unit, size = fitting_unit(peak(depth))
    worn = [
        ChartCurve("if the first rate went on", no_feedback(dataset) / size, "grey", "dash"),
        ChartCurve("deepest point", depth / size, "blue"),
    ]
    drawn = [Panel(f"wear depth [{unit}]", worn)]
    for label, size, names in PANELS:
        there = [(names[name], series(dataset, name) / size) for name in names if name in dataset]
        curves = [ChartCurve(*one, *look) for one, look in zip(there, LOOKS, strict=False)]
        drawn += [Panel(label, curves)] if curves else []
    return drawn


#: Caption of maps of the wear depth.
WORN: Final = (
    "Wear depth at the nominal wear rate: after the cycles of the wear campaign, or else a linear estimate "
    "for this run, in which the worn shape does not change the pressure."
)
WEAR_MAP: Final = Section(
    name="wear",
    title="Wear depth of the bushing",
    caption=WORN,
    needs=("wear_depth", "theta", "z"),
    widget="field",
    data=_map,
    still="wear_depth",
)

WEAR_STAGES: Final = Section(
    name="wear-stages",
    title="The worn shape, stage by stage",
    caption="Depth worn off the bushing after growing numbers of cycles, all in one scale of colours.",
    needs=("stage_depth", "stage_cycles", "theta", "z"),
    widget="field",
    data=_stages,
)

WEAR_HISTORY: Final = Chart(
    name="wear_history",
    title="Wear over the cycles",
    caption=(
        "The deepest point of the bushing, its peak pressure and the error of the motion over the cycles of "
        "a wear campaign. As the loaded edge wears in, pressure spreads and wear slows down against the "
        "straight line."
    ),
    needs=("wear_cycles", "wear_depth_max", "wear_rate"),
    panels=_history,
    abscissa=lambda dataset: ("drive cycles", series(dataset, "wear_cycles")),
)
