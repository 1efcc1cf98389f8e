"""Power of drives, and two short cylinders as one long one."""

import math

import numpy as np
import pytest
from tests.analytic.mechanism.test_drives import INERTIA, slide, wheel

import tribodyn as td
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanisms.results import summarise


def braked(drawn: td.Mechanism, moment: float) -> td.Mechanism:
    """Return a wheel with a load that turns it back."""
    return drawn.load("brake", body="wheel", direction=[0, 0, 1], moment=f"{-moment} N m")


@pytest.mark.parametrize("analysis", ["dynamic", "kinematic", "static"])
@pytest.mark.parametrize("between", [("ground", "wheel"), ("wheel", "ground")])
def test_a_drive_gives_what_a_brake_takes(analysis: str, between: tuple[str, str]) -> None:
    drawn = td.Mechanism("Disc", run={"duration": "0.1 s", "analysis": analysis})
    drawn.body("wheel", mass="1 kg", centre="0, 0, 0 m", inertia="5e-3, 5e-3, 1e-2 kg m^2")
    drawn.revolute("axle", *between, point="0, 0, 0 m", axis=[0, 0, 1])
    speed = 100.0 if between[1] == "wheel" else -100.0
    told = summarise(td.simulate(braked(drawn.drive("motor", joint="axle", speed=f"{speed} rad/s"), 5.0)))
    of_drives = {f"drive_power_{kind}_W" for kind in ("mean", "rms", "max", "sustained")}
    assert {name: told[name] for name in of_drives} == pytest.approx(dict.fromkeys(of_drives, 500.0))
    assert told["load_power_mean_W"] == pytest.approx(-500.0)
    assert told["drive_moment_rms_Nm"] == pytest.approx(5.0)
    assert told["drive_speed_at_peak_rad_per_s"] == pytest.approx(100.0)
    assert "power_mean_W" not in told


def test_a_motor_has_moment_and_power_like_a_drive() -> None:
    # It runs up by J ω̇ = M₀ (1 − ω/ω₀) − M.
    drawn = wheel("0.5 s").motor("wiper", joint="axle", stall_torque="2 N m", no_load_speed="100 rad/s")
    result = td.simulate(braked(drawn, 1.0))
    speed = -50.0 * np.expm1(-result["time"].values * 2.0 / (INERTIA * 100.0))
    torque = 2.0 * (1.0 - speed / 100.0)
    assert result["drive_moment"].values[:, 0] == pytest.approx(torque, abs=1e-6)
    assert result["drive_power"].values[:, 0] == pytest.approx(torque * speed, abs=1e-4)
    assert result["energy_loads"].values[-1] == pytest.approx(-np.trapezoid(speed, result["time"]), rel=1e-4)
    told = summarise(result)
    given = np.trapezoid(torque * speed, result["time"]) / 0.5
    assert told["drive_power_mean_W"] == pytest.approx(given, rel=1e-4)
    assert told["drive_moment_max_Nm"] == pytest.approx(2.0)
    assert told["drive_speed_at_peak_rad_per_s"] == pytest.approx(0.0, abs=1e-9)
    assert told["drive_power_max_W"] == pytest.approx(np.max(torque * speed), rel=1e-4)


def test_several_drives_are_told_apart() -> None:
    drawn = slide("0.1 s", gravity=10.0)
    drawn.body("arm", mass="1 kg", centre="0, 0, 0 m", inertia="5e-3, 5e-3, 1e-2 kg m^2")
    drawn.revolute("hinge", "mass", "arm", point="0, 0, 0 m", axis=[1, 0, 0])
    drawn.drive("lift", joint="guide", velocity="0.5 m/s").drive("turn", joint="hinge", torque="0.1 N m")
    told = summarise(td.simulate(drawn))
    turned = 0.1 * 0.1 / 5e-3
    assert told["drive_force_rms_N"] == told["drive_force_rms_N_guide"] == pytest.approx(30.0)
    assert told["drive_velocity_at_peak_m_per_s"] == pytest.approx(0.5)
    assert told["drive_power_max_W_guide"] == pytest.approx(15.0)
    assert told["drive_power_max_W_hinge"] == pytest.approx(0.1 * turned, rel=1e-6)
    assert told["drive_moment_max_Nm_hinge"] == pytest.approx(0.1)
    assert told["drive_power_max_W"] == pytest.approx(15.0 + 0.1 * turned, rel=1e-6)
    assert "drive_moment_max_Nm_guide" not in told


def test_power_is_the_rate_of_the_work_where_joints_have_clearance() -> None:
    case = td.load_case("slider-crank").replace({"run.cycles": 0.2})
    result = td.simulate(case)
    power, time = result["drive_power"].values.sum(axis=1), result["time"].values
    assert math.isclose(np.trapezoid(power, time), float(result["energy_in"][-1]), rel_tol=1e-3)


WEIGHT = 9.81 * 2.0  #: Of the shaft [N].
#: What a start may leave: loads are balanced to a millionth of the largest one met on the way to the wall.
SETTLED = 1e-4
PIN = {"radius": "6 mm", "radial": "20 um", "friction_coefficient": 0.0, "nodes_around": 96}


def shaft(bearings: dict[str, tuple[float, float]]) -> Mechanism:
    """Return a shaft along y in bearings, each with its place along the shaft and its length [mm]."""
    drawn = Mechanism("Shaft", gravity="0, 0, -9.81 m/s^2", run={"duration": "10 us"})
    drawn.body("shaft", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    for name, (place, length) in bearings.items():
        drawn.cylindrical(name, "ground", "shaft", point=f"0, {place}, 0 mm", axis=[0, 1, 0])
        drawn.clearance(name, length=f"{length} mm", **PIN)
    return drawn


def test_two_short_cylinders_share_what_one_long_one_carries() -> None:
    one, two = (
        td.simulate(shaft(bearings).case()).isel(time=0)
        for bearings in ({"middle": (0.0, 20.0)}, {"left": (-5.0, 10.0), "right": (5.0, 10.0)})
    )
    forces = np.linalg.norm(two["reaction_force"], axis=-1)
    assert forces == pytest.approx([WEIGHT / 2.0, WEIGHT / 2.0], rel=SETTLED)
    assert float(np.linalg.norm(one["reaction_force"])) == pytest.approx(WEIGHT, rel=SETTLED)
    # A shaft that does not tilt has the same gap all along, so the same pressure.
    pressure = float(one["pressure_max"].max())
    assert pressure > 0.0
    assert two["pressure_max"].values == pytest.approx([pressure, pressure], rel=SETTLED)
    down = np.linalg.norm(one["displacement"], axis=-1)
    assert np.linalg.norm(two["displacement"], axis=-1) == pytest.approx([*down, *down], rel=SETTLED)
