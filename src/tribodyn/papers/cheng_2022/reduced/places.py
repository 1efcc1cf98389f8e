"""Places of the mechanism's bodies, in the millimetres of pictures."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.cases.load import parse
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.papers.cheng_2022.reduced.case import VsvCase

MM: Final = 1e3


def case_of(dataset: xr.Dataset) -> VsvCase | None:
    """Return the case of a result; nothing where its text is not (or no longer) one of this mechanism."""
    try:
        case = parse(str(dataset.attrs.get("case", "")), "case of the result", {VsvCase.kind(): VsvCase})
    except InputError:
        return None
    return case if isinstance(case, VsvCase) else None


def crank_pivot(case: VsvCase) -> FloatArray:
    """Return the crank pivot A [mm], shape (3,)."""
    m = case.mechanism
    reach, gamma = m.pivot_distance, m.pivot_angle
    return MM * np.array([reach * np.cos(gamma), m.lever_length, reach * np.sin(gamma)])


def crank_tip(case: VsvCase, theta_a: FloatArray) -> FloatArray:
    """Return S1 = A + l_1 (−sin θ_a, 0, cos θ_a) [mm], shape (n, 3)."""
    arm = np.stack([-np.sin(theta_a), np.zeros_like(theta_a), np.cos(theta_a)], axis=1)
    return crank_pivot(case) + MM * case.mechanism.crank_length * arm


def ring_points(case: VsvCase, theta_b: float, h_1: float, angles: FloatArray) -> FloatArray:
    """Return points of the ring at angles from its pin [rad], in mm, shape (n, 3)."""
    m = case.mechanism
    beta = angles - theta_b
    height = np.full_like(beta, m.lever_length + h_1)
    return MM * np.stack([m.ring_radius * np.sin(beta), height, m.ring_radius * np.cos(beta)], axis=1)
