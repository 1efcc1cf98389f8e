import pytest

from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import write_run
from tribodyn.report import ComparedRun, differences, write_comparison
from tribodyn.simulation import simulate

WIDE = 'case = "vsv"\n[joint]\nclearance = "40 um"\n'
NARROW = 'case = "vsv"\n[joint]\nclearance = "20 um"\n'


@pytest.fixture
def runs(make_result):
    one = make_result(0.5, case=NARROW, title="one")
    other = make_result(0.5, case=WIDE, title="<b>other</b>", failure="too <i>small</i>")
    other["F_cx"] = 2.0 * other["F_cx"]
    return [ComparedRun("narrow", one), ComparedRun("<wide>", other, "wide/report.html")]


def test_differences_come_first(runs, tmp_path):
    text = write_comparison(runs, tmp_path / "new" / "page.html").read_text(encoding="utf-8")
    assert text.index("<code>joint.clearance</code>") < text.index("Contact force, mean")
    assert text.index("Contact force, mean") < text.index("Curves over each other")
    assert "20 um" in text
    assert "40 um" in text
    assert "<code>case</code>" not in text


def test_texts_are_escaped_and_runs_linked(runs, tmp_path):
    text = write_comparison(runs, tmp_path / "page.html").read_text(encoding="utf-8")
    page = text[: text.index('id="page-data"')]
    assert "&lt;b&gt;other&lt;/b&gt;" in page
    assert "too &lt;i&gt;small&lt;/i&gt;" in page
    assert '<a href="wide/report.html">&lt;wide&gt;</a>' in page
    assert "<i>" not in page
    assert "<wide>" not in text


def test_changes_are_given_in_percent_of_the_first_run(runs, tmp_path):
    text = write_comparison(runs, tmp_path / "page.html").read_text(encoding="utf-8")
    row = text[text.index("Contact force, mean") :]
    assert '<td class="changed">' in row[: row.index("</tr>")]
    same = text[text.index("Tilt, peak without") :]
    assert "changed" not in same[: same.index("</tr>")]


def test_the_command_writes_it_and_names_equal_directories_apart(make_result, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name in ("a/run", "b/run"):
        write_run(make_result(0.2), tmp_path / name)
    (tmp_path / "a" / "run" / "report.html").write_text("", encoding="utf-8")
    assert main(["compare", "a/run", "b/run", "-o", "both.html"]) == 0
    assert "both.html" in capsys.readouterr().out
    text = (tmp_path / "both.html").read_text(encoding="utf-8")
    assert '<a href="a/run/report.html">a/run</a>' in text
    assert "b/run" in text


def test_the_command_prints_what_differs(runs, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name, run in zip(("narrow", "wide"), runs, strict=True):
        write_run(run.dataset, tmp_path / name)
    assert main(["compare", "narrow", "wide"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["narrow", "wide"]
    assert next(line for line in lines if "joint.clearance" in line).split() == [
        *("joint.clearance", "20", "um", "40", "um")
    ]
    force = next(line for line in lines if line.startswith("Contact force, mean N"))
    assert force.endswith("%)")
    assert "(" not in next(line for line in lines if line.startswith("Tilt, peak without"))
    assert not any("Steps" in line for line in lines)


@pytest.mark.parametrize("arguments", [["out"], ["out", "absent"], ["out", "out", "-o", "."]])
def test_bad_arguments_write_nothing(arguments, make_result, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_run(make_result(0.2), tmp_path / "out")
    assert main(["compare", *arguments]) == 2
    assert "allowed: " in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.fixture(scope="module")
def driven():
    """Return runs from the same start that last differently, and one that goes on from another."""
    case = load_case("vsv-joints").replace({"solver.grid.theta": 24, "solver.grid.z": 4, "solver.rtol": 1e-3})
    runs = [simulate(case.replace({"run.cycles": cycles})) for cycles in (1, 2)]
    return [*runs, simulate(case.replace({"run.cycles": 1, "wear.cycles": 50}))]


def test_different_numbers_of_cycles_are_named_before_the_numbers(driven, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name, run in zip("ab", (driven[0], driven[2]), strict=True):
        write_run(run, tmp_path / name)
    assert main(["compare", "a", "b"]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.endswith("different numbers of drive cycles: 1, 50.")
    page = (tmp_path / "comparison.html").read_text(encoding="utf-8")
    assert page.index("numbers of drive cycles: 1, 50.") < page.index(
        '<table class="compared">', page.index("Results</h2>")
    )


def test_runs_without_reversals_that_last_differently_are_named_so():
    case = load_case("slider-crank")
    found = differences([simulate(case.replace({"run.cycles": cycles})) for cycles in (1, 2)])
    assert found.stretch.endswith("these last differently: 0.012 s, 0.024 s.")


#: Numbers of a mechanism, and how those of its joints begin.
PARTS = {
    "joint_force_max_N": "force_max_N_",
    "joint_force_sustained_N": "force_sustained_N_",
    "peak_pressure_MPa": "peak_pressure_MPa_",
    "offset_max_um": "offset_max_um_",
    "wear_depth_max_nm": "wear_depth_nm_",
    "friction_heat_J": "friction_heat_J_",
}


@pytest.mark.parametrize(("first", "second"), [(0, 1), (1, 2)])
def test_a_whole_is_never_smaller_than_its_part(driven, first, second):
    found = differences([driven[first], driven[second]])
    assert "Numbers of the motion are of" in found.stretch
    for summary in found.summaries:
        for whole, part in PARTS.items():
            parts = [value for name, value in summary.items() if name.startswith(part)]
            assert parts
            assert max(parts) <= summary[whole] * (1.0 + 1e-12), (whole, parts)
