"""Forces and moments of elements, from the observed quantities of their legs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.element import Leg


def transmitted(model: Model, couplings: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return force [N] and moment [N m] of elements, each of shape (n_t, n_elements); nothing without any."""
    if not model.elements:
        return {}
    forces, moments, first = [], [], model.first_leg
    for element in model.elements:
        force = moment = np.zeros(len(couplings["reaction_force"]))
        for equation in element.equations:
            last, of = first + len(equation.legs) - 1, first + element.keys.MOMENT_OF
            force = force + _along(equation.legs[-1], couplings, last)
            turns = equation.legs[element.keys.MOMENT_OF].about != 0.0
            moment = moment + (couplings["reaction_moment"][:, of, 2] if turns else np.nan)
            first = last + 1
        forces.append(force)
        moments.append(moment)
    return {"element_force": np.stack(forces, axis=-1), "element_moment": np.stack(moments, axis=-1)}


def _along(leg: Leg, couplings: Mapping[str, FloatArray], number: int) -> FloatArray:
    """Return the force of a leg along its direction [N], shape (n_t,); NaN for a moment alone."""
    force = couplings["reaction_force"][:, number]
    if leg.measure == "coordinate":
        along = leg.along if leg.reported is None else leg.reported
        found = dense.product(force, along) if np.any(along) else np.full(len(force), np.nan)
        return np.asarray(found)
    way = couplings["displacement" if leg.measure == "distance" else "relative_velocity"][:, number]
    size = np.linalg.norm(way, axis=-1)
    return np.asarray(np.sum(force * way, axis=-1) / np.where(size > 0.0, size, 1.0))
