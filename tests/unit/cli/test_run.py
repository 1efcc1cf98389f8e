"""``tribodyn run`` and ``report`` around a simulation that is made up."""

import json
import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import tribodyn.figures
import tribodyn.report
import tribodyn.simulation
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.platforms import provenance
from tribodyn.mechanisms.catalogue import load_case, parse_case

ResultFactory = Callable[..., xr.Dataset]


@pytest.fixture
def in_empty_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(autouse=True)
def _quick_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    def draw_all(dataset: xr.Dataset, directory: Path, **_: object) -> None:
        directory.mkdir(exist_ok=True)
        (directory / "motion.png").write_text("new", encoding="utf-8")

    def write(dataset: xr.Dataset, path: Path) -> None:
        path.write_text("new", encoding="utf-8")

    monkeypatch.setattr(tribodyn.report, "draw_all", draw_all, raising=False)
    monkeypatch.setattr(tribodyn.report, "write", write, raising=False)


@pytest.fixture
def simulation(monkeypatch: pytest.MonkeyPatch, make_result: ResultFactory) -> Callable[..., None]:
    """Replace the simulation by one that does ``during`` and returns a made-up result."""

    def install(during: Callable[[Any], str] = lambda stop: "") -> None:
        def simulate(
            case: Any, *, progress: Callable[[float], None], stop: Callable[[], bool], checkpoint: Path
        ) -> xr.Dataset:
            progress(1.0)
            failure = during(stop)
            end = 5.0 if failure else case.duration
            return make_result(end, failure=failure, case=case.to_toml(), title=case.title)

        monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)

    return install


def test_a_run_leaves_everything_and_says_where(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "--set", "joint.clearance=30 um", "--solver", "radau"]) == 0
    directory = in_empty_directory / "results-vsv"
    names = {path.name for path in directory.iterdir()}
    assert names == {"result.nc", "summary.json", "case.toml", "report.html", "figures"}
    expected = load_case("vsv").replace({"joint.clearance": "30 um", "solver.name": "radau"})
    assert parse_case((directory / "case.toml").read_text(encoding="utf-8"), "case.toml") == expected
    captured = capsys.readouterr()
    assert "Vane-angle error, peak without impacts" in captured.out
    assert os.path.join("results-vsv", "report.html") in captured.out


def test_json_is_all_there_is_on_stdout(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    stored = json.loads(Path("results-vsv/summary.json").read_text(encoding="utf-8"))
    assert printed == stored


def test_quiet_prints_warnings_only(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "--quiet"]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert "warning: the friction coefficient" in captured.err


def test_a_run_that_stops_midway_is_saved_and_explained(in_empty_directory, simulation, capsys):
    simulation(lambda stop: "the step size became too small")
    assert main(["run", "vsv"]) == 1
    last = capsys.readouterr().err.splitlines()[-1]
    assert "stopped at t = 5 s of 12.5664 s: the step size became too small" in last
    assert "saved in results-vsv" in last
    assert Path("results-vsv/result.nc").exists()
    assert Path("results-vsv/report.html").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_is_saved(number, in_empty_directory, simulation, capsys):
    def interrupt(stop: Callable[[], bool]) -> str:
        assert not stop()
        os.kill(os.getpid(), number)
        assert stop()
        return "interrupted"

    simulation()
    assert main(["run", "vsv"]) == 0
    simulation(interrupt)
    assert main(["run", "vsv"]) == 1
    assert "interrupted" in capsys.readouterr().err
    assert json.loads(Path("results-vsv/summary.json").read_text(encoding="utf-8"))["status"] == "failed"
    # Drawn anew: what the complete run had drawn would contradict the new result.
    made = Path("results-vsv/result.nc").stat().st_mtime_ns
    for picture in (Path("results-vsv/report.html"), Path("results-vsv/figures/motion.png")):
        assert picture.stat().st_mtime_ns >= made


@pytest.mark.parametrize("asked", [True, False])
def test_a_second_interrupt_or_one_before_the_first_step_aborts_at_once(
    asked: bool,
    in_empty_directory: Path,
    simulation: Callable[..., None],
    capfd: pytest.CaptureFixture[str],
    leaving: None,
) -> None:
    def interrupt(stop: Callable[[], bool]) -> str:
        if asked:
            stop()
            os.kill(os.getpid(), signal.SIGINT)
        # A file on its way goes too.
        (in_empty_directory / "results-vsv" / ".result.nc.1.part").touch()
        os.kill(os.getpid(), signal.SIGINT)
        return "not reached"

    simulation(interrupt)
    with pytest.raises(SystemExit) as left:
        main(["run", "vsv"])
    assert left.value.code == 1
    assert "aborted; nothing was saved" in capfd.readouterr().err
    assert list(in_empty_directory.iterdir()) == []


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (InputError("not installed", key="solver.name"), 2),
        (IntegrationFailure(0.0, "no equilibrium"), 1),
        (ZeroDivisionError("surprise"), 1),
        (MemoryError(), 1),
    ],
)
def test_errors_of_the_simulation_are_one_line(error, status, in_empty_directory, simulation, capsys):
    def fail(stop: Callable[[], bool]) -> str:
        raise error

    simulation(fail)
    assert main(["run", "vsv", "--quiet"]) == status
    message = capsys.readouterr().err
    assert message.startswith("tribodyn: ")
    assert message.count("\n") == 1
    assert list(in_empty_directory.iterdir()) == []
    assert main(["run", "vsv", "--quiet", "--debug"]) == status
    assert "Traceback" in capsys.readouterr().err


def test_pictures_that_fail_do_not_lose_the_result(in_empty_directory, simulation, capsys, monkeypatch):
    def draw_all(dataset: xr.Dataset, directory: Path, **_: object) -> None:
        raise ValueError("no colour left")

    monkeypatch.setattr(tribodyn.report, "draw_all", draw_all)
    simulation()
    assert main(["run", "vsv"]) == 1
    message = capsys.readouterr().err
    assert "no colour left" in message
    assert "tribodyn report results-vsv" in message
    assert "Traceback" not in message
    assert Path("results-vsv/result.nc").exists()


def test_report_draws_stored_results_again(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "-o", "out"]) == 0
    Path("out/report.html").unlink()
    assert main(["report", "out"]) == 0
    assert Path("out/report.html").read_text(encoding="utf-8") == "new"
    assert "report.html" in capsys.readouterr().out


CAMPAIGN = ["run", "vsv", "--set", "wear.cycles=400", "-o", "out"]


@pytest.fixture
def campaign(monkeypatch: pytest.MonkeyPatch, make_campaign: ResultFactory) -> Callable[[str], None]:
    """Replace the simulation by a campaign that keeps a checkpoint and ends with ``failure``."""

    def install(failure: str) -> None:
        def simulate(
            case: Any, *, progress: Callable[[float], None], checkpoint: Path, **_: Any
        ) -> xr.Dataset:
            assert case.campaign_cycles == 400
            progress(400.0)
            checkpoint.write_text("kept", encoding="utf-8")
            made = {"case": case.to_toml(), "title": case.title, **provenance()}
            return make_campaign(3, failure=failure, **made)

        monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)

    return install


def test_a_campaign_counts_cycles_and_leaves_no_checkpoint(in_empty_directory, campaign, capsys):
    campaign("")
    assert main(CAMPAIGN) == 0
    assert not Path("out/checkpoint.npz").exists()
    captured = capsys.readouterr()
    assert "400 of 400 cycles of wear" in captured.err
    assert "going on" not in captured.err
    summary = json.loads(Path("out/summary.json").read_text(encoding="utf-8"))
    assert summary["wear_cycles"] == 2000
    assert isinstance(summary["wear_cycles"], int)


def test_a_campaign_that_stopped_keeps_its_checkpoint_and_goes_on(in_empty_directory, campaign, capsys):
    campaign("interrupted")
    assert main(CAMPAIGN) == 1
    assert Path("out/checkpoint.npz").exists()
    message = capsys.readouterr().err.splitlines()[-1]
    assert "stopped after 2000 of 400 cycles: interrupted" in message
    assert "saved in out; the same command continues from there" in message
    campaign("")
    assert main(CAMPAIGN) == 0
    assert "going on with the wear campaign kept in" in capsys.readouterr().err
    assert not Path("out/checkpoint.npz").exists()


def test_a_finished_campaign_is_not_computed_again(in_empty_directory, campaign, capsys):
    campaign("")
    assert main(CAMPAIGN) == 0
    first = capsys.readouterr().out
    campaign("it was computed again")
    assert main(CAMPAIGN) == 0
    captured = capsys.readouterr()
    assert captured.out == first
    assert "kept in out; --force computes it again" in captured.err
    assert main([*CAMPAIGN, "--set", "wear.depth_limit=1 um", "--force"]) == 1
    campaign("")
    assert main([*CAMPAIGN, "--force"]) == 0
    assert "cycles of wear" in capsys.readouterr().err


def test_a_finished_result_of_another_case_is_spared(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "-o", "out"]) == 0
    assert main(["run", "vsv", "-o", "out"]) == 0
    before = (in_empty_directory / "out" / "result.nc").read_bytes()
    wider = ["run", "vsv", "-o", "out", "--set", "joint.clearance=40 um"]
    assert main(wider) == 2
    assert "another case" in capsys.readouterr().err
    assert (in_empty_directory / "out" / "result.nc").read_bytes() == before
    assert main([*wider, "--force"]) == 0
    assert 'clearance = "40 um"' in (in_empty_directory / "out" / "case.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("value", ["'40 um'", '"40 um"', "40 um", " '40um' "])
def test_quotes_left_around_a_value_are_taken_off(value, in_empty_directory, simulation):
    simulation()
    assert main(["run", "vsv", "-o", "out", "--set", f"joint.clearance={value}"]) == 0
    assert 'clearance = "40 um"' in (in_empty_directory / "out" / "case.toml").read_text(encoding="utf-8")


def test_figures_and_report_can_be_left_out(in_empty_directory, simulation, capsys):
    simulation()
    assert main(["run", "vsv", "-o", "out", "--no-figures", "--no-report"]) == 0
    assert {path.name for path in Path("out").iterdir()} == {"result.nc", "summary.json", "case.toml"}
    out, err = capsys.readouterr()
    assert "drawing" not in err
    assert "look at out/result.nc" in out
    assert main(["run", "vsv", "-o", "out", "--no-figures"]) == 0
    assert not Path("out/figures").exists()
    assert Path("out/report.html").exists()


def test_results_are_replaced(in_empty_directory: Path, simulation: Callable[..., None]) -> None:
    simulation()
    assert main(["run", "vsv", "-o", "out"]) == 0
    Path("out/notes.txt").write_text("mine", encoding="utf-8")
    assert main(["run", "vsv", "-o", "out", "--set", "joint.clearance=40 um", "--force"]) == 0
    assert 'clearance = "40 um"' in Path("out/case.toml").read_text(encoding="utf-8")
    assert Path("out/notes.txt").read_text(encoding="utf-8") == "mine"


def test_what_is_left_of_a_failed_run_is_overwritten(
    in_empty_directory: Path, simulation: Callable[..., None]
) -> None:
    simulation(lambda stop: "it stopped")
    assert main(["run", "vsv", "-o", "out"]) == 1
    simulation()
    assert main(["run", "vsv", "-o", "out", "--set", "joint.clearance=40 um"]) == 0


@pytest.mark.parametrize("processors", [1, 2])
def test_two_processes_share_the_figures_and_one_makes_up_for_the_other(
    processors: int, in_empty_directory: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from tribodyn.cli import pictures

    monkeypatch.setattr("tribodyn.core.platforms.processors", lambda: processors)
    here = os.getpid()

    def draw_all(dataset: xr.Dataset, directory: Path, part: slice) -> None:
        if part.start == 1 and processors == 2 and os.getpid() != here:
            raise MemoryError
        for name in list("abcde")[part]:
            (directory / name).touch()

    monkeypatch.setattr(tribodyn.report, "draw_all", draw_all)
    Path("figures").mkdir()
    pictures.draw(xr.Dataset(), in_empty_directory, page=False)
    assert sorted(path.name for path in Path("figures").iterdir()) == list("abcde")


def test_numbers_of_parts_are_one_table_for_each_kind_and_rows_without_any_are_left_out():
    from tribodyn.cli.tables import in_words

    numbers = {
        f"{name}_{joint}": 1.5 for joint in ("pin", "rail") for name in ("force_mean_N", "drive_force_max_N")
    }
    given = {"kind": "mechanism", "joint_force_max_N": 2.0, **numbers, "wear_depth_nm_pin": 3.0, "steps": 7}
    lines = [line.strip() for line in in_words(given)]
    assert [line.split()[0] for line in lines if line.startswith(("Joints", "Drive"))] == ["Joints", "Drive"]
    assert lines[0].startswith("Force in a joint")
    assert lines[-1].split() == ["Steps", "7"]
    assert sum(line.startswith("rail") for line in lines) == 2
    alone = [line.strip() for line in in_words({"kind": "mechanism", "wear_depth_nm_pin": 3.0})]
    assert not any(line.startswith("rail") for line in alone)
