"""What may stand for a case where one is simulated."""

from pathlib import Path

import pytest
import xarray as xr

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError

PENDULUM = """
case = "mechanism"
[bodies.rod]
mass = "1 kg"
centre = "0.5, 0, 0 m"
inertia = "0.01, 0.01, 0.01 kg m^2"
[joints.pivot]
type = "revolute"
between = ["ground", "rod"]
point = "0, 0, 0 m"
axis = [0, 0, 1]
"""


def test_a_mechanism_a_name_and_a_file_stand_for_their_case(tmp_path: Path) -> None:
    rod = {"mass": "1 kg", "centre": "0.5, 0, 0 m", "inertia": "0.01, 0.01, 0.01 kg m^2"}
    pendulum = td.Mechanism("Pendulum", gravity="0, -9.81, 0 m/s^2", run={"duration": "20 ms"})
    pendulum.body("rod", **rod).revolute("pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1])
    file = tmp_path / "pendulum.toml"
    file.write_text(pendulum.case().to_toml(), encoding="utf-8")
    expected = td.simulate(pendulum.case())
    for given in (pendulum, file, str(file)):
        found = td.simulate(given)
        xr.testing.assert_identical(found["joint_angle"], expected["joint_angle"])


def test_a_name_is_that_of_a_built_in_case() -> None:
    assert td.simulate("four-bar").attrs["failure"] == ""
    with pytest.raises(InputError, match="did you mean slider-crank"):
        td.simulate("slider-crnk")


def test_a_change_gives_what_a_file_lacks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "pendulum.toml"
    file.write_text(PENDULUM, encoding="utf-8")
    with pytest.raises(InputError, match="say how long"):
        td.load_case(file)
    assert td.load_case(file, {"run.duration": "1 s"}) == td.load_case(file, {"run.duration": "1000 ms"})
    assert main(["check", str(file)]) == 2
    assert "say how long" in capsys.readouterr().err
    assert main(["check", str(file), "--set", "run.duration=1 s"]) == 0
    # Alternatives go, and what is still wrong is said.
    assert main(["check", str(file), "--set", "run.durration=1 s"]) == 2
    assert "the nearest valid one is run.duration" in capsys.readouterr().err
    assert main(["check", str(tmp_path / "missing.toml"), "--set", "run.duration=1 s"]) == 2
    assert "there is no such file" in capsys.readouterr().err


@pytest.mark.parametrize("given", [3, None, {"case": "vsv"}, object()])
def test_what_is_no_case_is_refused(given: object) -> None:
    with pytest.raises(InputError, match=r"case: given .*; allowed: a case, a Mechanism, the name"):
        td.simulate(given)  # type: ignore[arg-type]
