"""Nobody chose a material: one note in check, run, report and summary; wear rates and lives are grey."""

import json
import re
import sys
from importlib.resources import files
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.cli.tables import in_words
from tribodyn.mechanisms.catalogue import load_case, parse_case

NOTE = "Nobody chose a material"
CHOICES = (
    {"surfaces.bushing.material": "ptfe-liner"},
    {"surfaces.bushing.young_modulus": "3 GPa"},
    {"surfaces.bushing.hardness": "100 MPa"},
)


def notes(name: str, changes: dict[str, str]) -> list[str]:
    return [note for note in load_case(name).replace(changes).remarks().notes if NOTE in note]


@pytest.mark.parametrize("name", ["slider-crank", "journal-dry"])
def test_the_note_stays_until_somebody_chooses(name: str) -> None:
    assert len(notes(name, {})) == 1
    assert "surfaces.bushing.material" in notes(name, {})[0]
    for choice in CHOICES:
        assert notes(name, choice) == []


def test_a_mechanism_of_the_paper_has_its_surfaces() -> None:
    assert notes("vsv", {}) == []


@pytest.mark.parametrize(
    ("changes", "joints"),
    [
        ({}, ("wrist",)),
        ({"surfaces.bushing.material": "ptfe-liner"}, ()),
        ({"wear.specific_wear_rate": "1e-15 m^2/N"}, ()),
        # The library knows no wear rate of bronze: that of the paper's liner stays.
        ({"surfaces.bushing.material": "bronze-c93200"}, ("wrist",)),
        ({"surfaces.bushing.young_modulus": "3 GPa"}, ("wrist",)),
    ],
)
def test_joints_whose_wear_rate_nobody_chose(changes: dict[str, str], joints: tuple[str, ...]) -> None:
    assert load_case("slider-crank").replace(changes).assumed_wear() == joints


def test_each_pair_is_asked_for_its_own() -> None:
    text = (files("tribodyn.mechanism.built_in") / "slider-crank.toml").read_text(encoding="utf-8")
    text += '\n[pairs.dry.surfaces.bushing]\nmaterial = "ptfe-liner"\n'
    case = parse_case(text, "test").replace({"joints.wrist.clearance.pair": "dry"})
    assert case.assumed_wear() == ()
    assert [note for note in case.remarks().notes if NOTE in note] == []
    assert parse_case(text, "test").assumed_wear() == ("wrist",)


def test_it_is_in_check_run_report_and_summary(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["check", "slider-crank"]) == 0
    assert capsys.readouterr().out.count(NOTE) == 1
    changes = ["--set", "run.cycles=1", "--set", "wear.depth_limit=10 um"]
    assert main(["run", "slider-crank", *changes, "-o", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().out.count(NOTE) == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert sum(NOTE in note for note in summary["notes"]) == 1
    grey = {
        *("wear_depth_rate_nm_per_1000_cycles", "wear_life_cycles", "wear_life_factor"),
        *("wear_rate_nm_per_1000_cycles_wrist", "wear_life_cycles_wrist"),
    }
    assert set(summary["assumed"]) == grey
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert NOTE in page
    assert len(re.findall(r'<t?d[^>]*class="[^"]*assumed', page)) >= len(grey)

    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.delenv("NO_COLOR", raising=False)
    lines = list(in_words(summary))
    assert [line for line in lines if "\x1b[2m" in line and "Wear rate" in line]
    assert not [line for line in lines if "\x1b[2m" in line and "Force in a joint" in line]
    chosen = [*changes, "--set", "wear.specific_wear_rate=1e-15 m^2/N", "--no-figures"]
    assert main(["run", "slider-crank", *chosen, "-o", str(tmp_path / "b")]) == 0
    assert json.loads((tmp_path / "b" / "summary.json").read_text(encoding="utf-8"))["assumed"] == []
