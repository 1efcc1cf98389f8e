"""Rows of a mechanism that follow the steps of the integration."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Following
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_variables import columns_of


def following(model: Model, period: float, times: FloatArray) -> Following | None:
    """Return the intervals in which rows follow the steps: shafts may strike faster than output times see.

    Parameters
    ----------
    model
        The mechanism.
    period
        Time of one cycle [s].
    times
        Of the other rows, from 0 to the end [s], shape (n_t,).
    """
    most, n_bodies, duration = model.case.run.step_rows, len(model.bodies), float(times[-1])
    if not model.clearances or most == 0:
        return None
    driven = [model.joints.index(drive.joint) for drive in model.case.drives.values()]
    watched = (
        *(columns_of("reaction_force", k, n_bodies) for k in range(len(model.joints))),
        *(columns_of("pressure_max", k, n_bodies) for k in model.real),
        *(columns_of("film_pressure_max", k, n_bodies) for k in model.oiled),
        *(columns_of(f"drive_{name}", k, n_bodies) for k in driven for name in ("moment", "force")),
    )
    n = min(max(round(duration / period), 1), times.size)
    edges = np.linspace(0.0, duration, n + 1)
    return Following(np.column_stack([edges[:-1], edges[1:]]), max(most, 2 * len(watched) + 1), watched)
