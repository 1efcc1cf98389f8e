"""Instants of a run: where outputs are read, lives end, and what a film of the motion shows."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanisms.output_keys import Instant
from tribodyn.mechanisms.output_numbers import errors_at, lives, passes, shaft_displacements
from tribodyn.mechanisms.workload import AFTER_REVERSAL, EVEN, frame_times, shown

ANGLE = np.linspace(-np.pi, np.pi, 97)[:-1]
NORMAL = np.tile(np.column_stack([np.cos(ANGLE), np.sin(ANGLE), 0.0 * ANGLE]), (2, 1))
POSITION = 0.01 * NORMAL + np.repeat([[0.0, 0.0, -0.02], [0.0, 0.0, 0.02]], ANGLE.size, axis=0)
PRESSED = np.maximum(NORMAL[:, 1], 0.0)[None] ** 2


def test_a_shaft_follows_a_bore_that_is_displaced_and_tilted() -> None:
    moved = np.array([0.0, 3e-6, 0.0, 1e-5, 0.0, 0.0])
    depth = NORMAL @ moved[:3] + np.cross(POSITION, NORMAL) @ moved[3:]
    depth = np.where(PRESSED[0] > 0.0, depth, 0.0)
    assert shaft_displacements(POSITION, NORMAL, PRESSED, depth)[0] == pytest.approx(moved, abs=1e-15)


def test_a_shaft_moves_by_no_more_than_the_largest_depth() -> None:
    # Two lines of contact side by side, one of them worn: the shaft would roll far to the side.
    narrow = np.where(np.abs(ANGLE) < 0.1, 1.0, 0.0)
    depth = np.where(ANGLE > 0.0, 1e-6, 0.0)
    weight, worn = np.tile(narrow, 2)[None], np.tile(depth, 2)
    moved = shaft_displacements(POSITION, NORMAL, weight, worn)[0]
    assert np.linalg.norm(moved[:3]) == pytest.approx(1e-6)


def test_no_pressure_is_no_displacement() -> None:
    assert not shaft_displacements(POSITION, NORMAL, 0.0 * PRESSED, PRESSED[0]).any()


def test_lives_are_those_of_the_instant_that_reaches_the_limit_first() -> None:
    error = np.array([[1.0, -2.0, 0.5], [2.0, 1.0, 0.5]])
    growth = np.array([[0.5, -0.1, np.nan], [0.1, -0.1, 0.1]])
    # (4 − 1) / 0.5 = 6 before (4 − 2) / 0.1; (4 − 2) / 0.1 before (4 + 1) / 0.1; no limit.
    assert lives(error, growth, np.array([4.0, 4.0, np.nan])) == pytest.approx(
        [6.0, 20.0, np.nan], nan_ok=True
    )
    assert lives(5.0 + error, growth, np.array([4.0] * 3))[0] == 0.0


TIMES = np.linspace(0.0, 2.0, 2001)


def at(instant: Instant, error: np.ndarray, drive: np.ndarray, period: float = 1.0) -> dict[str, float]:
    found = errors_at([instant], TIMES, {"vane": error}, lambda _: drive, period)
    return {name: float(values[0]) for name, values in found.items()}


def test_a_drive_to_and_fro_passes_an_angle_in_both_directions() -> None:
    drive, rate = np.sin(2.0 * np.pi * TIMES), np.cos(2.0 * np.pi * TIMES)
    found = at(Instant("vane", "angle", 0.5), 3.0 + np.sign(rate), drive)
    assert found["error_at_forward"] == pytest.approx(4.0)
    assert found["error_at_backward"] == pytest.approx(2.0)
    assert found["error_at"] == pytest.approx(3.0)


def test_a_rotating_drive_passes_an_angle_once_a_turn() -> None:
    # The error rises by one in a cycle; of two the first is left out.
    found = at(Instant("vane", "angle", 0.5 * np.pi), TIMES, 2.0 * np.pi * TIMES)
    assert found["error_at"] == pytest.approx(1.25)
    assert np.isnan([found["error_at_forward"], found["error_at_backward"]]).all()
    found = at(Instant("vane", "angle", 0.5 * np.pi), TIMES, 2.0 * np.pi * TIMES, period=np.inf)
    assert found["error_at"] == pytest.approx(0.75)


def test_angles_at_both_ends_of_a_run_count_whatever_rounding_makes_of_them() -> None:
    for drive in (2.0 * np.pi * TIMES, np.nextafter(2.0 * np.pi * TIMES, -9.0), 2.0 * np.pi * TIMES + 1e-14):
        when, senses = passes(TIMES, drive, 0.0, turns=True)
        assert when == pytest.approx([0.0, 1.0, 2.0], abs=1e-9)
        assert senses.tolist() == [1.0, 1.0, 1.0]


def test_a_drive_that_does_not_come_there_gives_no_number() -> None:
    assert np.isnan(at(Instant("vane", "angle", 2.0), TIMES, np.sin(TIMES))["error_at"])
    # A position is not counted modulo whole turns.
    assert np.isnan(at(Instant("vane", "position", 0.5 + 2.0 * np.pi), TIMES, np.sin(TIMES))["error_at"])


def test_times_are_those_of_each_cycle() -> None:
    assert at(Instant("vane", "time", 0.25), TIMES, TIMES)["error_at"] == pytest.approx(1.25)
    assert at(Instant("vane", "time", 0.25), TIMES, TIMES, period=np.inf)["error_at"] == pytest.approx(0.25)
    assert np.isnan(at(Instant("vane", "time", 3.0), TIMES, TIMES, period=np.inf)["error_at"])


@pytest.mark.parametrize(
    ("value", "kind", "name"),
    [
        (np.radians(22.5), "angle", "left_vane_22_5_deg"),
        (-np.pi / 6.0, "angle", "left_vane_minus_30_deg"),
        (0.005, "position", "left_vane_5_mm"),
        (0.1, "time", "left_vane_0_1_s"),
    ],
)
def test_names_of_instants_are_identifiers(value: float, kind: str, name: str) -> None:
    assert Instant("left-vane", kind, value).name == name
    assert name.isidentifier()


TURNS = np.array([1.0, 2.0, 3.0, 4.0, 5.0])  #: Reversals of a drive with a period of 2 s, in a run of 6 s.


def test_a_film_is_one_cycle_with_slow_motion_after_reversals() -> None:
    times = frame_times(6.0, 2.0, TURNS, 0.05)
    film = times[shown(times, 6.0, 2.0)]
    assert film[0] == pytest.approx(4.0)
    assert film[-1] == pytest.approx(6.0)
    assert np.diff(film).max() <= 2.0 / EVEN * (1 + 1e-9)
    after = (film > 5.0) & (film <= 5.05 + 1e-9)
    assert AFTER_REVERSAL <= after.sum() <= AFTER_REVERSAL + 4


@pytest.mark.parametrize(("reached", "begin", "end"), [(1.0, 0.0, 1.0), (3.9, 0.0, 2.0), (4.5, 4.0, 4.5)])
def test_a_run_that_stops_keeps_the_last_cycle_it_reached(reached: float, begin: float, end: float) -> None:
    times = frame_times(6.0, 2.0, TURNS, 0.05)
    times = times[times <= reached]
    film = times[shown(times, 6.0, 2.0)]
    assert film[0] == pytest.approx(begin)
    assert film[-1] == pytest.approx(end, abs=2.0 / EVEN)


def test_the_film_agrees_with_the_time_series() -> None:
    result = td.simulate(td.load_case("vsv").replace({"run.duration": "0.2 s"}))
    frames = result["pressure_cycle"]
    assert frames.dtype == np.float32
    time, peak = result["time"].values, result["p_max"].values
    same = np.isin(np.round(result["frame_time"].values, 12), np.round(time, 12))
    found = np.interp(result["frame_time"].values[same], time, peak)
    # Single precision keeps seven digits.
    np.testing.assert_allclose(frames.values.max(axis=(1, 2))[same], found, rtol=1e-6)
    assert same.sum() > 10
