"""Efforts and power of drives, motors and controllers, and the work of loads, as results hold them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_variables import Observed

_Z: Final = 2
INPUTS: Final = ("relative_rate", "relative_velocity")
"""Rates of joints that power is computed from, beside the efforts of drives."""


def with_motors(model: Model, found: Observed) -> Observed:
    """Return rows whose moments and forces of drives contain those of motors and controllers."""
    couplings, leg = found.couplings, model.first_leg
    efforts = {name: couplings[name].copy() for name in ("drive_moment", "drive_force")}
    for element in model.elements:
        if element.keys.IS_DRIVE:
            joint = element.keys.named_joints["joint"][0]
            number, sign = model.joints.index(joint), model.case.joints[joint].sign
            efforts["drive_moment"][:, number] += sign * couplings["reaction_moment"][:, leg, _Z]
            efforts["drive_force"][:, number] += sign * couplings["reaction_force"][:, leg, _Z]
        leg += len(element.legs)
    return replace(found, couplings={**couplings, **efforts})


def power_columns(model: Model, couplings: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the power of the drives of each joint [W], shape (n_t, n_joints), and the work of loads [J].

    Those that the mechanism has: ``couplings`` are of rows with motors.
    """
    case, n, found = model.case, len(model.joints), {}
    if case.has_drives:
        moment, force = couplings["drive_moment"][:, :n], couplings["drive_force"][:, :n]
        rate, velocity = (couplings[name][:, :n, _Z] for name in INPUTS)
        found["drive_power"] = moment * rate + force * velocity
    if case.loads:
        found["energy_loads"] = np.sum(couplings["joint_work"][:, n : model.first_leg], axis=1)
    return found
