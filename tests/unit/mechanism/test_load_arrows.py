"""Arrows of loads: where loads act in a result, and how large they are, against closed forms."""

import numpy as np
import pytest
from tests.unit.mechanism.made_up import result

from tribodyn.cases.case import with_entries
from tribodyn.mechanism.assembly.skeleton import case_of, skeleton
from tribodyn.mechanism.sections.mechanism import at_frames, data
from tribodyn.mechanism.sections.scene import LoadArrows, load_arrows
from tribodyn.views.playback import playback_times

TURN = 0.012  #: Time of one turn of the crank [s].


def arrows(**keys: object) -> tuple[LoadArrows, np.ndarray]:
    """Return the arrows of a load with these keys, and the angles of the crank at the frames."""
    given = result()
    case = with_entries(case_of(given), {f"loads.work.{key}": value for key, value in keys.items()}, "test")
    with_load = given.assign_attrs(case=case.to_toml())
    motion = at_frames(with_load)
    assert motion is not None
    found = load_arrows(with_load, case, skeleton(case), *motion)["work"]
    return found, 2.0 * np.pi * playback_times(with_load) / TURN


def along(*components: np.ndarray | float) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*components), axis=-1)


def test_a_load_fixed_in_space_acts_at_its_point_of_the_moving_body() -> None:
    found, turn = arrows(body="crank", point="50, 0, 0 mm", direction=[0, 1, 0], force="7 N")
    # Rows are straight lines apart: an arc of six degrees is flattened by a thousandth.
    np.testing.assert_allclose(found.point, along(50.0 * np.cos(turn), 50.0 * np.sin(turn), 0.0), atol=0.1)
    np.testing.assert_allclose(found.force, along(0.0 * turn, 7.0, 0.0), atol=1e-12)
    assert not found.moment.any()


def test_a_follower_turns_with_its_body() -> None:
    found, turn = arrows(body="crank", frame="body", direction=[1, 0, 0], force="7 N", moment="2 N m")
    turned = along(np.cos(turn), np.sin(turn), 0.0)
    np.testing.assert_allclose(found.force, 7.0 * turned, atol=1e-2)
    np.testing.assert_allclose(found.moment, 2.0 * turned, atol=3e-3)


def test_a_sinusoid_over_time_and_a_table_over_the_angle_of_a_joint_are_followed() -> None:
    wave = {"value": "0 N", "amplitude": "5 N", "angular_frequency": f"{2.0 * np.pi / TURN} rad/s"}
    sine = {f"force.{key}": value for key, value in wave.items()}
    found, turn = arrows(body="slider", direction=[1, 0, 0], **sine)
    np.testing.assert_allclose(found.force[:, 0], 5.0 * np.sin(turn), atol=1e-9)
    table = {"angles": "0, 90, 180, 270, 360 deg", "values": "0, 9, 18, 27, 36 N"}
    line = {f"force.{key}": value for key, value in table.items()}
    found, turn = arrows(body="slider", direction=[1, 0, 0], along="main", **line)
    inside = turn < 2.0 * np.pi - 1e-9
    np.testing.assert_allclose(found.force[inside, 0], 18.0 / np.pi * turn[inside], rtol=1e-9, atol=1e-9)


def test_a_load_against_the_motion_opposes_the_velocity_of_its_point() -> None:
    found, turn = arrows(body="slider", frame="motion", force="40 N")
    speed = -np.sin(turn) - 0.25 * np.sin(2.0 * turn)  # sign of that of the slider
    sure = np.abs(speed) > 0.1
    np.testing.assert_allclose(found.force[sure], along(-40.0 * np.sign(speed[sure]), 0.0, 0.0), atol=1e-9)


def test_the_scene_has_an_arrow_of_every_load_that_is_not_zero() -> None:
    given = result()
    entries = {"body": "slider", "direction": [1, 0, 0], "force": "7 N"}
    case = with_entries(case_of(given), {f"loads.work.{k}": v for k, v in entries.items()}, "test")
    payload = data(given.assign_attrs(case=case.to_toml()))
    assert payload is not None
    loads = payload["forces"]["load_force"]
    assert loads["label"] == "Load forces"
    size, unit = loads["words"].split()
    assert (float(size), unit) == (pytest.approx(loads["scale"], rel=0.05), "N")
    forces, points = (loads[key]["work"].array.reshape(-1, 3) for key in ("at", "points"))
    np.testing.assert_allclose(forces, along(7.0 + 0.0 * points[:, 0], 0.0, 0.0))
    # The slider moves by twice the crank.
    assert np.ptp(points[:, 0]) == pytest.approx(100.0, rel=1e-2)
    assert "load_moment" not in payload["forces"]
