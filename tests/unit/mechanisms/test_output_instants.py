"""Errors of outputs at angles, positions and times."""

import numpy as np
import pytest

from tribodyn.mechanisms.output_keys import Instant
from tribodyn.mechanisms.output_numbers import errors_at, passes

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
