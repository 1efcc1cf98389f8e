"""Losses of gears and worms that follow the tooth force."""

import math
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError

RATIO, LOAD = -0.25, 8.0


def wheels(drive: dict[str, Any], load: float, **gear: Any) -> td.Mechanism:
    """Return a pinion that turns a loaded wheel, or is turned by it."""
    drawn = td.Mechanism("Gears", run={"duration": "0.2 s"}, solver={"rtol": 1e-8})
    drawn.body("first", mass="1 kg", centre="0, 0, 0 mm", inertia="3e-4, 3e-4, 5e-4 kg m^2")
    drawn.body("second", mass="4 kg", centre="100, 0, 0 mm", inertia="5e-3, 5e-3, 9e-3 kg m^2")
    drawn.revolute("input", "ground", "first", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("output", "ground", "second", point="100, 0, 0 mm", axis=[0, 0, 1])
    drawn.gear("mesh", joints=["input", "output"], ratio=RATIO, slip_velocity="0.1 um/s", **gear)
    drawn.load("process", body="second", moment=f"{load} N m", direction=[0, 0, 1])
    return drawn.drive("motor", "input", **drive) if drive else drawn


WORM = {"friction_coefficient": 0.05, "lead_angle": "15 deg"}
SLOPE, RHO = math.tan(math.radians(15.0)), math.atan(0.05)
FORWARD = SLOPE / math.tan(math.radians(15.0) + RHO)
BACKWARD = math.tan(math.radians(15.0) - RHO) / SLOPE


@pytest.mark.parametrize(
    ("gear", "load", "efficiency"),
    [
        ({"efficiency": 0.72}, LOAD, 1.0 / 0.72),
        ({"efficiency": 0.72}, -LOAD, 2.0 - 1.0 / 0.72),
        ({"efficiency": 0.72, "backward_efficiency": 0.38}, -LOAD, 0.38),
        (WORM, LOAD, 1.0 / FORWARD),
        (WORM, -LOAD, BACKWARD),
        ({}, LOAD, 1.0),
    ],
)
def test_torque_of_the_motor(gear: dict[str, Any], load: float, efficiency: float) -> None:
    run = td.simulate(wheels({"speed": "100 rpm"}, load, **gear).case())
    np.testing.assert_allclose(run["drive_moment"].values[:, 0], -RATIO * load * efficiency, rtol=1e-6)
    assert run.attrs["energy_residual"] < 1e-6


def test_a_worm_that_locks_itself_holds() -> None:
    keys = {"friction_coefficient": 0.3, "lead_angle": "5 deg"}
    drawn = wheels({}, LOAD, **keys)
    run = td.simulate(drawn.case().replace({"friction.rest": "true", "run.duration": "1000 s"}))
    late = run["position"].values[run["time"].values > 5.0]
    turned = run["joint_angle"].values[run["time"].values > 5.0]
    assert np.ptp(late, axis=0).max() < 1e-10
    assert np.ptp(turned, axis=0).max() < 1e-9


@pytest.mark.parametrize(
    ("gear", "words"),
    [
        ({"friction_coefficient": 0.1}, "needs its lead angle"),
        (WORM | {"efficiency": 0.5}, "leave one of them out"),
        ({"backward_efficiency": 0.5}, "give both efficiencies"),
        ({"friction_coefficient": 1.5, "lead_angle": "60 deg"}, "exceed 90 deg"),
        ({"efficiency": 0.9, "backlash": "0.1 mm", "mesh_stiffness": "100 N/um"}, "are not computed"),
    ],
)
def test_wrong_losses_are_refused(gear: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        wheels({"speed": "100 rpm"}, LOAD, **gear).case()
