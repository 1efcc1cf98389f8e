"""Results of a journal: names of the source paper for native results, and its key results."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanism import mechanism_variables
from tribodyn.mechanism.assembly.skeleton import case_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.results import mechanism_results
from tribodyn.presets.journal.case import BEARING
from tribodyn.results.reading import column, norm, peak
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import Variable

#: Distance from the static equilibrium, over the clearance, within which a journal has settled.
SETTLED: Final = 0.01
_AT_REST: Final = 1.0e-9  #: Speed of rotation below which a journal does not turn [rad/s].

#: By name; those that a mechanism has, too, under the names of the paper.
VARIABLES: Final[dict[str, Variable]] = {
    **mechanism_variables.VARIABLES,
    "e_x": Variable("m", "offset of the journal's centre along X"),
    "e_y": Variable("m", "offset of the journal's centre along Y"),
    "phi_x": Variable("rad", "tilt of the journal about X (right-handed)"),
    "phi_y": Variable("rad", "tilt of the journal about Y (left-handed)"),
    "e_x_dot": Variable("m s-1", "velocity of the journal's centre along X"),
    "e_y_dot": Variable("m s-1", "velocity of the journal's centre along Y"),
    "omega": Variable("rad s-1", "speed of rotation about Z"),
    "F_cx": Variable("N", "normal contact force on the journal along X"),
    "F_cy": Variable("N", "normal contact force on the journal along Y"),
    "F_fx": Variable("N", "friction force on the journal along X"),
    "F_fy": Variable("N", "friction force on the journal along Y"),
    "M_jf": Variable("N m", "moment of the contact about Z: that of its friction"),
    "p_max": Variable("Pa", "peak contact pressure, edges included"),
    "F_ox": Variable("N", "force of the oil film on the journal along X"),
    "F_oy": Variable("N", "force of the oil film on the journal along Y"),
    "M_of": Variable("N m", "friction moment of the oil film about Z"),
    "W_x": Variable("N", "load on the journal along X"),
    "W_y": Variable("N", "load on the journal along Y"),
    "W_mx": Variable("N m", "moment of the load about X"),
    "W_my": Variable("N m", "moment of the load about Y (left-handed)"),
    "energy_drive": Variable("J", "work of the drive since the start"),
    "e_x_balance": Variable("m", "e_x of the static equilibrium", ()),
    "e_y_balance": Variable("m", "e_y of the static equilibrium", ()),
}


def named_as_printed(native: Mapping[str, FloatArray], *, tilts: bool) -> dict[str, FloatArray]:
    """Return motion and forces of the bearing under the names and with the signs of the source paper.

    ``native``: columns of the joints of the mechanism, each of shape (n_t, n_joints, ...); the first is the
    bearing; ``tilts``: whether the journal can tilt; otherwise its tilts are rounding, and zero here.
    """
    one = {name: values[:, 0] for name, values in native.items() if values.ndim > 1}
    lean_x, lean_y = (one[f"tilt_{axis}"] if tilts else np.zeros_like(one["tilt_x"]) for axis in "xy")
    friction, moment = one["reaction_force"] - one["contact_force"], one["reaction_moment"][:, 2]
    printed = {
        **_components("e_{}", one["displacement"]),
        "phi_x": portable.atan2(lean_x, np.ones(lean_x.size)),
        "phi_y": -portable.atan2(lean_y, np.ones(lean_y.size)),
        **_components("e_{}_dot", one["relative_velocity"]),
        "omega": one["relative_rate"][:, 2],
        **_components("F_c{}", one["contact_force"]),
        "p_max": one["pressure_max"],
    }
    if "film_force" in one:
        film = one["film_moment"]
        # Of a tilted shaft the moment of the pressure, normal to its axis, has a part about Z.
        printed["M_of"] = film[:, 2] + lean_y * film[:, 0] - lean_x * film[:, 1]
        printed |= _components("F_o{}", one["film_force"])
        friction, moment = friction - one["film_force"], moment - film[:, 2]
    return {**printed, **_components("F_f{}", friction), "M_jf": moment}


def loads_as_printed(couplings: Mapping[str, FloatArray], case: MechanismCase) -> dict[str, FloatArray]:
    """Return the loads on the journal, each of shape (n_t,).

    ``couplings``: observed quantities of joints and, behind them, loads, each of shape (n_t, n_couplings,
    ...); ``case``: the mechanism that the journal is.
    """
    first, loads = len(case.joints), case.loads.values()
    # A load that turns with the journal is observed on the ground.
    signs = np.array([-1.0 if load.frame == "body" else 1.0 for load in loads])[:, None]
    heights = np.array([(load.point or (0.0, 0.0, 0.0))[2] for load in loads])
    force = signs * couplings["reaction_force_global"][:, first:]
    moment = signs * couplings["reaction_moment_global"][:, first:]
    return {
        "W_x": force[:, :, 0].sum(axis=1),
        "W_y": force[:, :, 1].sum(axis=1),
        "W_mx": (moment[:, :, 0] - heights * force[:, :, 1]).sum(axis=1),
        "W_my": -(moment[:, :, 1] + heights * force[:, :, 0]).sum(axis=1),
    }


def _components(name: str, vectors: FloatArray) -> dict[str, FloatArray]:
    """Return the first two components of vectors (n_t, 3) by name."""
    return {name.format(axis): vectors[:, k] for k, axis in enumerate("xy")}


def _settling_time(run: xr.Dataset) -> float:
    balance = [column(run, f"e_{axis}_balance") for axis in "xy"]
    off = np.hypot(column(run, "e_x") - balance[0], column(run, "e_y") - balance[1])
    time, outside = column(run, "time"), np.flatnonzero(~(off <= SETTLED * run.attrs["clearance"]))
    return 1e3 * (float(time[outside[-1] + 1]) if outside.size else 0.0)


def _touching(run: xr.Dataset) -> NDArray[np.bool_]:
    """Return at which times any point is in contact."""
    onset = _mechanism(run).contact.onset_separation * run.attrs["roughness"]
    return np.asarray(column(run, "gap_min")[:, 0] < onset)


def _mechanism(run: xr.Dataset) -> MechanismCase:
    case = case_of(run)
    if case is None:
        raise ValueError("the result lacks its model file")
    return case


def _contact_start(run: xr.Dataset) -> float:
    return 1e3 * float(column(run, "time")[np.flatnonzero(_touching(run))[0]])


def _rebounds(run: xr.Dataset) -> float:
    touching = _touching(run)
    return float(np.count_nonzero(touching[:-1] & ~touching[1:]))


def _friction(run: xr.Dataset) -> float:
    """Return the friction moment over radius and load at the end; a journal at rest has none."""
    moment, load = column(run, "reaction_moment")[-1, 0, 2], norm(run, "W_x", "W_y")[-1]
    bearing = _mechanism(run).joints[BEARING].real
    if bearing is None or bearing.radius is None or abs(column(run, "omega")[-1]) < _AT_REST:
        return np.nan
    return float(abs(moment) / (bearing.radius * load))


_OF_MECHANISMS: Final = (
    *("flash_temperature_K", "film_pressure_max_MPa", "film_thickness_min_um", "film_power_mean_W"),
    "energy_residual_percent",
)
#: By name, in reading order.
KEY_RESULTS: Final[dict[str, KeyResult]] = {
    "settling_time_ms": KeyResult(
        "Settling time",
        "ms",
        "Settling",
        "Time after which the centre stays within 1 % of the clearance of its static equilibrium; a rebound "
        "that just gets there moves it by its length.",
        _settling_time,
        digits=1,
    ),
    "contact_start_ms": KeyResult(
        "Contact begins",
        "ms",
        "Settling",
        "When the first asperities meet: the gap falls below the onset separation.",
        _contact_start,
    ),
    "rebounds": KeyResult(
        "Rebounds",
        "",
        "Settling",
        "How often the journal left contact again altogether.",
        _rebounds,
        count=True,
    ),
    "contact_force_max_N": KeyResult(
        "Contact force, peak",
        "N",
        "Impact",
        "Load on the bushing in the hardest impact, at any step of the integration.",
        lambda run: peak(column(run, "contact_force_peak")),
    ),
    "film_force_max_N": KeyResult(
        "Film force, peak",
        "N",
        "Impact",
        "Largest force of the oil, at any step.",
        lambda run: peak(column(run, "film_force_peak")),
    ),
    "peak_pressure_MPa": KeyResult(
        "Contact pressure, peak",
        "MPa",
        "Impact",
        "The same for the pressure; compare it with the hardness of the bushing.",
        lambda run: 1e-6 * peak(column(run, "pressure_peak")),
    ),
    "eccentricity_max_um": KeyResult(
        "Eccentricity, peak",
        "µm",
        "Impact",
        "How far the centre moves off the axis; beyond the clearance the mean planes overlap.",
        lambda run: 1e6 * peak(norm(run, "e_x", "e_y")),
    ),
    "friction_coefficient": KeyResult(
        "Friction coefficient at the end",
        "",
        "Impact",
        "Friction moment of contact and film over journal radius and load.",
        _friction,
    ),
    **{name: mechanism_results.KEY_RESULTS[name] for name in _OF_MECHANISMS},
}
