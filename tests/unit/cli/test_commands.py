import json
import sys
import tomllib
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import built_in, parse_case


def test_cases_are_listed_one_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cases"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(built_in())
    assert main(["cases", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == list(built_in())


@pytest.mark.parametrize("name", built_in())
def test_what_show_prints_runs(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", name]) == 0
    assert parse_case(capsys.readouterr().out, "show") == td.load_case(name)


def test_show_prints_resolved_defaults(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "vsv", "--set", "mechanism.formulation=paper", "--solver", "radau"]) == 0
    shown = tomllib.loads(capsys.readouterr().out)
    assert shown["joint"]["friction"] == "moment"
    assert shown["run"]["start"] == "centred"
    assert shown["solver"]["name"] == "radau"


def test_show_as_json_is_in_si_units(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "vsv", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["joint"]["clearance"] == 2e-5


def test_check_says_that_a_file_is_valid(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('case = "vsv"\n', encoding="utf-8")
    assert main(["check", str(path)]) == 0
    assert "valid" in capsys.readouterr().out
    assert main(["check", str(path), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert main(["check", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told.pop("estimate").keys() == {"memory_bytes", "processor_time_s"}
    assert told == {"case": str(path), "valid": True, "remarks": []}


def test_check_puts_contact_laws_together(capsys: pytest.CaptureFixture[str]) -> None:
    point = ["--set", "joint.contact=point-johnson", "--set", "contact.damping_factor=kelvin-voigt"]
    assert main(["check", "vsv", *point]) == 2
    assert "contact.damping_factor: kelvin-voigt is not for a point contact" in capsys.readouterr().err


def test_check_takes_the_first_step_when_it_is_asked_to(capsys: pytest.CaptureFixture[str]) -> None:
    heavy = ["check", "vsv", "--set", "loads.air_force_x=1e9 N"]
    assert main(heavy) == 0
    assert main([*heavy, "--deep"]) == 2
    assert "no equilibrium of the trunnion was found" in capsys.readouterr().err
    assert main(["check", "vsv", "--deep"]) == 0
    assert "first step taken" in capsys.readouterr().out


def test_check_and_run_notice_a_solver_that_is_not_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "sksundae.cvode", None)
    for command in ("check", "run"):
        assert main([command, "vsv", "--solver", "cvode"]) == 2
        message = capsys.readouterr().err
        assert "solver.name" in message
        assert "tribodyn[sundials]" in message
    assert not list(tmp_path.iterdir())
    assert main(["check", "vsv"]) == 0
