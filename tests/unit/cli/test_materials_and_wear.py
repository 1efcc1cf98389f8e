"""What is printed of surfaces that nobody chose, and of wear as an interval."""

import html
import json
import math
import re
import sys
from importlib.resources import files
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.cli.tables import in_words
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.mechanisms.results import known, summarise
from tribodyn.report.comparison import differences
from tribodyn.report.page import render
from tribodyn.workbench.work import shown

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


def test_it_is_in_check_run_report_and_summary(tmp_path, capsys, monkeypatch):
    assert main(["check", "slider-crank"]) == 0
    assert capsys.readouterr().out.count(NOTE) == 1
    changes = ["--set", "run.cycles=1", "--set", "wear.depth_limit=10 um"]
    assert main(["run", "slider-crank", *changes, "--no-figures", "-o", str(tmp_path / "out")]) == 0
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


WEAR = re.compile(r"(partner_)?wear_(depth|rate)_|worn_volume_|(wear|bore|shaft|error)_life_cycles")
INTERVAL = re.compile(r"[\d.]+(?: × 10\S+)? to [\d.]+(?: × 10\S+)?")
CASES = {
    "slider-crank": {"run.cycles": 1, "wear.depth_limit": "10 um", "wear.partner_wear_rate": "1e-16 m^2/N"},
    "slider-crank-oil": {"run.cycles": 1, "wear.depth_limit": "10 um"},
    "vsv": {"run.cycles": 1, "wear.depth_limit": "5 um", "mechanism.formulation": "exact"},
    "vsv-free": {"run.cycles": 1, "wear.depth_limit": "5 um"},
}
CAMPAIGN = {**CASES["slider-crank"], "wear.cycles": 10}
RUNS = {**{name: (name, changes) for name, changes in CASES.items()}, "campaign": ("slider-crank", CAMPAIGN)}


@pytest.mark.parametrize("name", RUNS)
def test_wear_is_printed_as_an_interval_everywhere(name: str, tmp_path: Path) -> None:
    case, changes = RUNS[name]
    run = td.simulate(td.load_case(case).replace(changes))
    summary = summarise(run)
    names = {one for one in known(summary, str(summary["kind"])) if WEAR.match(one)}
    assert any("life" in one for one in names)
    assert names == set(summary["intervals"])
    for one in names:
        low, high = summary["intervals"][one]
        assert low <= 0.1 * summary[one] or "life" in one
        assert high >= 1.7 * summary[one]
    # Terminal: whole and joints; report; comparison; page of the workbench; table of the accessor.
    numbers = known(summary, str(summary["kind"]))
    lines = list(in_words(summary))
    for one in names:
        if not numbers[one].part:
            (line,) = [
                line for line in lines if line.strip().startswith(f"{numbers[one].label_in(summary)}  ")
            ]
            assert INTERVAL.search(line)
    page = html.unescape(render(run, (), tmp_path))
    for one in names:
        if not numbers[one].part:
            row = page[page.index(f'<th scope="row">{numbers[one].label_in(summary)}</th>') :]
            assert INTERVAL.search(row[: row.index("</td>")])
    cells = [
        cell for group in differences([run, run]).groups for row in group["rows"] for cell in row["cells"]
    ]
    assert sum(bool(INTERVAL.fullmatch(cell["value"])) for cell in cells) >= 2 * len(names) - 2
    assert set(shown(run)["intervals"]) == names
    table = run.tribodyn.numbers
    assert set(table.index[table["low"].notna()]) == names


def test_joints_have_cells_with_intervals() -> None:
    run = td.simulate(td.load_case("slider-crank").replace(CASES["slider-crank"]))
    summary = summarise(run)
    row = [line for line in in_words(summary) if line.strip().startswith("wrist")]
    assert sum(len(INTERVAL.findall(line)) for line in row) == sum(
        name.endswith("_wrist") for name in summary["intervals"]
    )


def test_a_case_whose_repeats_are_given_has_their_interval() -> None:
    changes = {**CASES["slider-crank"], "wear.repeats": "[1, 2, 4]"}
    summary = summarise(td.simulate(td.load_case("slider-crank").replace(changes)))
    low, high = summary["intervals"]["wear_life_cycles"]
    factor = math.exp(4.302653 * math.log(2.0) * math.sqrt(4.0 / 3.0))
    assert summary["wear_life_cycles"] / low == pytest.approx(factor, rel=1e-3)
    assert high / summary["wear_life_cycles"] == pytest.approx(factor, rel=1e-3)


def test_sweeps_and_searches_print_intervals(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    common = ["slider-crank", "--set", "run.cycles=1", "--set", "wear.depth_limit=10 um"]
    vary = "joints.wrist.clearance.radial=20 um, 40 um"
    how = ["--workers", "0", "--summary-only", "--no-figures", "--show", "wear_life_cycles"]
    assert main(["sweep", *common, "--vary", vary, "-o", str(tmp_path / "sweep"), *how]) == 0
    assert len(INTERVAL.findall(capsys.readouterr().out)) >= 2
    points = json.loads((tmp_path / "sweep" / "sweep.json").read_text())["points"]
    assert all("wear_life_cycles" in point["intervals"] for point in points)
