"""Analyses by their options on the command line."""

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import main


@pytest.mark.parametrize("analysis", ["static", "kinematic", "vibrations"])
def test_an_analysis_is_stored_as_any_run(
    analysis: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
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
