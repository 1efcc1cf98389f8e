"""The mechanism in space: where every body is at the frames."""

from typing import Final

import xarray as xr

from tribodyn.papers.cheng_2022.reduced.places import MM, case_of, crank_pivot, crank_tip
from tribodyn.views.encode import packed
from tribodyn.views.playback import at_frames, magnification, playback_times
from tribodyn.views.section import Payload, Section


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
