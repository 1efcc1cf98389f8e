"""Numbers of a run whose energy balance misses too much are marked wherever they are shown."""

import json
from collections.abc import Callable

import pytest
import xarray as xr

from tribodyn.accessor import Accessor
from tribodyn.cli.main import main
from tribodyn.cli.tables import in_words, sweep_in_words
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import summarise, write_run
from tribodyn.report import ComparedRun, write, write_comparison
from tribodyn.report.page import render
from tribodyn.results.summary import DOUBTFUL
from tribodyn.studies import Sampling, make_plan
from tribodyn.studies.archive import merge
from tribodyn.workbench.work import shown

REASON = "the energy balance misses 6 %"


def colour_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.delenv("NO_COLOR", raising=False)


@pytest.mark.parametrize(
    ("missed", "doubtful"), [(0.0, False), (DOUBTFUL, False), (1.01 * DOUBTFUL, True), (float("nan"), True)]
)
def test_the_flag_is_set_beyond_five_percent(make_result, missed, doubtful, tmp_path):
    result = make_result().assign_attrs(energy_residual=missed)
    summary = summarise(result)
    assert bool(summary["doubtful"]) is doubtful
    assert shown(result)["doubtful"] == summary["doubtful"]
    lines = list(in_words(summary))
    assert ("Do not use these numbers: the energy balance misses" in lines[0]) is doubtful
    write_run(result, tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text())["doubtful"] == summary["doubtful"]
    page = render(result, (), tmp_path)
    assert ('<section id="numbers" class="doubtful">' in page) is doubtful
    assert ("Do not use these numbers: the energy balance misses" in page) is doubtful


def test_a_terminal_shows_doubtful_numbers_grey(make_result, monkeypatch):
    colour_the_terminal(monkeypatch)
    summary = summarise(make_result().assign_attrs(energy_residual=0.06))
    first, *numbers = in_words(summary)
    assert numbers
    assert "\x1b" not in first
    assert all(line.startswith("\x1b[2m") and line.endswith("\x1b[0m") for line in numbers)
    monkeypatch.setenv("NO_COLOR", "1")
    assert not any("\x1b" in line for line in in_words(summary))


def test_a_notebook_shows_doubtful_numbers_grey(make_result: Callable[..., xr.Dataset]) -> None:
    table = Accessor(make_result().assign_attrs(energy_residual=0.06))._repr_html_()
    assert f"Do not use these numbers: {REASON}." in table
    assert "<table style='color:gray'>" in table
    assert "color:gray" not in Accessor(make_result())._repr_html_()


def test_a_comparison_marks_the_run_whose_numbers_are_doubtful(make_result, tmp_path, monkeypatch, capsys):
    results = {name: make_result(energy_residual=missed) for name, missed in (("good", 0.0), ("bad", 0.06))}
    page = write_comparison(
        [ComparedRun(*one) for one in results.items()], tmp_path / "page.html"
    ).read_text()
    assert page.count(f"<div>Do not use these numbers: {REASON}.</div>") == 1
    rows = [row for row in page.split("<tr>") if "Tilt, peak without" in row]
    assert rows[0].count("<td") == 2
    assert rows[0].count('<td class="doubtful">') == 1
    monkeypatch.chdir(tmp_path)
    for name, result in results.items():
        write_run(result, tmp_path / name)
    monkeypatch.setenv("COLUMNS", "200")
    colour_the_terminal(monkeypatch)
    assert main(["compare", "good", "bad"]) == 0
    shown_lines = capsys.readouterr().out.splitlines()
    assert f"Do not use the numbers of bad: {REASON}." in shown_lines
    tilt = next(line for line in shown_lines if line.startswith("Tilt, peak without"))
    assert tilt.count("\x1b[2m") == 1
    assert tilt.endswith("\x1b[0m")


def test_a_sweep_marks_the_points_whose_numbers_are_doubtful(tmp_path, monkeypatch):
    colour_the_terminal(monkeypatch)
    plan = make_plan(load_case("vsv"), {"joint.clearance": "20,30 um"}, Sampling())
    found = {
        point.name: {"failure": "", "doubtful": doubtful, "contact_force_max_N": value}
        for point, doubtful, value in zip(plan.points, ("", REASON), (5.0, 6.0), strict=True)
    }
    page = write(merge(plan, found), tmp_path).read_text()
    good, bad = page.split('<tr id="p-')[1:]
    assert 'class="doubtful"' not in good
    assert bad.split("</tr>")[0].count('class="doubtful"') == 1
    assert bad.count(f'class="quiet">Do not use these numbers: {REASON}.<') == 1
    points = [{"changes": dict(point.changes), **found[point.name]} for point in plan.points]
    *_, good, bad, caution = sweep_in_words({"statistics": [], "points": points, "kind": "vsv"})
    assert caution == f"Do not use the numbers at joint.clearance = 30 um: {REASON}."
    assert "\x1b" not in good
    assert "\x1b[2m" in bad
