"""Outputs of a mechanism, and their error against the motion with ideal joints."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.core.errors import TribodynError
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column

CRANK, ROD = 0.05, 0.12
BAR = {"inertia": "1e-5, 2.5e-4, 2.5e-4 kg m^2"}


def linkage(inertia: str, **run: object) -> td.Mechanism:
    """Return a slider-crank at its dead centre, with the inertia of its crank."""
    return (
        td.Mechanism("Slider-crank", run={"step_rows": 0, **run})
        .body("crank", mass="0.3 kg", centre="0, 0, 0 mm", inertia=inertia)
        .body("rod", mass="0.2 kg", centre="110, 0, 0 mm", **BAR)
        .body("slider", mass="0.14 kg", centre="170, 0, 0 mm", **BAR)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("crankpin", "crank", "rod", point="50, 0, 0 mm", axis=[0, 0, 1])
        .revolute("wrist", "rod", "slider", point="170, 0, 0 mm", axis=[0, 0, 1])
        .prismatic("guide", "ground", "slider", point="170, 0, 0 mm", axis=[1, 0, 0])
    )


def press(**clearance: str) -> td.Mechanism:
    """Return a slider-crank at 60 rpm with outputs, its wrist ideal or with a clearance."""
    drawn = (
        linkage(**BAR, cycles=1, output_interval="5 ms")
        .drive("motor", "main", speed="60 rpm")
        .load("push", "slider", direction=[-1, 0, 0], force="200 N")
        .output("way", "slider", along=[1, 0, 0])
        .output("anywhere", "slider")
        .output("speed", "slider", quantity="velocity", along=[1, 0, 0])
        .output("lean", "rod", quantity="angle", along=[0, 0, 1])
        .output("turn", "crank", quantity="angle", along=[0, 0, 1])
        .output("stroke", "slider", quantity="distance", reference_point="0, 0, 0 mm", point="170, 0, 0 mm")
        .output("rate", "rod", quantity="angular_velocity", along=[0, 0, 1])
    )
    return drawn.clearance("wrist", **clearance) if clearance else drawn


def of(result: xr.Dataset, name: str, output: str) -> np.ndarray:
    return column(result, name)[:, result["output"].values.tolist().index(output)]


@pytest.fixture(scope="module")
def worn_press() -> xr.Dataset:
    return td.simulate(press(radius="9.5 mm", radial="20 um", length="20 mm", axial="50 um"))


def closed_form(result: xr.Dataset) -> tuple[np.ndarray, ...]:
    """Return place and speed of the slider and the angle of the rod, of the ideal slider-crank."""
    rate = 2.0 * np.pi
    angle = rate * column(result, "time")
    height = CRANK * np.sin(angle)
    place = CRANK * np.cos(angle) + np.sqrt(ROD**2 - height**2)
    lean = -np.arcsin(height / ROD)
    speed = -rate * CRANK * np.sin(angle) + rate * CRANK * np.cos(angle) * np.tan(lean)
    return place, speed, lean


def test_ideal_values_are_those_of_the_closed_form(worn_press: xr.Dataset) -> None:
    place, speed, lean = closed_form(worn_press)
    assert of(worn_press, "output_ideal", "way") == pytest.approx(place - 0.17, abs=1e-10)
    assert of(worn_press, "output_ideal", "stroke") == pytest.approx(place, abs=1e-10)
    assert of(worn_press, "output_ideal", "anywhere") == pytest.approx(0.17 - place, abs=1e-10)
    assert of(worn_press, "output_ideal", "speed") == pytest.approx(speed, abs=1e-8)
    assert of(worn_press, "output_ideal", "lean") == pytest.approx(lean, abs=1e-9)
    rate = -2.0 * np.pi * CRANK / ROD * np.cos(2.0 * np.pi * column(worn_press, "time")) / np.cos(lean)
    assert of(worn_press, "output_ideal", "rate") == pytest.approx(rate, abs=1e-8)
    # Whole turns are counted.
    assert of(worn_press, "output_ideal", "turn")[-1] == pytest.approx(2.0 * np.pi, abs=1e-9)


def test_the_error_is_what_the_pin_leaves_of_the_geometry(worn_press: xr.Dataset) -> None:
    # The offset e of the pin in the bore of the rod moves the slider by e·u / cos β, u along the rod.
    _, _, lean = closed_form(worn_press)
    turn = Rotation.from_quat(np.roll(column(worn_press, "orientation")[:, 1], -1, axis=1))
    bore = column(worn_press, "position")[:, 1] + turn.apply([0.06, 0.0, 0.0])
    offset = column(worn_press, "position")[:, 2] - bore
    rod = np.stack([np.cos(lean), np.sin(lean), 0.0 * lean], axis=1)
    expected = np.sum(offset * rod, axis=1) / np.cos(lean)
    error = of(worn_press, "output_error", "way")
    assert np.max(np.abs(error)) > 15e-6
    assert error == pytest.approx(expected, abs=2e-8)
    assert of(worn_press, "output_error", "anywhere") == pytest.approx(np.abs(error), abs=1e-8)


def test_a_sustained_load_leaves_the_clearance_as_error(worn_press: xr.Dataset) -> None:
    # The load presses the pin against one side; the error is the clearance less what roughness holds apart.
    numbers = summarise(worn_press)
    assert 15.0 < numbers["error_sustained_um_way"] < 21.0
    assert numbers["error_rms_um_way"] <= numbers["error_sustained_um_way"] <= numbers["error_max_um_way"]
    assert "error_sustained_deg_way" not in numbers


def test_an_output_that_drives_leave_free_has_no_ideal_value() -> None:
    pendulum = (
        td.Mechanism("Pendulum", gravity="0, -9.81, 0 m/s^2", run={"duration": "20 ms"})
        .body("arm", mass="1 kg", centre="100, 0, 0 mm", **BAR)
        .body("wheel", mass="1 kg", centre="0, 0, 50 mm", **BAR)
        .revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("shaft", "ground", "wheel", point="0, 0, 50 mm", axis=[0, 0, 1])
        .drive("motor", "shaft", speed="60 rpm")
        .output("tip", "arm", point="200, 0, 0 mm", along=[0, 1, 0])
        .output("wheel", "wheel", quantity="angle", along=[0, 0, 1])
    )
    result = td.simulate(pendulum)
    assert np.isnan(of(result, "output_error", "tip")).all()
    assert np.isfinite(of(result, "output_value", "tip")).all()
    assert np.max(np.abs(of(result, "output_error", "wheel"))) < 1e-9
    assert "output tip depends on a freedom" in result.attrs["notes"]
    assert "error_max_um_tip" not in summarise(result)


def pushed(push: str, **output: str) -> td.Mechanism:
    """Return a slider-crank at its dead centre with play in the wrist, set in motion as named."""
    drawn = (
        linkage("1e-3, 1e-3, 1e-3 kg m^2", duration="40 ms")
        .clearance("wrist", radial="20 um", radius="10 mm", length="20 mm")
        .output("way", "slider", along=[1, 0, 0], **output)
    )
    if push == "torque":
        return drawn.drive("push", "main", torque="2 N m")
    if push == "motor":
        return drawn.motor("push", joint="main", stall_torque="3 N m", no_load_speed="3000 rpm")
    return drawn.torsion_spring("push", joint="main", stiffness="0.5 N m/rad", preload="2 N m")


@pytest.mark.parametrize(
    ("push", "output"),
    [("torque", {}), ("motor", {}), ("spring", {"follows": "main"})],
    ids=lambda of: str(of),
)
def test_the_error_is_that_at_the_same_place_of_a_joint(push: str, output: dict[str, str]) -> None:
    run = td.simulate(pushed(push, **output))
    theta = column(run, "joint_angle")[:, 0]
    assert np.ptp(theta) > 0.5
    known = CRANK * np.cos(theta) + np.sqrt(ROD**2 - (CRANK * np.sin(theta)) ** 2) - (CRANK + ROD)
    np.testing.assert_allclose(column(run, "output_ideal")[:, 0], known, atol=1e-9)
    error = np.abs(column(run, "output_error")[:, 0]).max()
    assert 5e-6 < error < 25e-6  # the pin goes through its clearance of 20 um, and a little into the bore
    assert "the error of output way is that at the same place of main" in run.attrs["notes"]


def test_a_stiff_motor_gives_the_life_by_error_of_a_drive_at_its_speed(tmp_path: Path) -> None:
    def turning() -> td.Mechanism:
        return (
            linkage("1e-3, 1e-3, 1e-3 kg m^2", duration="100 ms")
            .clearance("wrist", radial="20 um", radius="10 mm", length="20 mm")
            .load("push", "slider", direction=[-1, 0, 0], force="200 N")
            .output("way", "slider", along=[1, 0, 0], error_limit="50 um")
        )

    driven = turning().drive("motor", "main", speed="600 rpm")
    moved = turning().motor("motor", joint="main", stall_torque="2000 N m", no_load_speed="600 rpm")
    started = moved.case().replace({"joints.main.start_speed": "600 rpm"})
    life, same = (summarise(td.simulate(drawn))["error_life_cycles_way"] for drawn in (driven, started))
    assert same == pytest.approx(life, rel=0.01)
    [shares] = td.studies.contributions(started, directory=tmp_path, workers=0)
    assert shares.shares == pytest.approx([1.0], abs=1e-9)


def test_an_output_at_a_dead_centre_depends_on_the_freedom_that_is_left() -> None:
    run = td.simulate(pushed("spring"))
    assert np.isnan(column(run, "output_error")).all()
    assert "output way depends on a freedom" in run.attrs["notes"]


def test_a_reference_that_moves_carries_its_directions() -> None:
    # In axes of the crank, the far end of the rod's pin moves on a circle about the crank pin.
    drawn = press().output("seen", "rod", point="170, 0, 0 mm", reference="crank", along=[1, 0, 0])
    result = td.simulate(drawn)
    _, _, lean = closed_form(result)
    angle = 2.0 * np.pi * column(result, "time")
    assert of(result, "output_ideal", "seen") == pytest.approx(ROD * np.cos(lean - angle) - ROD, abs=1e-9)


def test_errors_at_angles_of_the_crank_are_those_of_the_closed_form() -> None:
    # A motor of constant speed: an angle is a time. Positions and angles of another joint count, too.
    at = {"angles": ["90 deg", "180 deg"], "times": ["0.25 s"]}
    drawn = press(radius="9.5 mm", radial="20 um", length="20 mm", axial="50 um")
    drawn.output("read", "slider", along=[1, 0, 0], at=at)
    drawn.output("low", "slider", along=[1, 0, 0], at={"joint": "guide", "positions": ["-50 mm"]})
    result = td.simulate(drawn)
    numbers, time = summarise(result), column(result, "time")
    error = 1e6 * of(result, "output_error", "read")
    for angle in (90, 180):
        assert numbers[f"error_at_um_read_{angle}_deg"] == pytest.approx(
            np.interp(angle / 360.0, time, error)
        )
    assert numbers["error_at_um_read_90_deg"] == pytest.approx(numbers["error_at_um_read_0_25_s"])
    way = of(result, "output_value", "read")
    comes, goes = (np.flatnonzero(np.diff(np.sign(way + 0.05)) == 2.0 * sense)[0] for sense in (1.0, -1.0))
    for name, k in (("forward", comes), ("backward", goes)):
        order = k + np.argsort(way[k : k + 2])
        expected = np.interp(-0.05, way[order], error[order])
        assert numbers[f"error_at_{name}_um_low_minus_50_mm"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("at", "said"),
    [
        ({"joint": "gide", "positions": ["1 mm"]}, "guide"),
        ({"joint": "guide", "angles": ["1 deg"]}, "no angle"),
        ({"positions": ["1 mm"]}, "no position"),
    ],
)
def test_an_instant_that_no_joint_has_is_refused(at: dict[str, object], said: str) -> None:
    with pytest.raises(TribodynError, match=said):
        press().output("wrong", "slider", along=[1, 0, 0], at=at).case()


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"body": "ground"}, "ground never moves"),
        ({"body": "slidr"}, "slider"),
        ({"body": "slider", "reference": "slider"}, "does not move against itself"),
        ({"body": "slider", "quantity": "angle"}, "needs its axis"),
        ({"body": "slider", "quantity": "distance"}, "second point"),
        ({"body": "slider", "along": [0, 0, 0]}, "along"),
        ({"body": "rod", "quantity": "angle", "along": [0, 0, 1], "point": "1, 0, 0 mm"}, "needs no point"),
    ],
)
def test_a_misdescribed_output_is_refused(keys: dict[str, object], said: str) -> None:
    body = str(keys.pop("body"))
    with pytest.raises(TribodynError, match=said):
        press().output("wrong", body, **keys).case()


def test_ideal_joints_have_no_error() -> None:
    result = td.simulate(press())
    for output, most in (("way", 1e-7), ("lean", 1e-6), ("turn", 1e-12), ("stroke", 1e-7), ("speed", 1e-6)):
        assert np.max(np.abs(of(result, "output_error", output))) < most, output


def test_a_joint_that_is_not_there_cannot_be_followed() -> None:
    with pytest.raises(TribodynError, match=r"outputs.way.follows: .*mian.*main"):
        pushed("motor", follows="mian").case()
