"""Figures 12 to 15: forces, path, velocities and pressure of the trunnion."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.pressure import draw as draw_pictures
from tribodyn.joints.bushing import new_memory, pose_at
from tribodyn.kernels.joints.bushing import pressure_field
from tribodyn.papers.cheng_2022.reduced.equilibrium import equilibrium
from tribodyn.papers.cheng_2022.reduced.parameters import CrankMotion, Vsv
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.reach import ideal_vane_angle
from tribodyn.papers.cheng_2022.reduced.sections import case_of
from tribodyn.papers.cheng_2022.reduced.system import vsv_of
from tribodyn.papers.cheng_2022.runs import ANGLE, PaperFigure, Runs, enlarge, finer, is_smooth, keep, limits
from tribodyn.views.playback import series

CLEARANCE: Final = 20e-6
#: The three centres: name, height over the length of the bushing, look.
CENTRES: Final[tuple[tuple[str, float, str, style.LineStyle], ...]] = (
    ("top centre", 0.5, style.BLUE, style.SOLID),
    ("middle centre", 0.0, style.INK, style.DASHED),
    ("bottom centre", -0.5, style.VERMILION, style.DASHDOT),
)


def force_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return contact, rigid and damping forces [N] over two cycles."""
    names = [f"F_{part}{axis}" for axis in "xy" for part in "ckd"]
    return keep(runs.vsv(formulation, CLEARANCE), *names)


def attitude_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return displacement [m], tilt [rad] and their rates over two cycles."""
    names = ("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot")
    return keep(runs.vsv(formulation, CLEARANCE), *names)


def path_data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return displacement [m], tilt [rad] and their rates, with samples along free flights."""
    return finer(attitude_data(runs, formulation))


def draw_forces(dataset: xr.Dataset) -> Figure:
    """Draw Figure 12: X above, Y below, the first reversal enlarged."""
    figure = style.sheet(dataset, "Fig. 12  Contact, rigid and damping forces on the trunnion", 5.8)
    time = series(dataset, "time")
    turn = 0.5 * float(dataset.attrs["cycle_period"])
    quiet = is_smooth(dataset, time)
    panels = figure.subplots(2, 2, sharex="col", width_ratios=(2.0, 1.0))
    for (axes, beside), axis, letter in zip(panels, "xy", "ab", strict=True):
        curves: style.Curves = [
            (series(dataset, f"F_c{axis}"), "contact", "#b4b4b4", style.SOLID),
            (series(dataset, f"F_k{axis}"), "rigid", style.BLUE, style.SOLID),
            (series(dataset, f"F_d{axis}"), "damping", style.VERMILION, style.DASHED),
        ]
        style.lines(axes, time, curves[:1], width=3.0)
        style.lines(axes, time, curves[1:], width=1.0)
        limits(axes, curves, quiet)
        enlarge(axes, beside, time, curves, (turn - 0.003, turn + 0.03))
        style.caption(axes, f"({letter}) {axis.upper()} direction; impacts leave the frame")
        style.caption(beside, "the first reversal")
        style.finish(axes, y_label=f"force along {axis.upper()} [N]")
    for axes in panels[-1]:
        axes.set_xlabel("time [s]", size=style.TEXT)
    style.legend_below(figure, panels[0, 0], 3)
    return figure


def centre(dataset: xr.Dataset, height: float) -> tuple[FloatArray, FloatArray]:
    """Return the displacement [µm] of the trunnion axis at a height over the bushing's length."""
    z = height * float(dataset.attrs["joint_length"])
    x = series(dataset, "e_x") - z * np.tan(series(dataset, "phi_y"))
    y = series(dataset, "e_y") - z * np.tan(series(dataset, "phi_x"))
    return x * 1e6, y * 1e6


def centre_velocity(dataset: xr.Dataset, height: float) -> tuple[FloatArray, FloatArray]:
    """Return the velocity [mm/s] of the trunnion axis at a height over the bushing's length."""
    z = height * float(dataset.attrs["joint_length"])
    sec2_x = 1.0 / np.cos(series(dataset, "phi_x")) ** 2
    sec2_y = 1.0 / np.cos(series(dataset, "phi_y")) ** 2
    x = series(dataset, "e_x_dot") - z * sec2_y * series(dataset, "phi_y_dot")
    y = series(dataset, "e_y_dot") - z * sec2_x * series(dataset, "phi_x_dot")
    return x * 1e3, y * 1e3


def draw_path(dataset: xr.Dataset) -> Figure:
    """Draw Figure 13: the paths of the three centres in the clearance circle."""
    figure = style.sheet(dataset, "Fig. 13  Trajectory of the trunnion", 4.6)
    axes = figure.subplots()
    clearance = float(dataset.attrs["clearance"]) * 1e6
    axes.add_patch(
        Circle((0.0, 0.0), clearance, fill=False, edgecolor=style.GREY, linewidth=1.0, label="clearance")
    )
    for name, height, colour, dash in CENTRES:
        x, y = centre(dataset, height)
        axes.plot(x, y, color=colour, linestyle=dash, linewidth=1.0, label=name)
    axes.set_aspect("equal")
    style.finish(axes, "X [µm]", "Y [µm]")
    style.legend_below(figure, axes, 4)
    return figure


def draw_velocities(dataset: xr.Dataset) -> Figure:
    """Draw Figure 14: velocities of the three centres, the first reversal enlarged."""
    figure = style.sheet(dataset, "Fig. 14  Velocity of the three centres of the trunnion", 5.4)
    time = series(dataset, "time")
    turn = 0.5 * float(dataset.attrs["cycle_period"])
    panels = figure.subplots(2, 2, sharex="col", width_ratios=(2.0, 1.0))
    for index, ((axes, beside), letter) in enumerate(zip(panels, "ab", strict=True)):
        curves: style.Curves = [
            (centre_velocity(dataset, height)[index], name, colour, dash)
            for name, height, colour, dash in CENTRES
        ]
        style.lines(axes, time, curves, width=1.0)
        enlarge(axes, beside, time, curves, (turn - 0.002, turn + 0.03))
        style.caption(axes, f"({letter}) {'XY'[index]} direction")
        style.caption(beside, "the first reversal")
        style.finish(axes, y_label="velocity [mm/s]")
    for axes in panels[-1]:
        axes.set_xlabel("time [s]", size=style.TEXT)
    style.legend_below(figure, panels[0, 0], 3)
    return figure


FORCES: Final = PaperFigure("fig12", "contact, rigid and damping forces", force_data, draw_forces)
PATH: Final = PaperFigure("fig13", "trajectory of the trunnion", path_data, draw_path)
VELOCITIES: Final = PaperFigure("fig14", "velocity of the three centres", attitude_data, draw_velocities)


#: Vane angles of the pictures [deg]; the smallest that the mechanism reaches, 61.0°, stands for the first.
ANGLES: Final = (60.0, 90.0, 120.0)


def instants(vsv: Vsv) -> tuple[FloatArray, FloatArray]:
    """Return times [s] and vane angles [rad] of the six pictures, without clearance: there and back."""
    drive = vsv.drive
    assert isinstance(drive, CrankMotion)
    crank = np.linspace(drive.start_angle, drive.start_angle + drive.swing, 2001)
    vane = ideal_vane_angle(vsv.lengths, crank)
    angles = np.clip(np.radians(ANGLES), vane[0], vane[-1])
    swung = (np.interp(angles, vane, crank) - drive.start_angle) / (0.5 * drive.swing)
    there = np.arccos(1.0 - swung) / drive.angular_frequency
    return np.append(there, drive.period - there[::-1]), np.append(angles, angles[::-1])


def balanced(vsv: Vsv, times: FloatArray) -> FloatArray:
    """Return the contact pressure [Pa] in kinetostatic equilibrium, shape (n, n_theta, n_z).

    There the trunnion lies in smooth motion once nothing rings any more; at a reversal the direction is
    that of the stroke that the time belongs to, the first half of ``times`` forward.
    """
    data = vsv_data(vsv)
    memory, joint = vsv_memory(data), new_memory(data.joint)
    pictures = np.empty((times.size, *vsv.joint.field_shape))
    for k, (time, picture) in enumerate(zip(times.tolist(), pictures, strict=True)):
        attitude = equilibrium(data, memory, time, direction=1.0 if 2 * k < times.size else -1.0)
        pressure_field(data.joint, joint, pose_at(np.append(attitude, np.zeros(4))), picture)
    return pictures.transpose(0, 2, 1)


def data(runs: Runs, formulation: str) -> xr.Dataset:
    """Return the pressure [Pa] at the six positions."""
    run = runs.vsv(formulation, 20e-6)
    case = case_of(run)
    assert case is not None
    times, angles = instants(vsv_of(case))
    pictures = keep(run, "pressure")
    pictures = pictures.assign(pressure=pictures["pressure"].copy(data=balanced(vsv_of(case), times)))
    found = {"time": times, "theta_v": angles, "direction": np.repeat([1.0, -1.0], len(ANGLES))}
    return pictures.assign_coords(
        {
            f"snapshot_{name}": ("snapshot", values, pictures[f"snapshot_{name}"].attrs)
            for name, values in found.items()
        }
    )


def draw(dataset: xr.Dataset) -> Figure:
    """Draw the six maps on the unrolled bushing."""
    title = "Fig. 15  Contact pressure at six positions of the vane, in static equilibrium"
    return draw_pictures(dataset, title, dataset["theta"].values, ANGLE)


PRESSURE: Final = PaperFigure("fig15", "contact pressure at six positions of the vane", data, draw)
