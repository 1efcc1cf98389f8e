"""The mechanism in space: where every body is at the frames."""

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.cases.load import parse
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.views.encode import packed
from tribodyn.views.playback import at_frames, magnification, playback_times
from tribodyn.views.section import Payload, Section

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


def data(dataset: xr.Dataset) -> Payload | None:
    """Return points [mm], angles [rad] and the attitude of the trunnion [mm, rad] at the frames."""
    case = case_of(dataset)
    if case is None or playback_times(dataset).size < 2:
        return None
    joint = case.joint
    return {
        "size": {
            "ring_radius": case.mechanism.ring_radius * MM,
            "lever": case.mechanism.lever_length * MM,
            "vane": case.mechanism.vane_length * MM,
            "ring_angle": case.mechanism.ring_angle,
            "radius": joint.radius * MM,
            "length": joint.length * MM,
            "collar": joint.collar_radius * MM,
            "clearance": dataset.attrs["clearance"] * MM,
        },
        "magnification": magnification(joint.radius / dataset.attrs["clearance"]),
        "pivot": [float(value) for value in crank_pivot(case)],
        "crank_tip": packed(crank_tip(case, at_frames(dataset, "theta_a"))),
        **{name: packed(at_frames(dataset, name)) for name in ("theta_b", "theta_v", "phi_x", "phi_y")},
        **{name: packed(at_frames(dataset, name, MM)) for name in ("h_1", "e_x", "e_y")},
    }


SECTION: Final = Section(
    name="mechanism",
    title="The mechanism",
    caption=(
        "The crank pushes the drag link, which turns the unison ring; its pin swings the lever and with it "
        "the vane, whose trunnion turns in the bushing. Drag to turn it, or use the arrow keys."
    ),
    needs=("theta_a", "theta_b", "theta_v", "h_1", "e_x", "e_y", "phi_x", "phi_y"),
    widget="scene",
    data=data,
    still="mechanism",
)
