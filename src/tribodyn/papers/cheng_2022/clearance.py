"""Figures 16 to 19: what the size of the clearance changes, in impacts, errors and wear."""

from collections.abc import Mapping
from itertools import product
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.pressure import draw_map
from tribodyn.papers.cheng_2022.runs import (
    ANGLE,
    STYLES,
    PaperFigure,
    Runs,
    by_clearance,
    enlarge,
    finer,
    first_cycle,
    is_smooth,
    keep,
    limits,
    mean_rate,
    on_grid,
    over_clearances,
)
from tribodyn.papers.cheng_2022.trunnion import CENTRES, centre_velocity
from tribodyn.views.bushing import Unrolled, unrolled
from tribodyn.views.playback import series

HARDEST: Final = 0.05  #: Samples follow the steps for this long after a reversal [s]: ``run.impact_window``.
_PARTS: Final = {"c": "contact", "k": "rigid", "d": "damping"}


def windows(run: xr.Dataset, length: float = HARDEST) -> list[xr.Dataset]:
    """Return the samples in a time [s] after each reversal; the start is not one."""
    time = run["time"].values
    turns = run["reversal_time"].values[1:]
    return [run.sel(time=(time >= turn) & (time < turn + length)) for turn in turns]


def peaks(run: xr.Dataset, part: str) -> FloatArray:
    """Return the largest contact (``c``), rigid (``k``) or damping (``d``) force of each reversal [N].

    From the accepted steps; the start, at which the trunnion falls, is no reversal.
    """
    return np.asarray(run[f"{_PARTS[part]}_force_impact"].values[1:])


def damping_along_rigid(run: xr.Dataset) -> list[tuple[float, float]]:
    """Return the largest and the least damping force along the rigid force at each reversal [N]."""
    found = []
    for rows in windows(run):
        rigid = np.stack([rows[f"F_k{axis}"].values for axis in "xy"])
        damping = np.stack([rows[f"F_d{axis}"].values for axis in "xy"])
        length = np.hypot(*rigid)
        touching = length > 0.0
        along = (rigid * damping).sum(axis=0)[touching] / length[touching]
        found.append((float(along.max()), float(along.min())))
    return found


def collision_speed(run: xr.Dataset) -> float:
    """Return the largest speed of the three centres after the reversals [mm/s]."""
    return max(
        float(np.hypot(*centre_velocity(rows, height)).max())
        for rows in windows(run)
        for _, height, *_ in CENTRES
    )


DEGREES: Final = float(np.rad2deg(1.0))
#: Speed errors that section 5.3 prints [deg/s], by clearance [µm].
PAPER_SPEED_ERRORS: Final = {20: 2.5e-4, 40: 7.5e-4}
_SPEEDS: Final = (1e-5, 1e-1)  #: Range of the speed errors drawn [deg/s].


def motion_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return angle and speed of the vane with and without clearance over a cycle."""
    names = ("theta_v", "omega_v", "theta_v_ideal", "omega_v_ideal")
    return first_cycle(runs.over_clearance(formulation, *names))


def force_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return contact, damping and rigid forces [N] over a cycle."""
    names = [f"F_{part}{axis}" for part in "cdk" for axis in "xy"]
    return first_cycle(runs.over_clearance(formulation, *names))


def attitude_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return displacement [m] and tilt [rad] over a cycle, with samples along free flights."""
    names = ("e_x", "e_y", "phi_x", "phi_y")
    kept = (*names, *(f"{name}_dot" for name in names))
    runs_of_all = [finer(keep(first_cycle(run), *kept), 4) for run in runs.every_clearance(formulation)]
    return keep(over_clearances(runs_of_all), *names)


def angle_errors(dataset: xr.Dataset) -> style.Curves:
    """Return the vane angle less the ideal one [deg], a curve a clearance."""
    ideal = _ideal(dataset, "theta_v")
    curves = by_clearance(dataset, "theta_v", DEGREES)
    return [(values - ideal, label, colour, dash) for values, label, colour, dash in curves]


def speed_errors(dataset: xr.Dataset) -> style.Curves:
    """Return the vane speed less the ideal one in smooth motion, mean of 0.2 s [deg/s]."""
    time = series(dataset, "time")
    found: style.Curves = []
    for error, label, colour, dash in angle_errors(dataset):
        middle, rate = mean_rate(time, error, dataset)
        apart = np.append(np.diff(middle) > 0.1, False)  # no line across the impacts
        values = np.interp(time, middle, np.where(apart, np.nan, rate), left=np.nan, right=np.nan)
        found.append((values, label, colour, dash))
    return found


def _ideal(dataset: xr.Dataset, name: str) -> FloatArray:
    """Return the value of a variable without clearance [deg or deg/s], whatever the clearance."""
    return series(dataset.isel(clearance=0), f"{name}_ideal", DEGREES)


def _legend(figure: Figure, curves: style.Curves) -> None:
    axes = figure.axes[0]
    handles = [
        axes.plot([], [], color=colour, linestyle=dash, label=f"clearance {label}")[0]
        for _, label, colour, dash in reversed(curves)
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=5, frameon=False, fontsize=style.SMALL)


def draw_motion(dataset: xr.Dataset) -> Figure:
    """Draw Figure 16: angle and speed of the vane above, what they differ from the ideal pair below.

    At the scale of the motion all curves are one; the paper enlarges, here the difference has its own panel.
    """
    figure = style.sheet(dataset, "Fig. 16  Motion of the vane with different clearances", 5.8)
    (angle, speed), (angle_error, speed_error) = figure.subplots(2, 2, sharex=True, height_ratios=(1.0, 1.5))
    time = series(dataset, "time")
    quiet = is_smooth(dataset, time)
    _motion(angle, dataset, "theta_v", "(a) rotation angle; ideal pair dashed", "[°]")
    _motion(speed, dataset, "omega_v", "(b) rotation velocity; impacts leave the frame", "[°/s]")
    errors = angle_errors(dataset)
    style.lines(angle_error, time, errors, width=1.0)
    limits(angle_error, errors, quiet)
    style.finish(angle_error, "time [s]", "minus ideal [°]")
    sizes: style.Curves = [
        (np.abs(values), label, colour, dash) for values, label, colour, dash in speed_errors(dataset)
    ]
    style.lines(speed_error, time, sizes, width=0.8)
    _paper_speeds(speed_error)
    style.finish(speed_error, "time [s]", "|minus ideal|, mean of 0.2 s [°/s]")
    _legend(figure, by_clearance(dataset, "theta_v"))
    return figure


def _motion(axes: Axes, dataset: xr.Dataset, name: str, heading: str, unit: str) -> None:
    """Draw angle or speed with every clearance, and that of the ideal pair."""
    time, ideal = series(dataset, "time"), _ideal(dataset, name)
    style.lines(axes, time, by_clearance(dataset, name, DEGREES), width=1.0)
    axes.plot(time, ideal, color=style.GREY, linestyle=style.DASHED, linewidth=1.0)
    limits(axes, [(ideal, "", *STYLES[0])], is_smooth(dataset, time))
    style.caption(axes, heading)
    style.finish(axes, y_label=unit)


def _paper_speeds(axes: Axes) -> None:
    """Scale the axis by decades and mark the speed errors that the paper prints."""
    axes.set_yscale("log")
    axes.set_ylim(*_SPEEDS)
    for clearance, value in PAPER_SPEED_ERRORS.items():
        axes.axhline(value, color=style.GREY, linewidth=0.8, linestyle=style.DASHED, zorder=0)
        axes.annotate(
            f"the paper, {clearance} µm",
            (0.01, value),
            xycoords=("axes fraction", "data"),
            xytext=(0.0, 2.0),
            textcoords="offset points",
            size=style.SMALL - 1.0,
            color=style.INK,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.85},
        )


def draw_forces(dataset: xr.Dataset) -> Figure:
    """Draw Figure 17: contact, damping and rigid forces along X and Y, and the reversal beside each."""
    figure = style.sheet(dataset, "Fig. 17  Forces with different clearances", 11.5)
    panels = figure.subplots(6, 2, sharex="col", width_ratios=(2.0, 1.0))
    time = series(dataset, "time")
    quiet = is_smooth(dataset, time)
    turn = 0.5 * float(dataset.attrs["cycle_period"])
    forces = product((("c", "contact"), ("d", "damping"), ("k", "rigid")), "xy")
    for (axes, beside), ((part, what), axis), letter in zip(panels, forces, "abcdef", strict=True):
        curves = by_clearance(dataset, f"F_{part}{axis}")
        style.lines(axes, time, curves, width=0.9)
        limits(axes, curves, quiet)
        enlarge(axes, beside, time, curves, (turn - 0.001, turn + 0.012))
        style.caption(axes, f"({letter}) {what}, {axis.upper()}")
        style.caption(beside, "the reversal")
        style.finish(axes, y_label="force [N]")
    for axes in panels[-1]:
        axes.set_xlabel("time [s]", size=style.TEXT)
    _legend(figure, by_clearance(dataset, "F_cx"))
    return figure


def draw_attitude(dataset: xr.Dataset) -> Figure:
    """Draw Figure 18: trajectories of the centre, and deflection angles."""
    figure = style.sheet(dataset, "Fig. 18  Attitude of the trunnion centre with different clearances", 7.4)
    path, tilt = figure.subplots(2, 1, height_ratios=(1.3, 1.0))
    for (x, _, colour, dash), (y, *_) in zip(
        by_clearance(dataset, "e_x", 1e6), by_clearance(dataset, "e_y", 1e6), strict=True
    ):
        path.plot(x, y, color=colour, linestyle=dash, linewidth=0.9)
    time = series(dataset, "time")
    style.lines(tilt, time, by_clearance(dataset, "phi_x", 1e3), width=1.0)
    style.lines(tilt, time, by_clearance(dataset, "phi_y", 1e3), width=1.0)
    path.set_aspect("equal")
    style.caption(path, "(a) trajectory")
    style.caption(tilt, "(b) deflection φx (above) and φy")
    style.finish(path, "e_x [µm]", "e_y [µm]")
    style.finish(tilt, "time [s]", "deflection angle [mrad]")
    _legend(figure, by_clearance(dataset, "e_x"))
    return figure


MOTION: Final = PaperFigure("fig16", "motion of the vane with different clearances", motion_data, draw_motion)
FORCES: Final = PaperFigure("fig17", "forces with different clearances", force_data, draw_forces)
ATTITUDE: Final = PaperFigure("fig18", "attitude with different clearances", attitude_data, draw_attitude)


CYCLES: Final = (100, 200, 300, 400)
DIVISOR: Final = 65.0  #: The bare number that the paper's depths come out with, see Eq. 47 in the errata.
_PICOMETRE: Final = 1e-12


def worn(
    runs: Runs, formulation: str, clearance: float, cycles: int, changes: Mapping[str, object] | None = None
) -> xr.Dataset:
    """Return a wear campaign in the paper's convention, with some keys of the case changed."""
    campaign = {"wear.cycles": cycles, "wear.paper_hardness_divisor": DIVISOR}
    return runs.vsv(formulation, clearance, {**campaign, **(changes or {})})


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return wear depth [m] by clearance, cycles, angle and height."""
    index = xr.Variable("cycles", np.array(CYCLES), {"long_name": "drive cycles", "units": "1"})
    rows = []
    for clearance in runs.clearances:
        depths = [worn(runs, formulation, clearance, cycles)[["wear_depth"]] for cycles in CYCLES]
        rows.append(xr.concat(depths, dim=index, combine_attrs="override"))
    finest = max(rows, key=lambda row: row.sizes["theta"])
    return over_clearances([on_grid(row, finest["theta"].values, finest["z"].values) for row in rows])


def draw(dataset: xr.Dataset) -> Figure:
    """Draw a row a clearance: the worn bushing laid flat, and its deeper edge as it wears."""
    figure = style.sheet(dataset, "Fig. 19  Wear depth of the bushing with different clearances", 9.6)
    panels = figure.subplots(dataset.sizes["clearance"], 2, sharex=True, width_ratios=(1.3, 1.0))
    depth = dataset["wear_depth"].values / _PICOMETRE
    laid = unrolled(dataset, depth[:, -1], theta=dataset["theta"].values)
    for i, (plan, profile) in enumerate(panels):
        mesh = draw_map(plan, laid, depth[i, -1], float(depth.max()))
        plan.set_ylabel(laid.label, size=style.TEXT)
        style.caption(
            plan, f"({'abcde'[i]}) clearance {dataset['clearance'].values[i] * 1e6:g} µm, 400 cycles"
        )
        _profiles(profile, laid, depth[i])
        profile.set_ylim(0.0, 1.05 * float(depth.max()))
    for axes in panels[-1]:
        axes.set_xlabel(ANGLE, size=style.TEXT)
    style.colour_bar(figure, mesh, panels[:, 0], "wear depth [pm]", shrink=0.5, location="bottom")
    return figure


def _profiles(axes: Axes, laid: Unrolled, depth: FloatArray) -> None:
    """Draw the depth along the deeper edge after 100 to 400 cycles."""
    edge = -1 if depth[-1, :, -1].max() >= depth[-1, :, 0].max() else 0
    curves: style.Curves = []
    for k, cycles in enumerate(CYCLES):
        curves.append((laid.turned(depth[k])[:, edge], f"{cycles} cycles", *STYLES[k]))
    style.lines(axes, laid.angle, curves, width=1.0)
    axes.legend(frameon=False, fontsize=style.SMALL - 1)
    style.caption(axes, f"{'top' if edge else 'bottom'} edge")
    style.finish(axes, y_label="depth [pm]")


WEAR: Final = PaperFigure("fig19", "wear depth with different clearances", data, draw)
