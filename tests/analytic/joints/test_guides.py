"""Guides with play and pins in slots: tilt, contacts over a cycle, wear, and what must not matter."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.spatial.transform import Rotation

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.mechanism.results.guides import SITUATIONS
from tribodyn.mechanism.sections.charts import guides
from tribodyn.mechanism.sections.joints import orbits
from tribodyn.mechanisms.results import summarise

#: Lengths of the slider-crank, way from its wrist to the middle of its block, length and play of that [m].
CRANK, ROD, WRIST, LENGTH, PLAY = 0.05, 0.12, 0.02, 0.06, 100e-6
SMALL = "1e-5, 1e-4, 1e-4 kg m^2"
BLOCK = {"width": "30 mm", "height": "20 mm", "length": "60 mm", "radial": "100 um"}
SLIPPERY = {"friction_coefficient": 0.0}
SMOOTH = {"surfaces": {part: {"roughness": "0.1 um"} for part in ("trunnion", "bushing")}}
UPRIGHT = np.eye(3)
TURNED = Rotation.from_rotvec([0.4, -0.7, 1.1]).as_matrix()
FREE, CORNER, FACE, TILTED = range(4)


def slider_crank(
    axes: FloatArray = UPRIGHT, clearance: dict[str, Any] = BLOCK, *, speed: float = 6.0, **more: Any
) -> td.Mechanism:
    """Return a press whose wrist is beside the middle of its block and whose load is beside its axis.

    Hinges hold all in the plane of the first two of the ``axes``; the width of the block lies in it.
    """

    def place(x: float, y: float = 0.0) -> str:
        return ", ".join(f"{1e3 * value!r}" for value in (axes @ [x, y, 0.0]).tolist()) + " mm"

    def way(*values: float) -> list[float]:
        return (axes @ values).tolist()

    run = {"cycles": 1, "output_interval": "2.5 ms", **more.pop("run", {})}
    drawn = td.Mechanism(
        "Press", gravity=f"{', '.join(map(repr, way(0.0, -9.81, 0.0)))} m/s^2", run=run, **more
    )
    middle = CRANK + ROD + WRIST
    for name, mass, at in (("crank", 0.3, 0.0), ("rod", 0.2, 0.11), ("block", 0.5, middle)):
        turned = {"first_axis": way(1.0, 0.0, 0.0), "second_axis": way(0.0, 1.0, 0.0)}
        drawn.body(name, mass=f"{mass} kg", centre=place(at), inertia=SMALL, **turned)
    hinge = {"axis": way(0.0, 0.0, 1.0)}
    drawn.revolute("main", "ground", "crank", point=place(0.0), **hinge)
    drawn.revolute("crankpin", "crank", "rod", point=place(CRANK), **hinge)
    drawn.revolute("wrist", "rod", "block", point=place(CRANK + ROD), **hinge)
    along = {"axis": way(1.0, 0.0, 0.0), "second_axis": way(0.0, 1.0, 0.0)}
    drawn.prismatic("guide", "ground", "block", point=place(middle), **along)
    drawn.clearance("guide", **clearance)
    drawn.drive("motor", "main", speed=f"{speed} rpm")
    return drawn.load(
        "push", "block", direction=way(-1.0, 0.0, 0.0), force="100 N", point=place(middle, 0.004)
    )


def of_guide(result: xr.Dataset, name: str) -> FloatArray:
    return np.asarray(result[name].sel(joint="guide").values, dtype=np.float64)


@cache
def static(turned: bool = False) -> xr.Dataset:
    block = BLOCK | {"friction_coefficient": 0.05, "nodes_around": 16, "nodes_along": 48}
    drawn = slider_crank(TURNED if turned else UPRIGHT, block, **SMOOTH)
    return td.simulate(drawn.case().replace({"run.analysis": "static", "run.positions": "12"}))


def test_the_tilt_is_that_of_two_corners() -> None:
    """Where the block leans on opposite faces, as far as play and length of its faces let it."""
    found = static()
    leaning = of_guide(found, "guide_contact") == TILTED
    assert 3 < np.count_nonzero(leaning) < leaning.size
    assert "damping at single points" not in found.attrs["notes"]
    tilt = np.abs(of_guide(found, "tilt_y"))[leaning] + np.abs(of_guide(found, "tilt_x"))[leaning]
    assert tilt == pytest.approx(2.0 * PLAY / LENGTH, rel=0.01)


def test_the_sequence_of_contacts_over_a_cycle_is_that_of_force_and_moment() -> None:
    """A block lies on a face while the middle of its load is between its ends, else on opposite faces."""
    found = static()
    kinematic = slider_crank().case().replace({"run.analysis": "kinematic", "run.positions": "12"})
    ideal = td.simulate(kinematic)
    force, moment = (of_guide(ideal, f"reaction_{name}") for name in ("force", "moment"))
    times = found["time"].values
    across, about = (
        np.interp(times, ideal["time"].values, values)
        for values in (np.abs(force[:, 0]) * 0.5 * LENGTH, np.abs(moment[:, 1]))
    )
    clear = np.abs(across - about) > 0.05 * np.maximum(across, about)
    assert np.count_nonzero(clear) > 9
    expected, contact = np.where(about > across, TILTED, FACE), of_guide(found, "guide_contact")
    assert set(expected[clear]) == {TILTED, FACE}
    assert ((contact == TILTED) == (expected == TILTED))[clear].all()
    # With its load near an end a face of rough asperities leans by less than these let it.
    assert (contact[about < 0.7 * across] == FACE).all()
    assert np.count_nonzero(contact == FACE) > 3


def test_a_guide_that_is_turned_in_space_does_the_same() -> None:
    here, there = static(), static(turned=True)
    for name in ("displacement", "tilt_x", "tilt_y", "reaction_force", "reaction_moment", "pressure_max"):
        first, second = of_guide(here, name), of_guide(there, name)
        # The tilt about the width is none, but for rounding.
        assert second == pytest.approx(first, abs=1e-5 * np.abs(first).max() + 1e-12), name
    assert (of_guide(here, "guide_contact") == of_guide(there, "guide_contact")).all()


def test_wear_is_at_the_ends_of_the_faces() -> None:
    found = static()
    depth, share = np.zeros(2), 0.0
    for surface in found["surface"].values.tolist():
        own = found["wear_depth"].sel(surface=surface).values
        rows = np.unique(found["row_place"].sel(surface=surface).values).size
        depth = np.maximum(depth, (own[[0, rows - 1]].max(), own[rows // 2].max()))
        share = max(share, own.max())
    assert depth[0] == share > 5.0 * depth[1]


@cache
def moving(**clearance: Any) -> xr.Dataset:
    drawn = slider_crank(clearance=BLOCK | {"friction_coefficient": 0.05} | clearance, speed=300.0)
    return td.simulate(drawn)


def test_a_moving_block_passes_through_all_situations_and_loses_no_energy() -> None:
    found = moving(radial="50 um")
    assert set(np.unique(of_guide(found, "guide_contact"))) == {FREE, CORNER, FACE, TILTED}
    numbers = summarise(found)
    shares = [numbers[f"{name}_share_percent_guide"] for name in SITUATIONS]
    assert sum(shares) == pytest.approx(100.0, abs=1e-6)
    assert min(shares) > 0.0
    assert found.attrs["energy_residual"] < 1e-3


@pytest.mark.parametrize("analysis", ["kinematic", "static"])
def test_errors_by_superposition_are_those_of_smooth_rigid_walls(analysis: str) -> None:
    """On a face the block is off by the play; its end swings by the tilt where it leans on both."""
    drawn = slider_crank().output("middle", "block", along=[0, 1, 0])
    drawn.output("lean", "block", quantity="angle", along=[0, 0, 1])
    case = drawn.case().replace({"run.analysis": analysis, "run.positions": "5"})
    result = td.simulate(
        case
        if analysis == "kinematic"
        else case.replace({f"surfaces.{part}.roughness": "0.1 um" for part in ("trunnion", "bushing")})
    )
    off, lean = (
        result["output_error" if analysis == "static" else "error_estimate"]
        .values.reshape(result.sizes["time"], 2, -1)
        .sum(axis=2)
        .T
    )
    share = np.abs(lean) / (2.0 * PLAY / LENGTH)
    assert share.max() == pytest.approx(1.0, rel=0.01)
    assert np.abs(off).max() == pytest.approx(PLAY, rel=0.01)
    # Nothing between: on a face without a tilt, or on two without an offset.
    resting = (share < 0.01) & (np.abs(off) > 0.99 * PLAY) | (share > 0.99) & (np.abs(off) < 0.01 * PLAY)
    assert np.count_nonzero(resting) > 0.8 * resting.size


@pytest.mark.parametrize(("shape", "through"), [("square", False), ("square", True), ("dovetail", False)])
def test_a_block_on_its_face_vibrates_as_on_a_bed_of_springs(shape: str, through: bool) -> None:
    """Heave, pitch and roll of uniform stiffness s over a face: k = s a b, k a²/12, k b²/12."""
    height = {"square": "20 mm", "dovetail": "10 mm"}[shape]
    drawn = td.Mechanism(
        "Block", gravity="0, 0, -9.81 m/s^2", run={"duration": "0.1 s", "analysis": "vibrations"}
    )
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    ends = ("block", "ground") if through else ("ground", "block")
    drawn.prismatic("guide", *ends, point="0, 0, 0 mm", axis=[1, 0, 0], second_axis=[0, 1, 0])
    drawn.clearance("guide", **BLOCK | {"height": height, "shape": shape, "through": through} | SLIPPERY)
    found = td.simulate(drawn)["natural_frequency"].values[0]
    roll, pitch, heave = found[found > 1.0]
    assert pitch / heave == pytest.approx(np.sqrt(2.0 * LENGTH**2 / 12.0 / 1e-3), rel=1e-4)
    assert roll / heave == pytest.approx(np.sqrt(2.0 * 0.03**2 / 12.0 / 1e-3), rel=1e-4)


@pytest.mark.parametrize("stiffness", [2e6, 2e3])
def test_a_block_on_a_spring_along_its_guide_vibrates_at_the_root_of_stiffness_over_mass(stiffness):
    drawn = td.Mechanism(
        "Block", gravity="0, 0, -9.81 m/s^2", run={"duration": "0.1 s", "analysis": "vibrations"}
    )
    drawn.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("guide", "ground", "block", point="0, 0, 0 mm", axis=[1, 0, 0], second_axis=[0, 1, 0])
    drawn.clearance("guide", **BLOCK | SLIPPERY)
    ends = {"first_point": "-100, 0, 0 mm", "second_point": "0, 0, 0 mm"}
    drawn.spring("coil", "ground", "block", **ends, stiffness=f"{stiffness} N/m")
    found = td.simulate(drawn)["natural_frequency"].values[0]
    assert found[0] == pytest.approx(np.sqrt(stiffness / 2.0) / (2.0 * np.pi), rel=1e-5)


def test_a_warm_block_has_the_play_that_its_expansion_leaves() -> None:
    hot = {"temperature": {"trunnion": "70 degC"}}
    case = slider_crank(clearance=BLOCK | hot).case()
    case = case.replace(
        {f"surfaces.{part}.thermal_expansion": "20e-6 1/K" for part in ("trunnion", "bushing")}
    )
    run = td.simulate(case.replace({"run.analysis": "static", "run.positions": "3"}))
    # The wider pair of walls: half of 30 mm, 50 K.
    assert of_guide(run, "clearance") == pytest.approx(PLAY - 15e-3 * 20e-6 * 50.0, rel=1e-9)


def yoke(radial: str = "100 um", **slot: Any) -> td.Mechanism:
    """Return a crank whose pin moves a yoke along x by a slot across; the yoke rubs with 20 N."""
    drawn = td.Mechanism("Scotch yoke", run={"cycles": 1, "analysis": "static", "positions": 24}, **SMOOTH)
    drawn.body("crank", mass="0.3 kg", centre="0, 0, 0 mm", inertia=SMALL)
    drawn.body("yoke", mass="0.5 kg", centre="60, 0, 0 mm", inertia=SMALL)
    drawn.revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.slot("pin", "yoke", "crank", point="50, 0, 0 mm", axis=[0, 1, 0], second_axis=[0, 0, 1])
    drawn.clearance("pin", radius="6 mm", length="20 mm", radial=radial, **slot)
    drawn.prismatic("rail", "ground", "yoke", point="60, 0, 0 mm", axis=[1, 0, 0])
    drawn.friction("rub", joint="rail", friction_coefficient=0.2, normal_load="100 N", slip_velocity="1 um/s")
    return drawn.drive("motor", "main", speed="6 rpm").output("way", "yoke", along=[1, 0, 0])


def test_a_yoke_lags_by_the_play_of_its_slot_and_loses_twice_that_at_each_reversal() -> None:
    result = td.simulate(yoke(friction_coefficient=0.0))
    angle = 2.0 * np.pi * 0.1 * result["time"].values
    error, speed = result["output_error"].values[:, 0], -np.sin(angle)
    moving = np.abs(speed) > 0.1
    assert error[moving] == pytest.approx(-PLAY * np.sign(speed[moving]), rel=0.01)
    force = result["contact_force"].sel(joint="pin").values[moving]
    assert np.linalg.norm(force, axis=1) == pytest.approx(20.0, rel=1e-3)
    contact = result["guide_contact"].sel(joint="pin").values[moving]
    assert (contact == FACE).all()
    # Along itself the pin is free: the room between the walls is drawn as far as it goes.
    result["displacement"].loc[{"joint": "pin", "axis": "x"}] = 3.0 * PLAY
    ((orbit,), _) = orbits(result)
    assert np.abs(orbit.corners).max(axis=0) == pytest.approx([1e6 * 3.3 * PLAY, 1e6 * PLAY])
    # The pin turns by 360 degrees against the yoke: no block tilts in its guide.
    assert [panel.label.partition(":")[0] for panel in guides(result)] == ["contact"]


def test_a_yoke_in_motion_strikes_its_pin_and_keeps_the_energy() -> None:
    changes = {"run.analysis": "dynamic", "drives.motor.speed.value": "120 rpm", "run.cycles": 0.6}
    result = td.simulate(yoke().case().replace(changes))
    way = 0.05 * np.cos(4.0 * np.pi * result["time"].values)
    off = result["position"].sel(body="yoke", axis="x").values - 0.01 - way
    # Impacts press the walls through each other; so the bodies yield there, see the notes.
    assert not result.attrs["failure"]
    assert np.abs(off).max() == pytest.approx(PLAY - float(result["gap_min"].min()), rel=1e-3)
    assert np.abs(off).max() < 1.1 * PLAY
    assert result.attrs["energy_residual"] < 1e-3
    assert result["wear_depth"].values.max() > 0.0


@pytest.mark.parametrize(
    ("keys", "reason"),
    [
        ({"radial": "3 mm"}, "clearance.radial.*must not exceed a tenth of width and height"),
        ({"shape": "dovetail", "height": "25 mm"}, "clearance.height.*the flanks meet 21.42 mm above"),
        ({"radius": "9 mm"}, "clearance.radius.*there is a width and a height, and no radius"),
        ({"contact": "point-johnson"}, "contact.*touches over its surface, not at points"),
        ({"form": {"crown": "3 um"}}, "clearance.form.*a form is that of a shaft in a bore"),
        ({"shape": "dovetail", "flank_angle": "95 deg"}, "clearance.flank_angle"),
        ({"temperature": {"trunnion": "2000 degC"}}, "clearance.radial.*would seize"),
    ],
)
def test_a_guide_that_cannot_be_is_refused_with_its_key(keys: dict[str, Any], reason: str) -> None:
    expansion = {f"surfaces.{part}.thermal_expansion": "20e-6 1/K" for part in ("trunnion", "bushing")}
    with pytest.raises(InputError, match=reason):
        td.simulate(slider_crank(clearance=BLOCK | keys).case().replace(expansion))
