"""Drives of the vane mechanism from tables: where they turn, what they are, and which are refused."""

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.drives import run_segments
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

TIMES = np.linspace(0.0, 2.0 * math.pi, 65)
SINUSOID = np.radians(-16.0 + 20.0 * (1.0 - np.cos(TIMES)))
RAMP = "time [s], crank [deg]\n0, -16\n0.5, -16\n1.5, 4\n2.5, 4\n3.5, -16\n4, -16\n"


def written(folder: Path, text: str) -> Path:
    (folder / "stroke.csv").write_text(text)
    (folder / "case.toml").write_text('case = "vsv"\n[drive.angle]\ntable = "stroke.csv"\n')
    return folder / "case.toml"


def case_with(changes: Mapping[str, object], folder: Path) -> VsvCase:
    """Return the built-in case with other keys, new tables among them."""
    lines = [f"{path} = {value!r}".replace("'", '"') for path, value in changes.items()]
    (folder / "case.toml").write_text('case = "vsv"\n' + "\n".join(lines) + "\n")
    case = td.load_case(folder / "case.toml")
    assert isinstance(case, VsvCase)
    return case


def series(numbers: np.ndarray, unit: str) -> str:
    return f"{', '.join(map(repr, numbers.tolist()))} {unit}"


@pytest.fixture
def sampled(tmp_path: Path) -> VsvCase:
    """Return the built-in case with its own crank angle as a table of one cycle."""
    return case_with(
        {"drive.angle.times": series(TIMES, "s"), "drive.angle.values": series(SINUSOID, "rad")}, tmp_path
    )


def test_a_sampled_sinusoid_is_that_sinusoid(sampled: VsvCase) -> None:
    again = sampled.replace({"run.cycles": 2.0})
    crank, paper = again.crank, td.load_case("vsv").crank  # type: ignore[attr-defined]
    times = np.linspace(0.0, 4.0 * math.pi, 1001)
    # Error of a periodic cubic spline: 5/384 h⁴ of the fourth derivative, 20° here.
    bound = 5.0 / 384.0 * TIMES[1] ** 4 * np.radians(20.0) * 1.1
    np.testing.assert_allclose(crank.angle(times), paper.angle(times), rtol=0.0, atol=bound)
    assert again.period == pytest.approx(2.0 * math.pi)
    np.testing.assert_allclose(
        run_segments(vsv_of(again), again.duration).turns, math.pi * np.arange(1, 4), atol=1e-4
    )


def test_speed_and_stroke_make_the_same_angle(tmp_path: Path) -> None:
    speed = case_with(
        {
            "drive.start_angle": "-16 deg",
            "drive.speed.times": series(TIMES, "s"),
            "drive.speed.values": series(np.radians(20.0) * np.sin(TIMES), "rad/s"),
        },
        tmp_path,
    )
    stroke = case_with(
        {
            "drive.start_angle": "-16 deg",
            "drive.actuator_arm": "40 mm",
            "drive.stroke.times": series(TIMES, "s"),
            "drive.stroke.values": series(0.04 * (SINUSOID - SINUSOID[0]), "m"),
        },
        tmp_path,
    )
    for case in (speed, stroke):
        # As above, and its integral over 2π.
        np.testing.assert_allclose(case.crank.angle(TIMES), SINUSOID, rtol=0.0, atol=3e-6)


def test_ramps_and_holds_turn_where_they_stop_and_start(tmp_path: Path) -> None:
    written(tmp_path, RAMP)
    (tmp_path / "case.toml").write_text(
        'case = "vsv"\n[drive]\ncorner_time = "40 ms"\n'
        '[drive.angle]\ntable = "stroke.csv"\ninterpolation = "linear"\n'
    )
    case = td.load_case(tmp_path / "case.toml")
    assert isinstance(case, VsvCase)
    found = run_segments(vsv_of(case), case.duration)
    np.testing.assert_allclose(found.turns, [0.48, 1.52, 2.48, 3.52], atol=1e-12)
    assert list(dict.fromkeys(found.segments.direction.tolist())) == [0.0, 1.0, -1.0]
    assert case.crank.angle(np.array([2.0])) == pytest.approx(math.radians(4.0), abs=1e-15)
    # Corners are rounded, the lines between are those of the table.
    assert case.crank.speed(np.array([1.0])) == pytest.approx(math.radians(20.0), rel=1e-12)
    assert np.abs(np.diff(case.crank.speed(np.linspace(0.0, 4.0, 40001)))).max() < math.radians(0.06)


def test_a_noisy_stroke_is_smoothed(tmp_path: Path) -> None:
    noise = np.random.default_rng(1).normal(0.0, 1e-3, TIMES.size)
    given = {"drive.angle.times": series(TIMES, "s"), "drive.angle.values": series(SINUSOID + noise, "rad")}
    rough = case_with(given, tmp_path)
    smooth = case_with({**given, "drive.angle.interpolation": "smooth"}, tmp_path)
    turns = [run_segments(vsv_of(case), case.duration).turns.size for case in (rough, smooth)]
    assert turns[0] > turns[1] >= 1
    error = [np.abs(case.crank.angle(TIMES) - SINUSOID).max() for case in (rough, smooth)]
    assert error[1] < error[0]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("time [s], crank [deg]\n1, -16\n2, 0\n", "begins at 1 s"),
        ("time [s], crank [deg]\n0, -16\n1, 0\n1, 0\n2, -16\n", "no crank changes its speed at once"),
        ("time [s], crank [deg]\n0, -16\n2, 0\n1, 3\n", "goes back"),
        ("time [s], crank [deg]\n0, -16\nnan, 0\n", "lacks a number"),
        ("time [s], crank [deg]\n0, -16\n1\n", "lacks a number"),
        ("time [s], crank [mm]\n0, -16\n1, 2\n", "not a unit of angle"),
        ("angle [deg], crank [deg]\n0, -16\n1, 2\n", "here it is times"),
        ("time [s], crank [deg]\n0, -16\n1, -30\n", "the mechanism reaches only"),
    ],
)
def test_a_stroke_that_cannot_be_is_refused(content: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=words):
        td.load_case(written(tmp_path, content))


def test_a_table_that_does_not_close_is_not_repeated(tmp_path: Path) -> None:
    case = td.load_case(written(tmp_path, "time [s], crank [deg]\n0, -16\n1, -10\n2, 0\n"))
    assert case.duration == 2.0
    for changes in ({"run.cycles": 2.0}, {"wear.cycles": 10}, {"run.duration": "2.1 s"}):
        with pytest.raises(InputError, match="only where angle and speed"):
            case.replace(changes)


def test_a_table_takes_the_place_of_the_sinusoid(sampled: VsvCase) -> None:
    back = sampled.replace({"drive.speed_amplitude": "10 deg/s"})
    assert back.drive.angle is None
    assert back.crank.signal is None
    assert parse_case(sampled.to_toml(), "again") == sampled


def test_a_run_may_end_before_its_table_sets_out(tmp_path: Path) -> None:
    written(tmp_path, RAMP)
    case = td.load_case(tmp_path / "case.toml").replace(
        {"drive.angle.interpolation": "linear", "run.duration": "0.3 s"}
    )
    assert isinstance(case, VsvCase)
    result = td.simulate(case)
    assert not result.attrs["failure"]
    assert float(np.abs(result["omega_v_ideal"]).max()) == 0.0
    # At rest nothing opposes a motion.
    assert float(np.abs(result["M_air"]).max()) == 0.0


def test_a_crank_that_never_moves_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the crank must move"):
        td.load_case(written(tmp_path, "time [s], crank [deg]\n0, -16\n1, -16\n"))


def test_a_crank_that_hardly_moves_is_refused_or_runs() -> None:
    case = td.load_case("vsv").replace({"run.duration": "1 ms", "run.output_interval": "0.1 ms"})
    with pytest.raises(InputError, match="the crank must move, by more than"):
        case.replace({"drive.speed_amplitude": "1e-45 deg/s"})
    result = td.simulate(case.replace({"drive.speed_amplitude": "1e-7 deg/s"}))
    assert not result.attrs["failure"]
    assert float(np.ptp(result["theta_v_ideal"].values)) < 1e-6
