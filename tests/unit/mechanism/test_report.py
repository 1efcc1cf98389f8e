"""What is told and drawn of a mechanism: numbers by joint, figures, the report, arrows of loads, files."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.unit.mechanism.made_up import N, result

from tribodyn.cases.case import with_entries
from tribodyn.mechanism.assembly.skeleton import case_of, skeleton
from tribodyn.mechanism.figures import FIGURES
from tribodyn.mechanism.mechanism_variables import VARIABLES
from tribodyn.mechanism.sections import CHAPTERS
from tribodyn.mechanism.sections.mechanism import at_frames, data
from tribodyn.mechanism.sections.scene import LoadArrows, load_arrows
from tribodyn.mechanisms import results
from tribodyn.results.schema import check
from tribodyn.views.encode import Packed
from tribodyn.views.playback import playback_times

RESULT = result()


def test_a_result_reads_back_and_opens_in_xarray_with_names(tmp_path: Path) -> None:
    results.write_run(RESULT, tmp_path)
    again = results.read(tmp_path)
    assert again["body"].values.tolist() == ["crank", "rod", "slider"]
    opened = xr.open_dataset(tmp_path / "result.nc", engine="netcdf4", decode_timedelta=False)
    wrist = opened["reaction_force"].sel(joint="wrist", axis="x")
    assert float(wrist.max()) == pytest.approx(2700.0)
    opened.close()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"joint": ("joint", ["main", "main", "wrist", "guide"])}, "a name of joint is given twice"),
        ({"joint": ("joint", [1.0, 2.0, 3.0, 4.0])}, "joint does not hold texts"),
    ],
)
def test_a_result_whose_names_are_none_is_refused(change: dict[str, object], words: str) -> None:
    attributes = RESULT["joint"].attrs
    wrong = RESULT.assign_coords(change)
    wrong["joint"].attrs.update(attributes)
    with pytest.raises(ValueError, match=words):
        check(wrong, {"mechanism": VARIABLES})


def test_numbers_are_told_of_each_joint_by_its_name() -> None:
    told = results.summarise(RESULT)
    assert told["joint_force_max_N"] == pytest.approx(2700.0)
    assert told["force_max_N_guide"] == pytest.approx(40.0)
    assert told["offset_max_um_wrist"] == pytest.approx(22.0)
    assert told["peak_pressure_MPa_wrist"] == pytest.approx(40.0)
    assert "offset_max_um_main" not in told
    labels = results.known(told, "mechanism")
    assert labels["force_max_N_guide"].label == "Force, peak, guide"
    assert set(labels) == {name for name, value in told.items() if isinstance(value, int | float)}


def test_a_blow_is_a_peak_and_does_not_last() -> None:
    near = np.sort(np.append(RESULT["time"], 0.003 + 1e-5 * np.array([-1.0, 1.0])))
    smooth = RESULT.interp(time=near).assign_attrs(cycle_period=0.012)
    force = smooth["reaction_force"].copy(deep=True)
    force[N // 4 + 1, :, 0] = 1e5
    told, whole = results.summarise(smooth.assign(reaction_force=force)), results.summarise(RESULT)
    assert told["force_max_N_wrist"] == pytest.approx(1e5)
    # A triangle 20 µs wide of a turn of 12 ms; a cosine is above cos(π/200) for a hundredth of the time, and
    # rows stand at every six degrees.
    assert told["force_sustained_N_wrist"] == pytest.approx(whole["force_sustained_N_wrist"], rel=2e-3)
    assert whole["force_sustained_N_wrist"] == pytest.approx(2700.0 * math.cos(math.pi / 200.0), rel=2e-3)
    known = results.known(told, "mechanism")
    assert known["force_max_N_wrist"].label_in(told) == "Force, peak over 1 cycle, wrist"


def test_cycles_that_are_not_alike_scatter() -> None:
    t, period = RESULT["time"].values, 0.012
    cycles = xr.concat(
        [RESULT.isel(time=slice(0, N - 1)).assign_coords(time=t[:-1] + k * period) for k in range(4)],
        "time",
        data_vars="minimal",
    )
    end = RESULT.isel(time=[N - 1]).assign_coords(time=[4.0 * period])
    four = xr.concat([cycles, end], "time", data_vars="minimal").assign_attrs(cycle_period=period)
    told = results.summarise(four)
    assert told["cycles"] == 3
    assert told["cycle_scatter_percent"] == pytest.approx(0.0, abs=1e-9)
    scale = xr.where(four["time"] < 2.0 * period, 1.0, xr.where(four["time"] < 3.0 * period, 1.1, 1.2))
    grown = four.assign(reaction_force=four["reaction_force"] * scale)
    # 1.0, 1.1 and 1.2; the last row of a cycle is the first of the next one.
    assert results.summarise(grown)["cycle_scatter_percent"] == pytest.approx(100.0 * 0.2 / 1.1, rel=1e-6)


def test_bodies_are_drawn_where_they_are() -> None:
    case = case_of(RESULT)
    assert case is not None
    drawn, (position, orientation) = skeleton(case), at_frames(RESULT)
    quarter = N // 4
    crank = drawn.lines(0, position[quarter, 0], orientation[quarter, 0])
    # Lengths in mm; straight lines between rows shorten an arc of six degrees by a thousandth.
    np.testing.assert_allclose(crank, [[0.0, 0.0, 0.0], [0.0, 50.0, 0.0]], atol=0.1)
    rod = drawn.lines(1, position[quarter, 1], orientation[quarter, 1])
    np.testing.assert_allclose(np.linalg.norm(rod[1] - rod[0]), 120.0, atol=0.1)


def _at(values: Packed, size: int) -> np.ndarray:
    return values.array.reshape(-1, size)


def test_pins_move_in_their_bores_as_the_result_has_it() -> None:
    payload = data(RESULT)
    assert payload is not None
    joints = {joint["name"]: joint for joint in payload["joints"]}
    clearance = joints["wrist"]["clearance"]
    assert clearance["radial"] == pytest.approx(0.02)
    frames = playback_times(RESULT)
    turn = 2.0 * np.pi * frames / 0.012
    # The bore turns with the rod; between rows the made-up rates are differences.
    swing = -np.arcsin(50.0 / 120.0 * np.sin(turn))
    x, y = 0.022 * np.cos(turn), 0.021 * np.sin(turn)
    expected = np.stack(
        [x * np.cos(swing) - y * np.sin(swing), x * np.sin(swing) + y * np.cos(swing)], axis=-1
    )
    found = _at(clearance["offset"], 3)
    np.testing.assert_allclose(found[:, :2], expected, atol=1e-4)
    assert np.abs(found[:, 2]).max() == 0.0
    assert joints["main"]["clearance"] is None
    assert payload["magnification"]["value"] >= 1.0
    assert [name for name, joint in joints.items() if joint["grounded"]] == ["main", "guide"]


def test_arrows_are_the_forces_of_the_result() -> None:
    # Along the axis of the pin, which stays that of the drawing, z.
    force = xr.zeros_like(RESULT["reaction_force"])
    force[:, 1, 2] = 100.0
    payload = data(RESULT.assign(reaction_force=force))
    assert payload is not None
    assert payload["forces"]["force"]["scale"] == pytest.approx(100.0)
    found = _at(payload["forces"]["force"]["at"][str(RESULT["joint"].values[1])], 3)
    np.testing.assert_allclose(found, np.tile([0.0, 0.0, 100.0], (len(found), 1)), atol=1e-5)
    assert "moment" not in payload["forces"]


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_is_drawn_of_a_whole_result_and_of_an_empty_one(name: str) -> None:
    family = FIGURES[name]
    if not family.drawable(RESULT):
        assert name in ("wear_history", "modes", "mode_shapes", "guides", "copies")
        return
    assert family.draw(RESULT).axes
    assert family.draw(RESULT.isel(time=slice(0, 0), frame=slice(0, 0))).axes


@pytest.mark.parametrize(
    "section", [s for chapter in CHAPTERS for s in chapter.sections], ids=lambda s: s.name
)
def test_every_section_has_data_where_the_result_has(section) -> None:
    whole = section.payload(RESULT)
    assert (whole is None) == (section.name in ("wear-history", "modes", "guides", "copies"))
    empty = section.payload(RESULT.isel(time=slice(0, 0), frame=slice(0, 0)))
    assert empty is None or section.name == "wear"


def test_natural_frequencies_are_drawn_where_a_result_has_them() -> None:
    values = np.arange(2.0 * RESULT.sizes["time"]).reshape(-1, 2)
    found = RESULT.assign_coords(mode=["1", "2"]).assign(
        natural_frequency=(("time", "mode"), values), damping_ratio=(("time", "mode"), 1e-3 * values)
    )
    assert FIGURES["modes"].drawable(found)
    assert len(FIGURES["modes"].draw(found).axes) == 2


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
