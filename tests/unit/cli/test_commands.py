"""Small commands: cases, show, check, new, analyses and completion."""

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.commands.completion import SHELLS
from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import built_in, parse_case, template, templates


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


def test_check_takes_the_first_step_when_it_is_asked_to(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tribodyn.mechanisms.balance._MAX_ITERATIONS", 400)  # a tenth: nothing is found
    heavy = ["check", "vsv", "--set", "loads.air_force_x=1e9 N"]
    assert main(heavy) == 0
    assert main([*heavy, "--deep"]) == 2
    assert "no equilibrium of the trunnion was found" in capsys.readouterr().err
    assert main(["check", "vsv", "--deep"]) == 0
    assert "first step taken" in capsys.readouterr().out


def test_check_and_run_notice_a_solver_that_is_not_installed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "sksundae.cvode", None)
    for command in ("check", "run"):
        assert main([command, "vsv", "--solver", "cvode"]) == 2
        message = capsys.readouterr().err
        assert "solver.name" in message
        assert "tribodyn[sundials]" in message
    assert not list(tmp_path.iterdir())
    assert main(["check", "vsv"]) == 0


@pytest.mark.parametrize("analysis", ["static", "kinematic", "vibrations"])
def test_an_analysis_is_stored_as_any_run(analysis, monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    changes = ["--set", "run.positions=6", "--set", "run.output_interval=20 ms"]
    assert main(["run", "four-bar", f"--{analysis}", *changes, "--no-figures"]) == 0
    said = capsys.readouterr().out
    assert f"{analysis.removesuffix('s')} analysis" in said
    assert "Error, rms" in said
    assert "nergy residual" not in said
    folder = tmp_path / f"results-four-bar-{analysis}"
    assert {path.name for path in folder.iterdir()} == {
        "result.nc",
        "summary.json",
        "case.toml",
        "report.html",
    }
    result = td.read(folder)
    assert result.sizes["time"] == 7
    assert ("output_ratio" in result) == (analysis == "kinematic")
    assert ("Frequency at the start" in (folder / "report.html").read_text()) == (analysis == "vibrations")
    assert ("Modes" in said) == (analysis == "vibrations")


def test_a_case_without_analyses_refuses_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "vsv", "--static"]) == 2
    assert "--static: run.analysis" in capsys.readouterr().err


def test_keys_of_an_analysis_are_set_beside_its_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "slider-crank", "--static", "--set", "run.directions=both"]) == 0
    assert main(["check", "slider-crank", "--kinematic", "--set", "run.directions=both"]) == 2
    assert "--set and --kinematic: run.directions" in capsys.readouterr().err


def test_templates_are_listed_one_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new"]) == 0
    lines = capsys.readouterr().out.split("\n\n")[0].splitlines()
    assert [line.split()[0] for line in lines] == list(templates())
    assert main(["new", "--json"]) == 0
    assert set(json.loads(capsys.readouterr().out)) >= {*built_in(), "door-hinge", "vane-ring"}


def test_a_template_becomes_a_file_that_is_never_overwritten(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "slider-crank", "mine.toml"]) == 0
    assert "tribodyn run mine.toml" in capsys.readouterr().out
    assert td.load_case("mine.toml") == td.load_case("slider-crank")
    Path("mine.toml").write_text("# my own\n", encoding="utf-8")
    assert main(["new", "slider-crank", "mine.toml"]) == 2
    assert "exists" in capsys.readouterr().err
    assert Path("mine.toml").read_text(encoding="utf-8") == "# my own\n"
    assert main(["new", "latch"]) == 0
    assert Path("latch.toml").read_text(encoding="utf-8") == template("latch")


def test_an_unknown_template_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "slidercrank"]) == 2
    assert 'did you mean "slider-crank"?' in capsys.readouterr().err


@pytest.mark.parametrize("name", [name for name in templates() if name in built_in()])
def test_cases_without_a_file_of_their_own_are_templates_too(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(template(name), encoding="utf-8")
    assert td.load_case(path) == td.load_case(name)


def test_show_lists_all_keys_of_a_kind(capsys: pytest.CaptureFixture[str]) -> None:
    from tribodyn.cases.keys import keys_of
    from tribodyn.mechanisms.catalogue import kinds

    kind = "mechanism"
    assert main(["show", kind]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert f'case = "{kind}"' in lines
    for key in keys_of(kinds()[kind]).values():
        assert any(line.startswith((f"# {key.name} =", f"{key.name} =")) for line in lines), key.path
    assert main(["show", kind, "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == list(keys_of(kinds()[kind]))


def offered(line: str, tmp_path: Path) -> list[str]:
    """Return what a shell is offered at the end of a line."""
    pytest.importorskip("argcomplete")
    answer = tmp_path / "answer"
    asked = {
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_SHELL": "fish",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": os.fspath(answer),
    }
    subprocess.run([sys.executable, "-m", "tribodyn"], env=os.environ | asked, cwd=tmp_path, check=True)
    return [entry.split("\t")[0].strip() for entry in answer.read_text().splitlines()]


@pytest.mark.parametrize(
    ("line", "some"),
    [
        ("tribodyn sw", {"sweep"}),
        ("tribodyn run vsv --set joint.cl", {"joint.clearance="}),
        ("tribodyn sweep vsv --vary contact.law=", {"contact.law=rsdc", "contact.law=ke"}),
        ("tribodyn run vsv --set wear.feedback=", {"wear.feedback=true", "wear.feedback=false"}),
        ("tribodyn run vsv --no", {"--no-figures", "--no-report"}),
    ],
)
def test_commands_keys_and_values_are_offered(line: str, some: set[str], tmp_path: Path) -> None:
    assert some <= set(offered(line, tmp_path))


@pytest.mark.parametrize("shell", SHELLS)
def test_lines_for_a_shell(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("argcomplete")
    assert main(["completion", shell]) == 0
    assert "tribodyn" in capsys.readouterr().out


def test_a_log_holds_what_was_done_and_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = tmp_path / "work.log"
    assert main(["check", "vsv", "-v", "--log", os.fspath(log)]) == 0
    assert "s in all" in capsys.readouterr().err
    assert main(["check", "vsv", "--set", "joint.clearanc=1", "--log", os.fspath(log)]) == 2
    written = log.read_text(encoding="utf-8")
    assert "vsv: valid" in written
    assert "nearest valid one is joint.clearance" in written
    assert main(["cases", "--log", os.fspath(tmp_path / "none" / "x")]) == 2
