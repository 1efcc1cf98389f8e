"""What tables of loads follow in a run, as results hold it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribodyn.cases.beyond import FollowedTable
from tribodyn.cases.directions import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanisms.general.case import MechanismCase

_Z = 2


def followed(case: MechanismCase, couplings: Mapping[str, FloatArray], table: FollowedTable) -> FloatArray:
    """Return what a table of a load follows, shape (n_t,): coordinate or speed of a joint, or its own.

    ``couplings`` are observed of all couplings, shape (n_t, n_couplings) or (n_t, n_couplings, size) each.
    """
    if not table.follows:
        return _opposed(case, couplings, table)
    along = {
        "angles": couplings["joint_angle"],
        "positions": couplings["displacement"][..., _Z],
        "speeds": couplings["relative_rate"][..., _Z],
        "velocities": couplings["relative_velocity"][..., _Z],
    }[table.over]
    return np.asarray(case.joints[table.follows].sign * along[:, list(case.joints).index(table.follows)])


def _opposed(case: MechanismCase, couplings: Mapping[str, FloatArray], table: FollowedTable) -> FloatArray:
    """Return the speed that a load opposes, shape (n_t,)."""
    name = table.path.split(".")[1]
    place = len(case.joints) + len(case.springs) + list(case.loads).index(name)
    twist = couplings["relative_rate" if table.over == "speeds" else "relative_velocity"][:, place]
    direction = case.loads[name].direction
    if direction is None:
        return np.asarray(np.linalg.norm(twist, axis=1))
    return np.asarray(np.abs(dense.product(twist, np.array(unit(direction, "direction")))))
