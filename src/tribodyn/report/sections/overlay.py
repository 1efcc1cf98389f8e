"""The same quantity of several runs, curve over curve."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.style import series
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import LOOKS, Curve, Panel, over

DEG: Final = 180.0 / np.pi


@dataclass(frozen=True)
class Quantity:
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


def _scaled(name: str, label: str, scale: float) -> Quantity:
    return Quantity(label, (name,), lambda dataset: series(dataset, name, scale))


FIGURES: Final[dict[str, tuple[str, tuple[Quantity, ...]]]] = {
    "error": (
        "Vane-angle error",
        (
            Quantity(
                "angle error [°]",
                ("theta_v", "theta_v_ideal"),
                lambda d: series(d, "theta_v", DEG) - series(d, "theta_v_ideal", DEG),
            ),
        ),
    ),
    "force": (
        "Contact force",
        (_scaled("F_cx", "along X [N]", 1.0), _scaled("F_cy", "along Y [N]", 1.0)),
    ),
    "place": (
        "Offset of the trunnion",
        (_scaled("e_x", "along X [µm]", 1e6), _scaled("e_y", "along Y [µm]", 1e6)),
    ),
    "tilt": (
        "Tilt of the trunnion",
        (_scaled("phi_x", "about X [mrad]", 1e3), _scaled("phi_y", "about Y [mrad]", 1e3)),
    ),
    "pressure": ("Peak pressure", (_scaled("p_max", "peak pressure [MPa]", 1e-6),)),
    "drive": ("Drive moment", (_scaled("M_d", "drive moment [N m]", 1.0),)),
}
"""Figures of a comparison: title and quantities by name."""


def overlays(runs: Mapping[str, xr.Dataset]) -> tuple[Section, ...]:
    """Return the figures of a comparison.

    Parameters
    ----------
    runs
        Results by the name of their run. A quantity is shown of those that hold it; contact laws side by side
        in one result are runs of their own here.
    """
    single = {name: part for run, dataset in runs.items() for name, part in _by_law(run, dataset).items()}
    return tuple(
        Section(
            name=f"overlay-{name}",
            title=title,
            caption="",
            needs=(),
            widget="lines",
            data=_drawer(quantities, single),
        )
        for name, (title, quantities) in FIGURES.items()
    )


def _by_law(run: str, dataset: xr.Dataset) -> dict[str, xr.Dataset]:
    """Return the runs of a result: one, or one for each contact law."""
    if "law" not in dataset.dims:
        return {run: dataset}
    return {f"{run}, {law}": dataset.sel(law=law) for law in dataset["law"].values.tolist()}


def _drawer(
    quantities: Sequence[Quantity], runs: Mapping[str, xr.Dataset]
) -> Callable[[xr.Dataset], Payload | None]:
    """Return what makes the data of one figure; the result it is given is not looked at."""

    def data(_: xr.Dataset) -> dict[str, Any] | None:
        panels = [Panel(quantity.label, _curves(quantity, runs)) for quantity in quantities]
        drawn = [panel for panel in panels if len(panel.curves) > 0]
        return over(np.empty(0), "time [s]", drawn) if drawn else None

    return data


def _curves(quantity: Quantity, runs: Mapping[str, xr.Dataset]) -> list[Curve]:
    """Return the curve of each run that holds the quantity."""
    curves = []
    for number, (name, dataset) in enumerate(runs.items()):
        if all(needed in dataset for needed in quantity.needs) and dataset["time"].size > 1:
            colour, dash = LOOKS[number % len(LOOKS)]
            values = quantity.values(dataset)
            curves.append(Curve(name, values, colour, dash, x=series(dataset, "time")))
    return curves
