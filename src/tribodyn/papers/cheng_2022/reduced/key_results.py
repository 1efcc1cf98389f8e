"""Key results of the vane mechanism, and its output: the vane against a mechanism without clearance."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.fields import choice
from tribodyn.core.quantities import Record
from tribodyn.mechanisms.output_keys import ErrorKeys, instants_of, limits_of
from tribodyn.mechanisms.output_numbers import errors_at
from tribodyn.results.reading import (
    column,
    largest,
    norm,
    outside,
    peak,
    reversals_held,
    rms,
    sustained,
    time_mean,
)
from tribodyn.results.summary import KeyResult
from tribodyn.results.wear_numbers import WEAR_NUMBERS

if TYPE_CHECKING:
    import xarray as xr


#: Name of each quantity among those that are observed; its ideal value has the ending ``_ideal``.
_OBSERVED: Final = {"angle": "theta_v", "angular_velocity": "omega_v"}


class VaneOutput(ErrorKeys):
    """A quantity of the vane, which is compared with that of a mechanism without clearance."""

    quantity: Literal["angle", "angular_velocity"] = choice(
        "angle", "angle or angular velocity of the vane", "assumed"
    )


#: Signs of e_x, e_y, φ_x and φ_y, which is left-handed, over right-handed ones.
_HANDS: Final = np.array([1.0, 1.0, 1.0, -1.0])
DEFAULT: Final = {"outputs.vane.quantity": "angle"}  #: The output that every case has.


def output_columns(
    outputs: Mapping[str, VaneOutput], rows: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return values, ideal values and errors of outputs over time, each of shape (n_t, n_outputs).

    ``rows`` are the observed quantities by name, each of shape (n_t,).
    """
    names = [_OBSERVED[keys.quantity] for keys in outputs.values()]
    value, ideal = (np.stack([rows[f"{name}{end}"] for name in names], axis=1) for end in ("", "_ideal"))
    return {"output_value": value, "output_ideal": ideal, "output_error": value - ideal}


def output_fields(
    outputs: Mapping[str, VaneOutput], times: FloatArray, error: FloatArray, crank: FloatArray, period: float
) -> dict[str, FloatArray]:
    """Return the limits of the errors of outputs, and their errors at angles of the crank, or times.

    ``outputs``: by name; ``times``: rising [s], shape (n_t,); ``error``: of the outputs, shape (n_t,
    n_outputs); ``crank``: angle of the crank [rad], shape (n_t,); ``period``: of a cycle [s].
    """
    instants, errors = instants_of(outputs), dict(zip(outputs, error.T, strict=True))
    at = errors_at(instants, times, errors, lambda instant: crank, period) if instants else {}
    return {"output_error_limit": limits_of(outputs), **at}


def error_growth(
    outputs: Mapping[str, VaneOutput], mechanism: Record, poses: FloatArray, moved: FloatArray
) -> FloatArray:
    """Return the errors of outputs by displacements of the trunnion, shape (n_t, n_outputs).

    ``outputs``: by name; ``mechanism``: sizes of the mechanism, as kernels read them; ``poses``: θ_a, e_x,
    e_y, φ_x and φ_y [rad and m], shape (n_t, 5); ``moved``: displacement [m] and rotation [rad] of the
    trunnion, right-handed, shape (n_t, 6). Returns in the units of the outputs; NaN for angular velocities.
    """
    change = moved[:, [0, 1, 3, 4]] * _HANDS
    forward, backward = (
        _vane_angles(mechanism, poses[:, 0], poses[:, 1:] + side * change) for side in (0.5, -0.5)
    )
    of_angle = (forward - backward)[:, None]
    is_angle = [keys.quantity == "angle" for keys in outputs.values()]
    return np.asarray(np.where(is_angle, of_angle, np.nan))


def _vane_angles(mechanism: Record, theta_a: FloatArray, attitudes: FloatArray) -> FloatArray:
    """Return angles of the vane [rad], shape (n,).

    ``mechanism``: sizes of the mechanism; ``theta_a``: angles of the crank [rad], shape (n,); ``attitudes``:
    e_x, e_y, φ_x and φ_y of the trunnion [m and rad], shape (n, 4).
    """
    from tribodyn.kernels.vsv.closure import vane_attitude

    s1_x = mechanism.pivot_x - mechanism.l_1 * portable.sin(theta_a)
    s1_z = mechanism.pivot_z + mechanism.l_1 * portable.cos(theta_a)
    places = np.column_stack([theta_a, s1_x, s1_z, attitudes[:, :2], portable.tan(attitudes[:, 2:])])
    return np.array([vane_attitude(mechanism, *place)[0] for place in places.tolist()])


def _angle_error(dataset: xr.Dataset) -> FloatArray:
    """Return the vane-angle error [deg] over time."""
    return np.rad2deg(column(dataset, "theta_v") - column(dataset, "theta_v_ideal"))


@dataclass(frozen=True)
class _Peak:
    """A maximum that is given twice, outside the impacts and with them, and the sustained maximum."""

    names: tuple[str, str]  #: Of the number outside and of the one with impacts.
    #: See :class:`~tribodyn.results.summary.KeyResult`.
    label: str
    unit: str
    group: str
    meaning: str
    quantity: str  #: Name of the quantity among those whose peaks results hold.
    scale: float  #: The unit of the result over that of the number.
    values: Callable[[xr.Dataset], FloatArray]  #: The quantity over time.
    digits: int = 2  #: How many digits of the peak hold.
    sustained: str = ""  #: Name of the sustained maximum; empty where an output has it.

    @property
    def key_results(self) -> dict[str, KeyResult]:
        """The numbers, by name."""
        quiet, loud = self.names
        lasts = KeyResult(
            f"{self.label}, sustained",
            self.unit,
            self.group,
            "Exceeded during 1 % of the time only; impacts excluded.",
            lambda d: sustained(d, self.values(d)) * self.scale,
        )
        return {
            **({self.sustained: lasts} if self.sustained else {}),
            quiet: KeyResult(
                f"{self.label}, peak without impacts",
                self.unit,
                self.group,
                self.meaning,
                lambda d: outside(d, self.quantity) * self.scale,
                digits=4,
            ),
            loud: KeyResult(
                f"{self.label}, peak",
                self.unit,
                self.group,
                "The same, with the impacts. It grows with the number of reversals that are looked at.",
                lambda d: largest(d, self.quantity, self.values(d)) * self.scale,
                digits=self.digits,
                over="reversals",
            ),
        }


_ANGLE_ERROR: Final = _Peak(
    ("vane_angle_error_outside_deg", "vane_angle_error_max_deg"),
    "Vane-angle error",
    "°",
    "Accuracy",
    "How far clearance lets the vane stray from where the drive puts it, once impacts have died away.",
    "vane_angle_error",
    math.degrees(1.0),
    lambda d: np.deg2rad(_angle_error(d)),
    digits=3,
)
_LOADS: Final = (
    _Peak(
        ("contact_force_outside_N", "contact_force_max_N"),
        "Contact force",
        "N",
        "Load",
        "Load on the bushing while the vane moves smoothly.",
        "contact_force",
        1.0,
        lambda d: norm(d, "F_cx", "F_cy"),
        sustained="contact_force_sustained_N",
    ),
    _Peak(
        ("pressure_outside_MPa", "peak_pressure_MPa"),
        "Contact pressure",
        "MPa",
        "Load",
        "Highest pressure anywhere in the bushing; compare it with the hardness.",
        "pressure",
        1e-6,
        lambda d: column(d, "p_max"),
        sustained="pressure_sustained_MPa",
    ),
    _Peak(
        ("tilt_outside_mrad", "tilt_max_mrad"),
        "Tilt",
        "mrad",
        "Load",
        "How far the trunnion leans in the bushing: tilt loads the edges.",
        "tilt",
        1e3,
        lambda d: norm(d, "phi_x", "phi_y"),
        digits=3,
    ),
    _Peak(
        ("eccentricity_outside_um", "eccentricity_max_um"),
        "Eccentricity",
        "µm",
        "Load",
        "How far the trunnion centre moves off the bushing axis.",
        "eccentricity",
        1e6,
        lambda d: norm(d, "e_x", "e_y"),
        digits=3,
    ),
    _Peak(
        ("drive_moment_outside_Nm", "drive_moment_max_Nm"),
        "Drive moment",
        "N m",
        "Load",
        "What the actuator must deliver at the crank.",
        "drive_moment",
        1.0,
        lambda d: column(d, "M_d"),
        sustained="drive_moment_sustained_Nm",
    ),
)

#: By name, in reading order.
KEY_RESULTS: Final[dict[str, KeyResult]] = {
    "reversals": KeyResult(
        "Reversals held",
        "",
        "Accuracy",
        "Reversals of the vane in this result with the impacts that follow them: what peaks were taken over.",
        reversals_held,
        count=True,
    ),
    **_ANGLE_ERROR.key_results,
    "vane_angle_error_rms_deg": KeyResult(
        "Vane-angle error, rms",
        "°",
        "Accuracy",
        "The same error as an average over the run.",
        lambda d: rms(d, _angle_error(d)),
    ),
    "vane_speed_error_rms_deg_per_s": KeyResult(
        "Vane-speed error, rms",
        "°/s",
        "Accuracy",
        "How unsteadily the vane turns compared with a tight joint; impacts make most of it.",
        lambda d: rms(d, np.rad2deg(column(d, "omega_v") - column(d, "omega_v_ideal"))),
        digits=2,
    ),
    "contact_force_mean_N": KeyResult(
        "Contact force, mean",
        "N",
        "Load",
        "Average load on the bushing: what wears it.",
        lambda d: time_mean(d, norm(d, "F_cx", "F_cy")),
        digits=4,
    ),
    **{name: key_result for load in _LOADS for name, key_result in load.key_results.items()},
    "flash_temperature_K": KeyResult(
        "Flash temperature",
        "K",
        "Load",
        "How much warmer than the surfaces their asperities get, an estimate, where pressure times speed is "
        "largest.",
        lambda d: float(d.attrs["flash_temperature"]),
        digits=2,
    ),
    "wear_depth_max_nm": KeyResult(
        "Wear depth",
        "nm",
        "Wear",
        "Deepest point of the worn bushing: after the wear campaign, or a linear estimate for this run.",
        lambda d: peak(column(d, "wear_depth")) * 1e9,
    ),
    **WEAR_NUMBERS,
    "energy_residual_percent": KeyResult(
        "Energy residual, whole system",
        "%",
        "Trust",
        "Error of the energy balance of all moving bodies over its largest term; below 1 % is sound.",
        lambda d: float(d.attrs["energy_residual"]) * 100.0,
        digits=2,
    ),
    "clearance_energy_residual_percent": KeyResult(
        "Energy residual, clearance motion",
        "%",
        "Trust",
        "The stricter energy balance, of the motion in the clearance alone.",
        lambda d: float(d.attrs["clearance_energy_residual"]) * 100.0,
        digits=2,
    ),
}

#: Most important key results.
KEY_NUMBERS: Final = (
    "vane_angle_error_outside_deg",
    "contact_force_outside_N",
    "contact_force_max_N",
    "peak_pressure_MPa",
    "drive_moment_outside_Nm",
    "wear_depth_rate_nm_per_1000_cycles",
    "clearance_energy_residual_percent",
)
