"""Slopes of key results over keys of a case."""

from pathlib import Path

import numpy as np
import pytest

from tribodyn.cli.main import main
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.studies.differences import plateau, slopes

CASE = "slider-crank"
ARM = """
case = "mechanism"
gravity = "0, -9.81, 0 m/s^2"
run.analysis = "kinematic"
run.positions = 4
run.duration = "0.2 s"
[bodies]
arm = { mass = "1 kg", centre = "100, 0, 0 mm", inertia = "1e-3, 1e-2, 1e-2 kg m^2" }
[joints]
pivot = { type = "revolute", between = ["ground", "arm"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
[drives.motor]
joint = "pivot"
angle = { value = "0 deg", swing = "60 deg", angular_frequency = "31 rad/s" }
"""


def test_longest_plateau_of_least_spread_is_taken() -> None:
    assert plateau(np.array([7.0, 2.5, 2.01, 2.0, 2.02, 3.0])) == (2, 5)
    assert plateau(np.array([1.0, 1.0, 1.0, 1.04, 1.04, 1.04])) == (0, 6)
    assert plateau(np.array([1.0, -1.0, 2.0, -3.0, 4.0, -9.0])) == (0, 0)
    assert plateau(np.zeros(6)) == (0, 6)


def test_forces_of_a_mechanism_without_loads_are_homogeneous_in_its_masses(tmp_path: Path) -> None:
    """Euler: the relative slopes over all masses and moments of inertia add up to 1."""
    numbers = ["drive_moment_rms_Nm", "force_mean_N_pivot"]
    keys = ["bodies.arm.mass", "bodies.arm.inertia.z"]
    found = slopes(parse_case(ARM, "arm"), keys, numbers, directory=tmp_path, workers=0)
    assert all(0.05 < abs(one.relative) < 0.95 for one in found if one.number == numbers[0])
    for number in numbers:
        assert sum(one.relative for one in found if one.number == number) == pytest.approx(1.0, rel=1e-4)


def test_a_key_without_effect_has_slope_zero_and_a_key_at_zero_needs_a_step(tmp_path, capsys):
    few = ["--set", "run.analysis=kinematic", "--set", "run.positions=4"]
    asked = ["slopes", CASE, *few, "--of", "drive_moment_max_Nm", "--workers", "0"]
    place = ["-o", str(tmp_path)]
    assert main([*asked, "--vary", "bodies.slider.centre.z=1 mm", *place]) == 0
    assert "bodies.slider.centre.z" in capsys.readouterr().out
    assert main([*asked, "--vary", "bodies.slider.centre.z", *place]) == 2
    assert "the value is 0" in capsys.readouterr().err
    assert main([*asked, "--vary", "run.analysis", *place]) == 2
    assert "a slope needs a key with a number" in capsys.readouterr().err


def test_a_number_that_jumps_has_no_slope(monkeypatch, capsys):
    """The largest value of an impact may follow the tolerance more than the key."""
    monkeypatch.setattr(
        "tribodyn.studies.differences.numbers_of",
        lambda dataset, name: np.array([1.0] + [0.0] * 6 + [1.0, -1.0, 2.0, -2.0, 3.0, -3.0]),
    )
    monkeypatch.setattr("tribodyn.studies.differences.run", lambda *_: None)
    [one] = slopes(CASE, ["joints.wrist.clearance.radial"], ["force_max_N_wrist"])
    assert np.isnan(one.value)
    assert one.steps == ()
    with pytest.raises(InputError, match="not a key result"):
        slopes(CASE, ["joints.wrist.clearance.radial"], ["nonsense"])


@pytest.mark.long(minutes=0.3)
def test_a_slope_is_the_same_at_any_tolerance() -> None:
    """Steps of 0.1 % to 1 % of a clearance agree within 3 % over four decades of the tolerance."""
    key, found = "joints.wrist.clearance.radial", []
    for rtol in (1e-5, 1e-7, 1e-9):
        case = load_case(CASE).replace({"solver.rtol": rtol, "run.cycles": 1})
        [one] = slopes(case, [key], ["error_rms_um_slider"], workers=0)
        found.append(one.value)
    assert np.ptp(found) < 0.03 * np.mean(found)
