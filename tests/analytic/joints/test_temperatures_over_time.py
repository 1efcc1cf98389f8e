"""Temperatures over time and properties over the temperature in the joints of user-defined mechanisms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError

WARM = "joints.pivot.clearance.temperature."
EXPANSIONS = {
    "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
    "surfaces.bushing.thermal_expansion": "50e-6 1/K",
}
SIZES = {"radius": "6 mm", "radial": "20 um", "nodes_around": 24, "nodes_along": 8}
KINDS: dict[str, dict[str, Any]] = {
    "revolute": {"length": "12 mm", "axial": "50 um"},
    "cylindrical": {"length": "12 mm"},
    "spherical": {},
    "pin-slot": {"nodes_along": 32},
}


def over_time(part: str, times: str, values: str) -> dict[str, str]:
    return {f"{WARM}over_time.{part}.times": times, f"{WARM}over_time.{part}.values": values}


def hanging(kind: str, *, duration: str = "0.3 s", arm: float = 10.0, **clearance: Any) -> td.Case:
    """Return a block that hangs in one joint, its mass centre ``arm`` [mm] below it."""
    drawn = td.Mechanism("Block", gravity="0, -9.81, 0 m/s^2", run={"duration": duration})
    drawn.body("block", mass="2 kg", centre=f"0, {-arm}, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.joint("pivot", kind, "ground", "block", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.clearance("pivot", **{**SIZES, **KINDS[kind], **clearance})
    return drawn.case().replace(EXPANSIONS)


COOLING = over_time("bushing", "0, 0.2, 0.3 s", "60, 40, 40 degC")
COOLING |= {f"{WARM}over_time.bushing.interpolation": "linear"}
GAIN = 50e-6 * 6.02e-3  #: What the bore gains for each kelvin [m/K].


@pytest.mark.parametrize("kind", KINDS)
def test_a_block_sinks_as_its_bore_widens(kind: str) -> None:
    """At the end it hangs as in a joint that has the final temperature for good."""
    run = td.simulate(hanging(kind).replace(COOLING))
    clearance = run["radial_clearance"].sel(joint="pivot").values
    assert clearance[[0, -1]] == pytest.approx([20e-6 + 40.0 * GAIN, 20e-6 + 20.0 * GAIN], rel=1e-9)
    assert run["clearance"].values[0] == pytest.approx(clearance[0], rel=1e-12)
    still = td.simulate(hanging(kind, duration="5 ms").replace({f"{WARM}bushing": "40 degC"}))
    sunk, there = (found["displacement"].values[-1, 0, 1] for found in (run, still))
    start = run["displacement"].values[0, 0, 1]
    assert abs(sunk - start) > 4e-6
    assert sunk == pytest.approx(there, abs=0.02e-6)
    # The bore lifts its load: what it stores, and all that it does, is in the balance.
    assert run.attrs["energy_residual"] < 0.01
    lifted = 2.0 * 9.81 * (sunk - start)
    assert run["energy_expansion"].values[-1] == pytest.approx(lifted, rel=0.1)


def test_the_play_between_end_faces_follows_both_lengths() -> None:
    """A shaft that is pressed along its axis stays on a face whose gap is half the play."""
    pressed = {"gravity.z": "-50 m/s^2"}
    warm = over_time("trunnion", "0, 0.1, 0.3 s", "20, 60, 80 degC")
    run = td.simulate(hanging("revolute", arm=0.0).replace(pressed | warm))
    gained = (12e-3 + 100e-6) * 12e-6 * 60.0
    moved = run["displacement"].values[-1, 0, 2] - run["displacement"].values[0, 0, 2]
    assert moved == pytest.approx(-0.5 * gained, rel=0.01)


def test_properties_follow_the_temperature_of_the_bushing() -> None:
    tables = {
        f"{WARM}bushing": "110 degC",
        f"{WARM}properties.temperatures": "20, 200 degC",
        f"{WARM}properties.young_modulus": "7, 5 GPa",
        f"{WARM}properties.hardness": "490, 290 MPa",
        f"{WARM}properties.friction_coefficient": "[0.3, 0.1]",
        f"{WARM}properties.specific_wear_rate": "1e-15, 3e-15 m^2/N",
    }
    case = hanging("revolute", duration="5 ms").replace(tables)
    assert case.joints["pivot"].clearance.friction_coefficient == pytest.approx(0.2)
    hot = td.simulate(case)
    plain = {
        f"{WARM}bushing": "110 degC",
        "surfaces.bushing.young_modulus": "6 GPa",
        "surfaces.bushing.hardness": "390 MPa",
        "joints.pivot.clearance.friction_coefficient": 0.2,
        "wear.specific_wear_rate": "2e-15 m^2/N",
    }
    same = td.simulate(hanging("revolute", duration="5 ms").replace(plain))
    for name in ("displacement", "reaction_force", "hardness_share", "wear_depth"):
        np.testing.assert_allclose(hot[name], same[name], rtol=1e-9, atol=1e-15)
    assert "young_modulus by -14.3 %" in hot.attrs["notes"]
    given = case.replace({"joints.pivot.clearance.friction_coefficient": 0.25})
    assert given.joints["pivot"].clearance.friction_coefficient == 0.25
    with pytest.raises(InputError, match="the bushing has 493") as caught:
        td.simulate(case.replace({f"{WARM}bushing": "220 degC"}))
    assert caught.value.key.startswith(f"{WARM}properties.")


def test_a_user_defined_vane_follows_temperatures_as_the_reduced_one() -> None:
    times, values = "0, 1, 3 s", "60, 45, 40 degC"
    table = {"times": times, "values": values}
    keys = EXPANSIONS | {"run.duration": "1.5 s"}
    reduced = td.simulate(
        td.load_case("vsv").replace(
            keys | {f"temperature.over_time.bushing.{k}": v for k, v in table.items()}
        )
    )
    path = "joints.trunnion.clearance.temperature.over_time.bushing."
    drawn = td.simulate(td.load_case("vsv-free").replace(keys | {path + k: v for k, v in table.items()}))
    t = np.array([0.5, 1.0, 1.4])
    of_both = [run["radial_clearance"].interp(time=t) for run in (reduced, drawn.sel(joint="trunnion"))]
    np.testing.assert_allclose(of_both[1], of_both[0], rtol=1e-4)
    off = [_offset(run, t) for run in (reduced, drawn)]
    np.testing.assert_allclose(off[1], off[0], rtol=0.02)
    assert drawn.attrs["energy_residual"] < 0.01


def _offset(run: xr.Dataset, t: np.ndarray) -> np.ndarray:
    """Return how far the trunnion is off the axis of its bushing at times [m]."""
    if "e_x" in run:
        return np.hypot(run["e_x"].interp(time=t), run["e_y"].interp(time=t)).values
    d = run["displacement"].sel(joint="trunnion").interp(time=t).values
    return np.asarray(np.hypot(d[:, 0], d[:, 1]))


REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "seizes": (over_time("trunnion", "0, 0.1, 0.3 s", "20, 250, 350 degC"), "would seize", "over_time"),
    "casing": (over_time("casing", "0, 1 s", "20, 50 degC"), "follows no casing", "over_time.casing"),
    "late": (over_time("bushing", "0.1, 1 s", "20, 50 degC"), "a run at 0 s", "over_time.bushing"),
    "film": (COOLING | {"joints.pivot.film.viscosity": "0.01 Pa s"}, "constant temperatures", "over_time"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_is_refused(name: str) -> None:
    changes, words, key = REFUSED[name]
    case = hanging("revolute")
    if name == "film":
        drawn = td.Mechanism("Pin", run={"duration": "1 s"})
        drawn.body("pin", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
        drawn.revolute("pivot", "ground", "pin", point="0, 0, 0 mm", axis=[0, 0, 1])
        drawn.clearance("pivot", **SIZES, length="12 mm")
        case = drawn.film("pivot", viscosity="0.01 Pa s").case().replace(EXPANSIONS)
        changes = COOLING
    with pytest.raises(InputError, match=words) as caught:
        td.check(case.replace(changes))
    assert caught.value.key.startswith(f"{WARM}{key}")


def test_a_constant_table_is_the_constant_temperature() -> None:
    kept = hanging("revolute").replace({f"{WARM}trunnion": "100 degC", f"{WARM}bushing": "60 degC"})
    tables = over_time("trunnion", "0, 0.2, 0.7 s", "100, 100, 100 degC")
    tables |= over_time("bushing", "0, 5 s", "60, 60 degC")
    first, second = td.simulate(kept), td.simulate(hanging("revolute").replace(tables))
    assert set(second) - set(first) == {"radial_clearance", "energy_expansion"}
    for name in ("displacement", "reaction_force", "clearance", "pressure_peak"):
        np.testing.assert_allclose(second[name].values[-1], first[name].values[-1], rtol=1e-6)
