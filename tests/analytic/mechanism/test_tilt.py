"""Joints whose axes are made off the drawing, against rotations of points by hand."""

from typing import Final

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case

LEVER: Final = np.array([24e-3, 43e-3, 10e-3])  #: From the trunnion to the pin [m].
TRUNNION: Final = np.array([0.0, 0.0, 390e-3])
TILT: Final = np.array([1e-3, -2e-3, 0.5e-3])  #: Of the trunnion [rad].
AS_DRAWN, WHOLE = Rotation.identity(), Rotation.from_rotvec([0.4, -0.8, 0.3])

VANE: Final = """
case = "mechanism"
[bodies.vane]
mass = "0.25 kg"
centre = "{centre} m"
inertia = "5e-4, 5e-4, 5e-4 kg m^2"
[joints.trunnion]
type = "revolute"
between = [{between}]
point = "{trunnion} m"
axis = [{axis}]
tilt = "{tilt} rad"
[run]
duration = "1 s"
output_interval = "0.1 s"
"""
DRIVEN: Final = """
[drives.motor]
joint = "trunnion"
angle = {{ value = "0 deg", swing = "{swing} deg", angular_frequency = "3 rad/s" }}
[outputs.pin]
quantity = "position"
body = "vane"
point = "{pin} m"
along = [{along}]
"""
RING: Final = """
[bodies.ring]
mass = "1 kg"
centre = "{ring} m"
inertia = "3e-2, 3e-2, 3e-2 kg m^2"
[joints.guide]
type = "cylindrical"
between = ["ground", "ring"]
point = "{ring} m"
axis = [{ring_axis}]
[joints.pin]
type = "pin-slot"
between = ["ring", "vane"]
point = "{pin} m"
axis = [{slot}]
[drives.actuator]
joint = "guide"
angle = {{ value = "0 deg", swing = "-6 deg", angular_frequency = "3 rad/s" }}
[outputs.vane]
quantity = "angle"
body = "vane"
along = [{axis}]
"""


def vane(text: str, *, tilt: FloatArray = TILT, whole: Rotation = AS_DRAWN, **changes: object) -> Case:
    """Return a vane on its trunnion, the whole of it turned in space."""
    places = {
        "centre": TRUNNION,
        "trunnion": TRUNNION,
        "axis": [0.0, 0.0, 1.0],
        "tilt": tilt,
        "pin": TRUNNION + LEVER,
        "ring": [0.0, LEVER[1], 0.0],
        "ring_axis": [0.0, 1.0, 0.0],
        "slot": (TRUNNION + LEVER) * [1.0, 0.0, 1.0],
        "along": [0.6, -0.48, 0.64],
    }
    given = {name: ", ".join(map(repr, whole.apply(place).tolist())) for name, place in places.items()}
    chosen = {"between": '"ground", "vane"', "swing": 20, **changes}
    return parse_case((VANE + text).format(**given, **chosen), "test")


def error(found: xr.Dataset) -> FloatArray:
    """Return the error of the only output over time [m or rad]."""
    assert found.attrs["failure"] == ""
    return np.asarray(found["output_error"].values[:, 0])


@pytest.mark.parametrize("first", ["ground", "vane"])
def test_a_point_turns_about_the_axis_as_made(first: str) -> None:
    """Off in the ground, the axis makes R(tilt) R(θ) r of a point r; off in the vane, R(θ) R(−tilt) r."""
    names = ("ground", "vane") if first == "ground" else ("vane", "ground")
    found = td.simulate(vane(DRIVEN, between=", ".join(f'"{name}"' for name in names)))
    angle = found["joint_angle"].sel(joint="trunnion").values * (1.0 if first == "ground" else -1.0)
    tilt, turn = Rotation.from_rotvec(TILT), Rotation.from_rotvec(angle[:, None] * [0.0, 0.0, 1.0])
    made = tilt * turn if first == "ground" else turn * tilt.inv()
    expected = (made.apply(LEVER) - turn.apply(LEVER)) @ [0.6, -0.48, 0.64]
    # Constraints are kept to 1e-9 of the size.
    np.testing.assert_allclose(error(found), expected, atol=1e-10)
    assert np.ptp(expected) > 4e-6


def test_a_trunnion_tilted_about_its_lever_turns_the_vane_by_the_height_of_the_pin() -> None:
    """The pin, at h above the trunnion, goes d h across the lever L, which the vane turns back: d h/L.

    Over the stroke the pin stays in the plane through the axis of the ring and the slot, which turns with it.
    """
    along = np.array([*LEVER[:2], 0.0]) / np.linalg.norm(LEVER[:2])
    found = td.simulate(vane(RING, tilt=1e-3 * along))
    first = 1e-3 * LEVER[2] / np.linalg.norm(LEVER[:2])
    assert error(found)[0] == pytest.approx(first, rel=2e-3)
    ring = found["joint_angle"].sel(joint="guide").values

    def angle(turn: float, tilt: Rotation) -> float:
        def off(angle: float) -> float:
            x, _, z = TRUNNION + (tilt * Rotation.from_rotvec([0.0, 0.0, angle])).apply(LEVER)
            return float(np.arctan2(x, z) - np.arctan2(LEVER[0], TRUNNION[2] + LEVER[2]) - turn)

        return float(brentq(off, -0.5, 0.9, xtol=1e-15))

    tilt = Rotation.from_rotvec(1e-3 * along)
    expected = [angle(turn, tilt) - angle(turn, Rotation.identity()) for turn in ring]
    # Angles about an axis and about one that is off by d differ by d²/4 at most.
    np.testing.assert_allclose(error(found), expected, atol=3e-7)
    assert np.ptp(expected) > 1e-5


def test_the_whole_turned_in_space_has_the_same_errors() -> None:
    drawn, turned = (error(td.simulate(vane(RING, whole=whole))) for whole in (AS_DRAWN, WHOLE))
    np.testing.assert_allclose(turned, drawn, atol=1e-9)


def test_a_torque_acts_about_the_axis_as_made() -> None:
    """A rotor of equal inertia in all directions follows J α = T, and its bearing takes no moment."""
    torque = '[motors.motor]\njoint = "trunnion"\nstall_torque = "1e-4 N m"\nno_load_speed = "1e9 rpm"\n'
    found = td.simulate(vane(torque, tilt=50.0 * TILT))
    turned = found["joint_angle"].sel(joint="trunnion").values
    # The tilt about the axis turns the angle of zero.
    assert turned[0] == pytest.approx(-50.0 * TILT[2], rel=2e-3)
    expected = 0.5 * 1e-4 / 5e-4 * found["time"].values ** 2
    # The relative tolerance of the integration is 1e-5.
    np.testing.assert_allclose(turned - turned[0], expected, rtol=1e-5, atol=1e-9)
    # The reaction follows from the equations of motion to rounding; of a torque about z it would be a tenth.
    assert np.abs(found["reaction_moment"].sel(joint="trunnion").values).max() < 1e-9 * 1e-4


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"joints.trunnion.tilt": "11, 0, 0 deg"}, "a tilt is of tolerances, at most 10 deg"),
        ({"joints.trunnion.tilt": "1, 0, 0 mm"}, "three numbers with units of angle"),
        ({"run.analysis": "kinematic"}, "a kinematic analysis has ideal joints in their places"),
    ],
)
def test_a_tilt_that_cannot_be_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        vane(DRIVEN).replace(changes)
    assert "joints.trunnion.tilt" in str(caught.value)


def test_a_ball_has_no_axis_to_tilt() -> None:
    with pytest.raises(InputError, match="holds no direction that could be off") as caught:
        parse_case((VANE).replace("revolute", "spherical").format(**_drawn()), "test")
    assert "joints.trunnion.tilt" in str(caught.value)


def _drawn() -> dict[str, str]:
    return {
        "centre": "0, 0, 0",
        "between": '"ground", "vane"',
        "trunnion": "0, 0, 0",
        "axis": "0, 0, 1",
        "tilt": "0.001, 0, 0",
    }
