"""Outputs of the vane mechanism: its vane, compared with that of a mechanism without clearance."""

from collections.abc import Mapping
from typing import Final, Literal

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.cases.fields import choice
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.mechanisms.output_instants import errors_at
from tribodyn.mechanisms.output_keys import ErrorKeys, instants_of, limits_of

_OBSERVED: Final = {"angle": "theta_v", "angular_velocity": "omega_v"}
"""Name of each quantity among those that are observed; its ideal value has the ending ``_ideal``."""


class VaneOutput(ErrorKeys):
    """A quantity of the vane, which is compared with that of a mechanism without clearance."""

    quantity: Literal["angle", "angular_velocity"] = choice(
        "angle", "angle or angular velocity of the vane", "assumed"
    )


_HANDS: Final = np.array([1.0, 1.0, 1.0, -1.0])
"""Signs of e_x, e_y, φ_x and φ_y, which is left-handed, over right-handed ones."""
DEFAULT: Final = {"outputs.vane.quantity": "angle"}
"""The output that every case has."""


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

    Parameters
    ----------
    outputs
        By name.
    times
        Rising [s], shape (n_t,).
    error
        Of the outputs, shape (n_t, n_outputs).
    crank
        Angle of the crank [rad], shape (n_t,).
    period
        Of a cycle [s].
    """
    instants, errors = instants_of(outputs), dict(zip(outputs, error.T, strict=True))
    at = errors_at(instants, times, errors, lambda instant: crank, period) if instants else {}
    return {"output_error_limit": limits_of(outputs), **at}


def error_growth(
    outputs: Mapping[str, VaneOutput], mechanism: Record, poses: FloatArray, moved: FloatArray
) -> FloatArray:
    """Return the errors of outputs by displacements of the trunnion, shape (n_t, n_outputs).

    Parameters
    ----------
    outputs
        By name.
    mechanism
        Sizes of the mechanism, as kernels read them.
    poses
        θ_a, e_x, e_y, φ_x and φ_y [rad and m], shape (n_t, 5).
    moved
        Displacement [m] and rotation [rad] of the trunnion, right-handed, shape (n_t, 6).

    Returns
    -------
    numpy.ndarray
        In the units of the outputs; NaN for angular velocities.
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

    Parameters
    ----------
    mechanism
        Sizes of the mechanism.
    theta_a
        Angles of the crank [rad], shape (n,).
    attitudes
        e_x, e_y, φ_x and φ_y of the trunnion [m and rad], shape (n, 4).
    """
    from tribodyn.kernels.vsv.closure import vane_attitude

    s1_x = mechanism.pivot_x - mechanism.l_1 * portable.sin(theta_a)
    s1_z = mechanism.pivot_z + mechanism.l_1 * portable.cos(theta_a)
    places = np.column_stack([theta_a, s1_x, s1_z, attitudes[:, :2], portable.tan(attitudes[:, 2:])])
    return np.array([vane_attitude(mechanism, *place)[0] for place in places.tolist()])
