"""Running-in, wear of both partners and sliding speeds in the joints of user-defined mechanisms."""

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints.shapes import Ball, Cylinder, Sphere
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.results.temperature_effects import _sliding
from tribodyn.mechanism.system import MechanismSystem
from tribodyn.wear import worn_roughness

TRUNNION, BUSHING = 0.392e-6, 1.586e-6
SIZES = {"radius": "6 mm", "radial": "20 um", "nodes_around": 24, "nodes_along": 4}
KINDS: dict[str, dict[str, Any]] = {
    "revolute": {"length": "12 mm", "axial": "50 um"},
    "spherical": {},
    "pin-slot": {},
}


def case(kind: str, pair: dict[str, Any] | None = None, **more: Any) -> MechanismCase:
    """Return an arm that is shaken in one joint with clearance, for a campaign of a few cycles."""
    drawn = Mechanism(
        "Arm",
        gravity="0, -9.81, 0 m/s^2",
        run={"cycles": 1, "period": "10 ms", "step_rows": 0},
        solver={"rtol": 1e-4},
        wear={
            "cycles": 4,
            "specific_wear_rate": "4e-10 m^2/N",
            "running_in": True,
            "jump_depth": 1.0,
            **more,
        },
    )
    drawn.body("arm", mass="2 kg", centre="0, -10, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.joint("pivot", kind, "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.clearance("pivot", **SIZES, **KINDS[kind], **({} if pair is None else {"pair": "hard"}))
    if pair is not None:
        drawn.pair("hard", **pair)
    wave = {"amplitude": "1 N m", "angular_frequency": "628.3185307 rad/s"}
    drawn.load("shaker", "arm", direction=[0, 0, 1], moment=wave)
    found = drawn.case()
    assert isinstance(found, MechanismCase)
    return found


def loaded_depth(arm: MechanismCase, run: xr.Dataset) -> float:
    """Return ΣA d²/ΣA d over the nodes of all surfaces."""
    first = second = 0.0
    for place, depth in zip(MechanismSystem(arm).maps.places, run["wear_depth"].values, strict=True):
        rows, columns = (1, *place.surface.field_shape)[-2:]
        d = depth[:rows, :columns].ravel()
        first, second = first + place.surface.area @ d, second + place.surface.area @ d**2
    return float(second / first)


@pytest.mark.parametrize("kind", KINDS)
def test_a_joint_runs_in_by_its_mean_depth(kind: str) -> None:
    arm = case(kind, partner_wear_rate="1e-10 m^2/N")
    run = td.simulate(arm)
    assert not run.attrs["failure"]
    bushing = worn_roughness(BUSHING, loaded_depth(arm, run), TRUNNION)
    assert bushing < 0.99 * BUSHING
    np.testing.assert_allclose(run["roughness"], math.hypot(bushing, TRUNNION), rtol=1e-9)
    history = run["wear_roughness"].values
    assert history[0] == pytest.approx(math.hypot(BUSHING, TRUNNION), rel=1e-12)
    assert np.all(np.diff(history) < 0.0)
    np.testing.assert_allclose(run["partner_wear_depth"], 0.2 * run["wear_depth"], rtol=1e-12)
    summary = run.tribodyn.summary
    assert summary["partner_wear_depth_nm_pivot"] == pytest.approx(0.2 * summary["wear_depth_nm_pivot"])
    assert summary["wear_cycles"] == 4


def test_surfaces_of_a_pair_run_in_to_its_roughness() -> None:
    pair = {"wear": {"final_roughness": "1.55 um"}}
    run = td.simulate(case("revolute", pair=pair))
    np.testing.assert_allclose(run["roughness"], math.hypot(1.55e-6, TRUNNION), rtol=1e-12)


def test_a_smooth_trunnion_of_a_pair_leaves_nothing_to_run_in_to() -> None:
    with pytest.raises(InputError, match="say what the bushing runs in to") as caught:
        case("revolute", pair={"surfaces": {"trunnion": {"roughness": "0 um"}}})
    assert caught.value.key == "pairs.hard.wear.final_roughness"


def row(**moved: tuple[float, float, float]) -> dict[str, Any]:
    """Return one row of a joint at rest but for what is given."""
    still = dict.fromkeys(("displacement", "relative_velocity", "relative_rate"), (0.0, 0.0, 0.0))
    found = {name: np.array(values) for name, values in (still | moved).items()}
    return {**found, "tilt_x": 0.0, "tilt_y": 0.0}


def test_speeds_of_sliding() -> None:
    grid, radius = (96, 16), 6e-3
    pin = Cylinder(radius, 20e-6, 20e-3, axial=50e-6, flange=12e-3).surfaces(grid)
    turning = row(displacement=(10e-6, 0.0, 0.0), relative_rate=(0.0, 0.0, 5.0))
    assert _sliding(pin, turning) == pytest.approx(5.0 * radius, rel=1e-12)
    along = row(displacement=(10e-6, 0.0, 0.0), relative_velocity=(0.3, 0.0, 0.4))
    assert _sliding(pin, along) == pytest.approx(0.4, rel=1e-12)
    # On an end face every node has the least gap; the first of them is the innermost ring.
    pressed = row(displacement=(0.0, 0.0, 45e-6), relative_rate=(0.0, 0.0, 5.0))
    assert 5.0 * radius < _sliding(pin, pressed) < 5.0 * 12e-3
    for ball in (Sphere(radius, 20e-6, math.radians(40.0)), Ball(radius, 20e-6)):
        rolled = row(displacement=(0.0, 10e-6, 0.0), relative_rate=(3.0, 0.0, 4.0))
        assert _sliding(ball.surfaces(grid), rolled) == pytest.approx(5.0 * radius, rel=2e-3)
