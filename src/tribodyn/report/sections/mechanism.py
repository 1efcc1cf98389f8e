"""The mechanism in space: where every body is at the frames, sections 1 and 5 of the model."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.cases import Vsv, parse_case
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.report.base import Payload, Section
from tribodyn.report.encode import packed
from tribodyn.report.film import at_frames, film_times

MM: Final = 1e3
_SHOWN_CLEARANCE: Final = 0.35
"""Share of the trunnion radius as which the clearance is first shown."""


def data(dataset: xr.Dataset) -> Payload | None:
    """Return points [mm], angles [rad] and the attitude of the trunnion [mm, rad] at the frames."""
    case = _case(dataset)
    if case is None or film_times(dataset).size < 2:
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
            "clearance": joint.clearance * MM,
        },
        "magnification": _magnification(joint.radius / joint.clearance),
        "pivot": [float(value) for value in _pivot(case)],
        "crank_tip": packed(_crank_tip(case, at_frames(dataset, "theta_a"))),
        **{name: packed(at_frames(dataset, name)) for name in ("theta_b", "theta_v", "phi_x", "phi_y")},
        **{name: packed(at_frames(dataset, name, MM)) for name in ("h_1", "e_x", "e_y")},
    }


def _case(dataset: xr.Dataset) -> Vsv | None:
    """Return the case of a result; nothing where its text is not (or no longer) one."""
    try:
        case = parse_case(str(dataset.attrs.get("case", "")), "case of the result")
    except InputError:
        return None
    return case if isinstance(case, Vsv) else None


def _magnification(ratio: float) -> dict[str, Any]:
    """Return the range of the magnification and where it begins: round numbers.

    Parameters
    ----------
    ratio
        Trunnion radius over clearance.
    """
    first = _SHOWN_CLEARANCE * ratio
    digit = 10.0 ** np.floor(np.log10(first))
    value = float(max(np.floor(first / digit) * digit, 1.0))
    return {"value": value, "most": 2.0 * value}


def _pivot(case: Vsv) -> FloatArray:
    """Return the crank pivot A [mm], shape (3,)."""
    m = case.mechanism
    reach, gamma = m.pivot_distance, m.pivot_angle
    return MM * np.array([reach * np.cos(gamma), m.lever_length, reach * np.sin(gamma)])


def _crank_tip(case: Vsv, theta_a: FloatArray) -> FloatArray:
    """Return S1 = A + l_1 (−sin θ_a, 0, cos θ_a) [mm], shape (n, 3)."""
    arm = np.stack([-np.sin(theta_a), np.zeros_like(theta_a), np.cos(theta_a)], axis=1)
    return _pivot(case) + MM * case.mechanism.crank_length * arm


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
)
