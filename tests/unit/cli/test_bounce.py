import json

import pytest

from tribodyn.cli.main import main
from tribodyn.contact import DAMPING_FACTORS


def test_shows_every_factor_of_a_law(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "linear", "--set", "contact.restitution=0.6"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in lines[1:]] == list(DAMPING_FACTORS)
    assert lines[0].split() == ["law", "damping", "factor", "wanted", "point", "plate", "shaft"]
    calibrated = lines[-1].split()
    assert calibrated[2:5] == ["0.6000"] * 3


def test_json_is_one_document(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "linear", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    # Without a restitution it is that of the law rsdc, 0.70 at 50 MPa.
    assert {round(row["wanted"], 2) for row in rows} == {0.7}
    assert rows[0]["shaft"] == pytest.approx(1.0, abs=1e-4)


def test_a_joint_of_a_mechanism_of_ones_own_is_chosen_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["bounce", "vsv-joints", "--law", "linear", "--json"]
    assert main([*arguments, "--joint", "guide"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == len(DAMPING_FACTORS)
    assert main([*arguments, "--joint", "giude"]) == 2
    assert 'did you mean "guide"' in capsys.readouterr().err


def test_a_mechanism_drops_its_own_shaft(capsys: pytest.CaptureFixture[str]) -> None:
    rows = {}
    for case, key in (("vsv", "joint.clearance"), ("slider-crank", "joints.wrist.clearance.radial")):
        assert main(["bounce", case, "--law", "rsdc", "--json", "--set", f"{key}=30 um"]) == 0
        rows[case] = json.loads(capsys.readouterr().out)
    # The same surfaces by default, another pin: a restitution depends on surfaces and pressure alone.
    for first, second in zip(rows["vsv"], rows["slider-crank"], strict=True):
        assert first["plate"] == pytest.approx(second["plate"], rel=1e-6)
        assert first["shaft"] == pytest.approx(second["shaft"], rel=0.02)


def test_unknown_law_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "hertz"]) == 2
    assert "allowed: ke, rsdc" in capsys.readouterr().err


def test_a_case_without_a_shaft_in_a_bore_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "slider-crank-3d"]) == 2
    assert "no joint of this case is a shaft in a bore" in capsys.readouterr().err
