"""Reactions of joints without the forces of their drives, forces of springs, races of balls."""

import math

import numpy as np
import pytest
import xarray as xr
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.mechanism.assembly.clearance_surfaces import axes_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanisms import results
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column

WEIGHT = 9.81
RUN = {"duration": "2 ms", "output_interval": "1 ms"}
ACROSS = WEIGHT * math.sqrt(0.5)  #: Part of the weight of 1 kg across a slope of 45°, and along it [N].


def slope(kind: str, *, real: bool = False, **drive: object) -> Mechanism:
    """Return a body of 1 kg on a slope of 45° with a drive along it."""
    drawn = Mechanism("Slope", gravity="0, 0, -9.81 m/s^2", run=RUN)
    drawn.body("block", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.joint("guide", kind, "ground", "block", point="0, 0, 0 mm", axis=[1, 0, 1])
    if real:
        drawn.clearance("guide", radius="6 mm", radial="20 um", length="40 mm", friction_coefficient=0.0)
    return drawn.drive("pull", "guide", **drive)


def first(result: xr.Dataset, name: str) -> xr.DataArray:
    return result[name].isel(time=0, joint=0)


@pytest.mark.parametrize(
    ("kind", "real", "drive"),
    [
        ("prismatic", False, {"position": "0 mm"}),
        ("prismatic", False, {"force": f"{ACROSS} N"}),
        ("cylindrical", False, {"velocity": "0 m/s"}),
        ("cylindrical", True, {"position": "0 mm"}),
        ("cylindrical", True, {"force": f"{ACROSS} N"}),
    ],
)
def test_a_guide_carries_what_is_across_it_and_the_drive_what_is_along(kind, real, drive):
    result = td.simulate(slope(kind, real=real, **drive).case())
    # A tilt by the clearance over the length turns the reaction by 1e-3 at most.
    close = 1e-3 if real else 1e-9
    across = first(result, "reaction_force")
    assert math.hypot(*across.values[:2]) == pytest.approx(ACROSS, rel=close)
    assert float(across.sel(axis="z")) == pytest.approx(0.0, abs=1e-3 * ACROSS)
    assert float(first(result, "drive_force")) == pytest.approx(ACROSS, rel=close)
    told = results.summarise(result)
    assert told["joint_force_max_N"] == pytest.approx(ACROSS, rel=1e-2)
    assert told["drive_force_max_N"] == pytest.approx(ACROSS, rel=1e-2)


def test_a_drive_that_pulls_across_gravity_leaves_the_weight_to_the_guide() -> None:
    # Before, the force of the drive and the reaction to it were added up.
    drawn = Mechanism("Lift", gravity="0, 0, -9.81 m/s^2", run=RUN)
    drawn.body("load", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("guide", "ground", "load", point="0, 0, 0 mm", axis=[0, 0, 1])
    result = td.simulate(drawn.drive("lift", "guide", position="0 mm").case())
    assert abs(first(result, "reaction_force")).max() < 1e-9
    assert float(first(result, "drive_force")) == pytest.approx(WEIGHT, rel=1e-9)


@pytest.mark.parametrize("drive", [{"angle": "0 deg"}, {"torque": "0.981 N m"}])
def test_a_pivot_carries_the_weight_and_the_motor_the_moment(drive: dict[str, str]) -> None:
    # 1 kg on an arm of 100 mm; a motor that gives a torque was not mentioned among the drive moments.
    drawn = Mechanism("Arm", gravity="0, 0, -9.81 m/s^2", run=RUN)
    drawn.body("arm", mass="1 kg", centre="100, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("pivot", "ground", "arm", point="0, 0, 0 mm", axis=[0, -1, 0])
    result = td.simulate(drawn.drive("motor", "pivot", **drive).case())
    force = first(result, "reaction_force_global")
    assert force.values == pytest.approx([0.0, 0.0, WEIGHT], abs=1e-9)
    assert float(first(result, "reaction_moment").sel(axis="z")) == pytest.approx(0.0, abs=1e-9)
    assert float(first(result, "drive_moment")) == pytest.approx(0.981, rel=1e-9)


@pytest.mark.parametrize("ends", [("ground", "mass"), ("mass", "ground")])
def test_a_spring_reports_force_length_and_energy(ends: tuple[str, str]) -> None:
    # A mass of 2 kg, 10 mm off its rest, on 200 N/m in a guide: a swing of 10 rad/s with 1 N s/m of damping.
    points = {"ground": "0, 0, 0 mm", "mass": "110, 0, 0 mm"}
    drawn = td.Mechanism("Swing", run={"duration": "0.3 s"})
    drawn.body("mass", mass="2 kg", centre="110, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("guide", "ground", "mass", point="110, 0, 0 mm", axis=[1, 0, 0])
    keys = {"stiffness": "200 N/m", "damping": "1 N s/m", "length": "100 mm"}
    drawn.spring("coil", *ends, first_point=points[ends[0]], second_point=points[ends[1]], **keys)
    result = td.simulate(drawn)
    length, speed = 0.11 + column(result, "position")[:, 0, 0] - 0.11, column(result, "velocity")[:, 0, 0]
    np.testing.assert_allclose(column(result, "spring_length")[:, 0], length, atol=1e-12)
    force = -200.0 * (length - 0.1) - speed
    np.testing.assert_allclose(column(result, "spring_force")[:, 0], force, atol=1e-9)
    np.testing.assert_allclose(
        column(result, "spring_energy")[:, 0], column(result, "energy_stored"), atol=1e-6
    )
    numbers = summarise(result)
    assert numbers["spring_pull_max_N_coil"] == pytest.approx(2.0, rel=1e-3)
    assert numbers["spring_length_max_mm_coil"] == pytest.approx(110.0)
    assert numbers["spring_energy_max_J_coil"] == pytest.approx(0.01)
    assert numbers["spring_push_max_N_coil"] == pytest.approx(force.max())


TURN = Rotation.from_rotvec([0.4, -0.7, 1.1]).as_matrix()
RACE = {"radius": "6 mm", "radial": "20 um", "nodes_around": 36, "nodes_along": 6}


def hanging(turn: np.ndarray) -> Mechanism:
    """Return a body on two ball joints, off the line between them, turned as a whole with gravity."""

    def at(*place: float) -> str:
        return ", ".join(f"{value:.15g}" for value in turn @ np.array(place)) + " mm"

    gravity = ", ".join(f"{value:.15g}" for value in turn @ np.array([1.0, 2.0, -9.0])) + " m/s^2"
    drawn = Mechanism("Hanging", gravity=gravity, run={"duration": "1 us"})
    inertia = "1e-3, 1e-3, 1e-3 kg m^2"  # the same about any axis
    drawn.body("plate", mass="1 kg", centre=at(40, 30, -50), inertia=inertia)
    for name, place in (("left", (0, 0, 0)), ("right", (80, 10, 0))):
        drawn.spherical(name, "ground", "plate", point=at(*place)).clearance(name, **RACE)
    return drawn


def test_the_race_is_normal_to_the_plane_of_joint_and_mass_centres() -> None:
    plain, turned = (hanging(turn).case() for turn in (np.eye(3), TURN))
    for before, after in zip(plain.joints.values(), turned.joints.values(), strict=True):
        np.testing.assert_allclose(axes_of(turned, after), axes_of(plain, before) @ TURN.T, atol=1e-12)
    left = plain.joints["left"]
    way = np.array(plain.bodies["plate"].centre) - left.point
    assert axes_of(plain, left)[0] @ way == pytest.approx(0.0, abs=1e-15)


def test_rotating_the_model_changes_no_force() -> None:
    before, after = (
        td.simulate(hanging(turn).case())["reaction_force_global"].isel(time=0).values
        for turn in (np.eye(3), TURN)
    )
    # The start is found to 1e-6 of the largest load; about Z as before forces differed by some per cent.
    np.testing.assert_allclose(after, before @ TURN.T, atol=1e-5 * np.abs(before).max())


@pytest.mark.parametrize("centre", ["0, 0, 0 mm", "0, 0, 70 mm"])
def test_a_mechanism_on_a_line_has_an_axis_across_it(centre: str) -> None:
    drawn = Mechanism("Bob", run={"duration": "1 us"})
    drawn.body("bob", mass="1 kg", centre=centre, inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.spherical("pivot", "ground", "bob", point="0, 0, 0 mm").clearance("pivot", **RACE)
    case = drawn.case()
    axis, second = axes_of(case, case.joints["pivot"])
    assert axis @ second == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.norm(axis) == pytest.approx(1.0)
