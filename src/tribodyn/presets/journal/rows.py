"""Rows of a journal's run in the coordinates and signs of the source paper."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Quantity, names
from tribodyn.kernels.joints.quantities import EXTREMES
from tribodyn.kernels.joints.quantities import REPORTED as OF_BUSHING
from tribodyn.kernels.joints.quantities import WATCHED as OF_JOINT
from tribodyn.kernels.joints.surface.quantities import REPORTED
from tribodyn.kernels.mechanism.quantities import BODY, COUPLING
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import Observed
from tribodyn.mechanism.results.kept import Layout
from tribodyn.results.peaks import of_run_described
from tribodyn.results.variables import Variable, described

FILM: Final = (
    Quantity("F_ox", "N", "force of the oil film on the journal along X"),
    Quantity("F_oy", "N", "force of the oil film on the journal along Y"),
    Quantity("M_ox", "N m", "moment of the oil film about X"),
    Quantity("M_oy", "N m", "moment of the oil film about Y (left-handed)"),
    Quantity("M_of", "N m", "friction moment of the oil film about Z"),
)
LOADS: Final = (
    Quantity("W_x", "N", "load on the journal along X"),
    Quantity("W_y", "N", "load on the journal along Y"),
    Quantity("W_mx", "N m", "moment of the load about X"),
    Quantity("W_my", "N m", "moment of the load about Y (left-handed)"),
)
ROTATION: Final = (Quantity("omega", "rad s-1", "speed of rotation about Z"),)
ENERGIES: Final = (Quantity("energy_kinetic", "J", "kinetic energy of the motion in the clearance"),)
WATCHED: Final = (*OF_JOINT, Quantity("film_force", "N", "film force"))
"""Sizes whose peaks are kept."""
COUNTS: Final = (Quantity("rebounds", "1", "how often the journal left contact again", ()),)

VARIABLES: Final[dict[str, Variable]] = {
    **described(FILM, LOADS, ROTATION, ENERGIES, EXTREMES, COUNTS),
    **of_run_described(WATCHED),
    "energy_film": Variable("J", "heat of the oil film"),
    "settling_time": Variable(
        "s", "time after which the centre stays within 1 % of the clearance of its static equilibrium", ()
    ),
    "contact_start": Variable("s", "first output time at which any point is in contact", ()),
    "e_x_balance": Variable("m", "e_x of the static equilibrium", ()),
    "e_y_balance": Variable("m", "e_y of the static equilibrium", ()),
    "friction_coefficient_end": Variable("1", "friction moment over radius and load, at the end", ()),
    "energy_drive": Variable("J", "work of the drive"),
    "energy_loads": Variable("J", "work of the loads"),
    "energy_friction": Variable("J", "friction heat of the bushing"),
    "energy_damping": Variable("J", "damping heat of the contact"),
    "energy_residual": Variable("J", "error of the energy balance"),
}
"""By name."""


TURNED: Final = "turned"
"""Name of the angle of rotation since the start [rad]; results do not hold it."""
_SAME: Final = tuple(name for name in names(OF_BUSHING) if name in names(REPORTED))
"""Quantities that a bushing and a surface of any joint report under one name and with one sign."""
_OF_BEARING: Final = (
    *("joint_angle", "displacement", "tilt_x", "tilt_y", "relative_velocity", "relative_rate"),
    *("reaction_force_global", "reaction_moment_global", "film_force", "film_moment"),
    *("joint_work", "joint_friction", "joint_damping", "joint_film"),
)
_OF_LOADS: Final = ("reaction_force_global", "reaction_moment_global", "joint_work")
_MOMENTS: Final = {"M_jc": "M_c", "M_k": "M_k", "M_f": "M_f"}


def layout_of(mechanism: MechanismCase) -> Layout:
    """Return the numbers of the mechanism that a run keeps; it keeps the report of the bearing, too."""
    of_body = tuple(quantity for quantity in BODY if quantity.name == "angular_velocity")
    bearing, loads = (
        tuple(quantity for quantity in COUPLING if quantity.name in chosen)
        for chosen in (_OF_BEARING, _OF_LOADS)
    )
    return Layout(1, len(mechanism.joints), len(mechanism.loads), of_body, bearing, loads)


def rows_of(
    found: Observed,
    report: Mapping[str, FloatArray],
    *,
    joints: int,
    heights: FloatArray,
    signs: FloatArray,
    spin_inertia: float,
    tilts: bool,
) -> dict[str, FloatArray]:
    """Return the sources of a journal's results, each of shape (n_t,).

    Parameters
    ----------
    found
        What is observed of the mechanism; its first joint is the bearing.
    report
        That of the surface of the bearing, by name.
    joints
        Number of joints; all couplings behind them are loads.
    heights
        Where each load acts on the axis, from the centre [m].
    signs
        Of each load: −1 where it turns with the journal, and is observed on the ground.
    spin_inertia
        Moment of inertia about the axis [kg m²]: the energy of the rotation is left out.
    tilts
        Whether the journal can tilt; otherwise its tilts are rounding, and left out.
    """
    parts = found.couplings
    rows = {**_states(parts), **{name: report[name] for name in _SAME}}
    if not tilts:
        rows |= {name: np.zeros_like(rows[name]) for name in rows if name.startswith("phi_")}
    for own, name in _MOMENTS.items():
        rows[f"{own}x"], rows[f"{own}y"] = report[f"{name}x"], -report[f"{name}y"]
    film, moment = parts["film_force"][:, 0], parts["film_moment"][:, 0]
    lean_x, lean_y = parts["tilt_x"][:, 0], parts["tilt_y"][:, 0]
    # Of a tilted shaft the moment of the pressure, normal to its axis, has a part about Z.
    friction = moment[:, 2] + lean_y * moment[:, 0] - lean_x * moment[:, 1]
    of_film = (film[:, 0], film[:, 1], moment[:, 0], -moment[:, 1], friction)
    force = signs[:, None] * parts["reaction_force_global"][:, joints:]
    turning = signs[:, None] * parts["reaction_moment_global"][:, joints:]
    work, omega = parts["joint_work"], parts["relative_rate"][:, 0, 2]
    spins = found.bodies["angular_velocity"][:, 0]
    about = (lean_y * spins[:, 0] - lean_x * spins[:, 1] + spins[:, 2]) ** 2 / (1.0 + lean_x**2 + lean_y**2)
    rotation = 0.5 * spin_inertia * about
    return {
        **rows,
        "M_jf": report["M_fz"],
        **dict(zip(names(FILM), of_film, strict=True)),
        "W_x": force[:, :, 0].sum(axis=1),
        "W_y": force[:, :, 1].sum(axis=1),
        "W_mx": (turning[:, :, 0] - heights * force[:, :, 1]).sum(axis=1),
        "W_my": -(turning[:, :, 1] + heights * force[:, :, 0]).sum(axis=1),
        "omega": omega,
        TURNED: parts["joint_angle"][:, 0],
        "energy_kinetic": found.whole["energy_kinetic"] - rotation,
        "work_loads": work[:, joints:].sum(axis=1),
        "work_friction": -parts["joint_friction"][:, 0],
        "heat_damping": parts["joint_damping"][:, 0],
        "work_drive": work[:, 0] - (rotation - rotation[:1]),
        "work_film": -parts["joint_film"][:, 0],
    }


def _states(parts: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return place and velocity of the centre, and tilts as angles with their rates; φ_y is left-handed."""
    d, v, w = (parts[name][:, 0] for name in ("displacement", "relative_velocity", "relative_rate"))
    x, y = parts["tilt_x"][:, 0], parts["tilt_y"][:, 0]
    # Slopes follow the angular velocity by the matrix G of ``kernels/joints/surface/tilt.py``.
    rate_x = (1.0 + x * x) * w[:, 0] + x * y * w[:, 1] - y * w[:, 2]
    rate_y = x * y * w[:, 0] + (1.0 + y * y) * w[:, 1] + x * w[:, 2]
    return {
        "e_x": d[:, 0],
        "e_y": d[:, 1],
        "phi_x": portable.atan2(x, np.ones(x.size)),
        "phi_y": -portable.atan2(y, np.ones(y.size)),
        "e_x_dot": v[:, 0],
        "e_y_dot": v[:, 1],
        "phi_x_dot": rate_x / (1.0 + x * x),
        "phi_y_dot": -rate_y / (1.0 + y * y),
    }


def peaks_of(
    times: FloatArray, rows: Mapping[str, FloatArray], at_steps: Mapping[str, float]
) -> dict[str, float]:
    """Return the largest of each watched size and its time [s], by name; NaN without rows.

    Parameters
    ----------
    times
        Of the rows [s], shape (n_t,).
    rows
        From :func:`rows_of`.
    at_steps
        Peaks and their times that kernels noted at steps, by name; they may lie between rows.
    """
    of_rows = {
        "contact_force": portable.hypot(rows["F_cx"], rows["F_cy"]),
        "rigid_force": portable.hypot(rows["F_kx"], rows["F_ky"]),
        "damping_force": portable.hypot(rows["F_cx"] - rows["F_kx"], rows["F_cy"] - rows["F_ky"]),
        "pressure": rows["p_max"],
        "eccentricity": portable.hypot(rows["e_x"], rows["e_y"]),
        "tilt": portable.hypot(rows["phi_x"], rows["phi_y"]),
        "film_force": portable.hypot(rows["F_ox"], rows["F_oy"]),
    }
    found = {}
    for name in names(WATCHED):
        largest, when = _peak(times, of_rows[name])
        if at_steps.get(f"{name}_peak", -np.inf) > largest:
            largest, when = at_steps[f"{name}_peak"], at_steps[f"{name}_peak_time"]
        found[f"{name}_peak"], found[f"{name}_peak_time"] = largest, when
    return found


def _peak(times: FloatArray, sizes: FloatArray) -> tuple[float, float]:
    """Return the largest of some sizes and its time, of the parabola through the rows about it."""
    if not np.isfinite(sizes).any():
        return np.nan, np.nan
    row = int(np.nanargmax(sizes))
    largest, when = float(sizes[row]), float(times[row])
    if not 0 < row < sizes.size - 1:
        return largest, when
    left, right = largest - float(sizes[row - 1]), largest - float(sizes[row + 1])
    if not left + right > 0.0:
        return largest, when
    lean = (left - right) / (left + right)
    return largest + 0.125 * lean * (left - right), when + 0.25 * lean * float(
        times[row + 1] - times[row - 1]
    )


def rebounds_of(rows: Mapping[str, FloatArray]) -> float:
    """Return the number of times that contact ended altogether, from row to row."""
    touching = rows["contact_fraction"] > 0.0
    return float(np.count_nonzero(touching[:-1] & ~touching[1:]))
