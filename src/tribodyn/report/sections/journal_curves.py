"""Journal: deviation, forces and energy over time, law beside law."""

from __future__ import annotations

from typing import Final

import xarray as xr

from tribodyn.figures.journal import laws, of_law
from tribodyn.figures.journal_energy import TERMS
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import LOOKS, Curve, Panel, over_time

LAWS: Final = (("blue", "solid"), ("vermilion", "dash"), ("green", "dot"), ("purple", "dashdot"))
"""Colour and dash of each law."""


def panel(dataset: xr.Dataset, name: str, label: str, scale: float = 1.0) -> Panel:
    """Return one variable with a curve for each law."""
    curves = [
        Curve(law, of_law(dataset, name, k, scale), *LAWS[k % len(LAWS)])
        for k, law in enumerate(laws(dataset))
    ]
    return Panel(label, curves)


def deviation(dataset: xr.Dataset) -> Payload | None:
    """Return the deviation of the centre [µm]."""
    return over_time(
        dataset, [panel(dataset, f"e_{axis}", f"along {axis.upper()} [µm]", 1e6) for axis in "xy"]
    )


def forces(dataset: xr.Dataset) -> Payload | None:
    """Return contact force and, with oil, film force [N], and the peak of the contact pressure [MPa]."""
    kinds = [("F_c", "contact force")] + [("F_o", "film force")] * ("F_ox" in dataset)
    panels = [
        panel(dataset, f"{symbol}{axis}", f"{what} along {axis.upper()} [N]")
        for symbol, what in kinds
        for axis in "xy"
    ]
    return over_time(dataset, [*panels, panel(dataset, "p_max", "peak contact pressure [MPa]", 1e-6)])


def energy(dataset: xr.Dataset) -> Payload | None:
    """Return the terms of the ledger [mJ], a panel for each law."""
    terms = [name for name in TERMS if name in dataset.variables]
    panels = [
        Panel(
            f"{law} [mJ]",
            [
                Curve(TERMS[name][0], of_law(dataset, name, k, 1e3), *look)
                for name, look in zip(terms, LOOKS, strict=False)
            ],
        )
        for k, law in enumerate(laws(dataset))
    ]
    return over_time(dataset, panels)


DEVIATION: Final = Section(
    name="deviation",
    title="Deviation of the journal from the axis of the bushing",
    caption=(
        "How the centre moves under its load. Without damping and without oil the journal keeps bouncing."
    ),
    needs=("e_x", "e_y"),
    widget="lines",
    data=deviation,
    still="journal",
)
FORCES: Final = Section(
    name="forces",
    title="Forces on the journal",
    caption="What contact and, where there is oil, the film answer the load with, and the peak pressure.",
    needs=("F_cx", "F_cy", "p_max"),
    widget="lines",
    data=forces,
)
ENERGY: Final = Section(
    name="energy",
    title="Energy ledger",
    caption=(
        "What the load puts in is moving, stored in the contact, or has become heat of contact damping or of "
        "the film. The residual is what the integration lost or made up."
    ),
    needs=("energy_loads", "energy_kinetic", "energy_contact", "energy_damping", "energy_residual"),
    widget="lines",
    data=energy,
    still="journal_energy",
)
