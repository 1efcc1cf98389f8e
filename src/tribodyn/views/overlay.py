"""The same quantity of several runs, curve over curve."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.views.charts import LOOKS, ChartCurve, Panel, over
from tribodyn.views.section import Payload, Section
from tribodyn.views.series import series


@dataclass(frozen=True)
class OverlayQuantity:
    """One quantity over time.

    Attributes
    ----------
    label
        Name and unit.
    needs
        Variables it is made of.
    values
        Returns it in that unit, shape (n_t,).
    """

    label: str
    needs: tuple[str, ...]
    values: Callable[[xr.Dataset], FloatArray]


@dataclass(frozen=True)
class Overlay:
    """One figure of a comparison.

    Attributes
    ----------
    name
        Identifier in the page.
    title
        What it shows.
    quantities
        A panel each.
    """

    name: str
    title: str
    quantities: tuple[OverlayQuantity, ...]


def scaled(name: str, label: str, scale: float) -> OverlayQuantity:
    """Return a variable times ``scale``."""
    return OverlayQuantity(label, (name,), lambda dataset: series(dataset, name, scale))


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
"""Comparison of any shafts in their bushings."""


def overlays(planned: Sequence[Overlay], runs: Mapping[str, xr.Dataset]) -> tuple[Section, ...]:
    """Return the figures of a comparison as sections.

    Parameters
    ----------
    planned
        What is to be shown.
    runs
        Results by the name of their run. A quantity is shown of those that hold it.
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
