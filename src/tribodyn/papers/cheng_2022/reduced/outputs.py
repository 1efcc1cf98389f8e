"""Outputs of the vane mechanism: its vane, compared with that of a mechanism without clearance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal

import numpy as np

from tribodyn.cases.fields import choice
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.output_instants import errors_at
from tribodyn.mechanisms.output_keys import ErrorKeys, instants_of, limits_of

_OBSERVED: Final = {"angle": "theta_v", "angular_velocity": "omega_v"}
"""Name of each quantity among those that are observed; its ideal value has the ending ``_ideal``."""


class VaneOutput(ErrorKeys):
    """A quantity of the vane, which is compared with that of a mechanism without clearance."""

    quantity: Literal["angle", "angular_velocity"] = choice(
        "angle", "angle or angular velocity of the vane", "assumed"
    )


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
    outputs: Mapping[str, VaneOutput],
    times: FloatArray,
    error: FloatArray,
    crank: FloatArray,
    period: float,
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
