"""Reactions of joints without the forces of their drives."""

import math

import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanisms import results

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
def test_a_guide_carries_what_is_across_it_and_the_drive_what_is_along(
    kind: str, real: bool, drive: dict[str, str]
) -> None:
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
