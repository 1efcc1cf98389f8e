"""Figure 15: contact pressure at three vane angles in both directions, in static equilibrium."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.pressure import draw as draw_pictures
from tribodyn.joints.bushing import new_memory, pose_at
from tribodyn.kernels.joints.bushing import pressure_field
from tribodyn.papers.cheng_2022.layout import ANGLE, keep
from tribodyn.papers.cheng_2022.reduced.equilibrium import equilibrium
from tribodyn.papers.cheng_2022.reduced.parameters import CrankMotion, Vsv
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.reach import ideal_vane_angle
from tribodyn.papers.cheng_2022.reduced.sections import case_of
from tribodyn.papers.cheng_2022.reduced.system import vsv_of
from tribodyn.papers.cheng_2022.runs import PaperFigure, Runs

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
