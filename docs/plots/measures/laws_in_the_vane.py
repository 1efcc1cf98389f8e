"""Numbers of the page on contact that runs of the vane mechanism give: laws, grids, point contact."""

from __future__ import annotations

import math
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

import tribodyn as td
from measures.base import ERROR, PEAK, Numbers, first_reversal, force, key_result, result, span, spread, vsv
from tribodyn.papers.cheng_2022.runs import Runs, smooth

LAWS: Final = ("gt", "gw", "ke", "ceb", "jg", "linear")
ROUGH: Final = tuple(name for name in LAWS if name != "linear")
GRIDS: Final = ((96, 16), (192, 32), (384, 32))
POINTS: Final = ("point-lankarani-nikravesh", "point-johnson")
#: How the contact is damped in the comparison of grids.
DAMPINGS: Final[dict[str, dict[str, object]]] = {
    "default": {},
    "undamped": {"contact.law": "ke"},
    "100 s/m": {"contact.law": "ke", "contact.loss_coefficient": "100 s/m"},
    "v_min 20 mm/s": {"contact.minimum_entry_velocity": "20 mm/s"},
}
HARDNESS: Final = td.load_case("vsv").surfaces.bushing.hardness


def calibrated(runs: Runs, name: str) -> xr.Dataset:
    """Return the mechanism under a law whose damping is calibrated for 0.7."""
    return vsv(runs, contact__law=name, contact__damping_factor="calibrated", contact__restitution=0.7)


def error(runs: Runs, name: str) -> str:
    """Return the largest vane-angle error of smooth motion under a law [deg]."""
    return f"{key_result(calibrated(runs, name), ERROR):.4f}"


def first_peak(runs: Runs, name: str, what: str, unit: float) -> str:
    """Return a peak of the first reversal under a law."""
    return f"{first_reversal(calibrated(runs, name), what) / unit:.0f}"


def mean_force(runs: Runs) -> str:
    """Return the range of the mean contact force of smooth motion over the laws [N]."""
    means = np.array([float(force(smooth(calibrated(runs, name))).mean()) for name in LAWS])
    least, most = f"{means.min():.1f}", f"{means.max():.1f}"
    return least if least == most else f"{least} to {most}"


def mean_pressure(runs: Runs) -> str:
    """Return the range of the mean peak pressure of smooth motion over the rough laws [MPa]."""
    means = [float(smooth(calibrated(runs, name))["p_max"].mean()) * 1e-6 for name in ROUGH]
    return span(np.array(means), ".0f")


def peaks_apart(runs: Runs) -> str:
    """Return the range of the peak force over the rough laws, over its mean [%]."""
    return f"{spread(np.array([key_result(calibrated(runs, name), PEAK) for name in ROUGH])):.0f}"


def on_grid(runs: Runs, grid: tuple[int, int], damping: str) -> xr.Dataset:
    """Return half a cycle and its reversal on a grid."""
    changes = {"solver.grid.theta": grid[0], "solver.grid.z": grid[1], "run.duration": "4 s"}
    return runs.run("vsv", changes | DAMPINGS[damping])


def pressure_on(runs: Runs, grid: tuple[int, int], damping: str) -> str:
    """Return the peak pressure of the first reversal on a grid [MPa]."""
    return f"{first_reversal(on_grid(runs, grid, damping), 'pressure') * 1e-6:.0f}"


def grids_apart(runs: Runs, name: str) -> str:
    """Return the range of a peak over the grids, over its mean [%]."""
    found = [float(on_grid(runs, grid, "default")[name].values[1]) for grid in GRIDS]
    return f"{spread(np.array(found)):.1f}"


def depth(runs: Runs, clearance: str) -> str:
    """Return the range of the least separation in smooth motion over σ."""
    run = vsv(runs, joint__clearance=clearance)
    found = smooth(run)["separation_min"].values / run.attrs["roughness"]
    return span(found, ".1f")


def deepest(runs: Runs, clearance: str) -> str:
    """Return the least separation of a run over σ."""
    run = vsv(runs, joint__clearance=clearance)
    return f"{run.attrs['separation_least'] / run.attrs['roughness']:.1f}"


def hardness(runs: Runs, clearance: str) -> str:
    """Return the pressure of surfaces at rest at the deepest contact over the hardness [%]."""
    run = vsv(runs, joint__clearance=clearance)
    return f"{100.0 * run.attrs['pressure_at_rest'] / HARDNESS:.0f}"


def smooth_hardness(runs: Runs, clearance: str) -> str:
    """Return the next whole percentage above the pressure of smooth motion over the hardness [%]."""
    run = vsv(runs, joint__clearance=clearance)
    largest = float(run["pressure_outside"].values.max())
    return f"{math.ceil(100.0 * largest / HARDNESS)}"


def point_peak(runs: Runs, contact: str) -> str:
    """Return the peak force of the first reversal under a model of contact [N]."""
    return f"{first_reversal(vsv(runs, joint__contact=contact), 'contact_force'):.0f}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    **{
        f"peak, v_min {floor} [N]": partial(
            result, name=PEAK, digits=".0f", contact__minimum_entry_velocity=floor
        )
        for floor in ("0.1 mm/s", "1 mm/s", "5 mm/s")
    },
    **{
        f"peak, loss {loss:g} s/m [N]": partial(
            result, name=PEAK, digits=".0f", contact__law="ke", contact__loss_coefficient=f"{loss:g} s/m"
        )
        for loss in (0.02, 0.1, 0.3, 100.0)
    },
    **{f"error, {name} [deg]": partial(error, name=name) for name in LAWS},
    **{
        f"error, {contact} [deg]": partial(result, name=ERROR, digits=".4f", joint__contact=contact)
        for contact in ("surface", *POINTS)
    },
    "mean force over laws [N]": mean_force,
    "mean edge pressure over laws [MPa]": mean_pressure,
    "peak forces over laws [%]": peaks_apart,
    **{
        f"first peak pressure, {name} [MPa]": partial(first_peak, name=name, what="pressure", unit=1e6)
        for name in ("ceb", "ke", "gw", "gt")
    },
    **{
        f"first peak force, {name} [N]": partial(first_peak, name=name, what="contact_force", unit=1.0)
        for name in ("linear", "rsdc")
    },
    **{
        f"grid {theta} × {z}, {damping} [MPa]": partial(pressure_on, grid=(theta, z), damping=damping)
        for theta, z in GRIDS
        for damping in DAMPINGS
    },
    "forces over grids [%]": partial(grids_apart, name="contact_force_impact"),
    "smooth pressures over grids [%]": partial(grids_apart, name="pressure_outside"),
    "smooth pressure over hardness, 40 µm [%]": partial(smooth_hardness, clearance="40 um"),
    **{f"separation, smooth, {at} µm": partial(depth, clearance=f"{at} um") for at in (20, 40)},
    **{f"separation, deepest, {at} µm": partial(deepest, clearance=f"{at} um") for at in (20, 40)},
    **{
        f"pressure at rest over hardness, {at} µm [%]": partial(hardness, clearance=f"{at} um")
        for at in (20, 40)
    },
    **{
        f"first peak force, {contact} [N]": partial(point_peak, contact=contact)
        for contact in ("surface", *POINTS)
    },
}
