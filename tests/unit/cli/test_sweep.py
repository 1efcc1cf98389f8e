"""``tribodyn sweep`` around a simulation that is made up."""

import json
import os
import signal
import sys
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import tribodyn.figures
import tribodyn.report
from tribodyn.cli.main import main

SWEEP = ["sweep", "vsv", "--workers", "0", "--vary", "joint.clearance=20,25 um"]
ON_TLS = ["--vary", "joint.clearance=20 um", "--scheduler", "tls://127.0.0.1:1"]


@pytest.fixture(autouse=True)
def in_empty_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, simulated: list[Any]) -> Path:
    def draw_all(dataset: xr.Dataset, directory: Path, **_: object) -> None:
        directory.mkdir(exist_ok=True)

    def write(dataset: xr.Dataset, path: Path) -> None:
        path.write_text("made up", encoding="utf-8")

    monkeypatch.setattr(tribodyn.report, "write", write)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tribodyn.report, "draw_all", draw_all)
    return tmp_path


def test_a_sweep_leaves_everything_and_says_where(in_empty_directory, capsys):
    assert main(SWEEP) == 0
    out, err = capsys.readouterr()
    assert sorted(path.name for path in Path("sweep-vsv").iterdir()) == [
        "figures",
        "points",
        "report.html",
        "sweep.json",
        "sweep.nc",
    ]
    assert len(list(Path("sweep-vsv/points").glob("*/report.html"))) == 2
    assert "computing 2 of 2 points" in err
    assert "100 %  2 of 2 points" in err
    rows = [line.split() for line in out.splitlines() if line.startswith("2")]
    assert [row[:3] for row in rows] == [["20", "um", "2"], ["25", "um", "2.5"]]
    assert "everything is in sweep-vsv/" in out


def test_json_is_one_document(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SWEEP, "--json", "--quiet", "-o", "out"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out) == json.loads(Path("out/sweep.json").read_text(encoding="utf-8"))
    assert err == ""


@pytest.mark.parametrize("samples", [[], ["--vary", "joint.radius=uniform(5 mm, 6 mm)", "--samples", "3"]])
def test_a_report_made_again_gives_the_points_as_json(samples, capsys):
    command = ["sweep", "vsv", "--workers", "0", "--vary", "joint.clearance=20,35 um", *samples]
    assert main([*command, "--quiet", "-o", "out"]) == 1
    capsys.readouterr()
    assert main(["report", "out", "--json"]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    record = json.loads(Path("out/sweep.json").read_text(encoding="utf-8"))["points"]
    assert [point["points"] for point in points] == [point["point"] for point in record]
    assert {point["joint.clearance"] for point in points} == {20e-6, 35e-6}
    for ours, theirs in zip(points, record, strict=True):
        assert ours["contact_force_max_N"] == theirs.get("contact_force_max_N")


def test_failed_points_are_in_the_table_and_in_the_status(simulated, capsys):
    command = ["sweep", "vsv", "--workers", "0", "--vary", "joint.clearance=20,35 um"]
    assert main(command) == 1
    out, err = capsys.readouterr()
    assert "no result: stopped at t = 0 s: no equilibrium" in out
    assert "no result at joint.clearance = 35 um" in err
    assert "1 of 2 points have no result" in err
    simulated.clear()
    assert main(command) == 1
    assert simulated == []
    assert main([*command, "--retry"]) == 1
    assert len(simulated) == 1


def test_samples_print_statistics(capsys: pytest.CaptureFixture[str]) -> None:
    vary = ["--vary", "joint.friction_coefficient=uniform(0.1, 0.2)", "--vary", "contact.law=ke,rsdc"]
    assert main(["sweep", "vsv", "--workers", "0", *vary, "--samples", "3"]) == 0
    out = capsys.readouterr().out
    assert out.count("Contact force, peak kN") == 2
    assert "contact.law = ke" in out
    assert "median" in out


def test_a_wide_table_is_cut_to_the_terminal(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "40")
    vary = ["--vary", "joint.friction_coefficient=0.01:0.5:0.01", "--vary", "title=" + "x" * 60]
    assert main(["sweep", "vsv", "--workers", "0", *vary, "--summary-only"]) == 0
    out = capsys.readouterr().out
    assert "... 10 more points" in out
    assert max(map(len, out.splitlines()[3:44])) <= 60


def test_an_interrupt_keeps_what_is_done(simulated, monkeypatch, capsys):
    made_up = tribodyn.simulation.simulate

    def simulate(case: Any, **options: Any) -> xr.Dataset:
        os.kill(os.getpid(), signal.SIGINT)
        return made_up(case, **options)

    monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)
    assert main(SWEEP) == 1
    assert len(list(Path().glob("sweep-vsv/points/*/summary.json"))) == 1
    assert "1 of 2 points have no result" in capsys.readouterr().err
    assert Path("sweep-vsv/report.html").exists()
    # Reports of points would take long.
    assert not list(Path().glob("sweep-vsv/points/*/report.html"))


def test_pictures_that_fail_do_not_lose_the_result(monkeypatch, capsys):
    def draw_all(dataset: xr.Dataset, directory: Path, **_: object) -> None:
        raise ValueError("no colour left")

    monkeypatch.setattr(tribodyn.report, "draw_all", draw_all)
    assert main(SWEEP) == 1
    assert "no colour left" in capsys.readouterr().err
    assert Path("sweep-vsv/sweep.nc").exists()


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (["--vary", "joint.clearance"], "--vary"),
        (["--vary", "joint.clearance=20"], "joint.clearance"),
        (["--vary", "joint.clearance=20,900 um"], "joint.clearance"),
        (["--vary", "joint.clearance=20 um", "--vary", "joint.clearance=30 um"], "joint.clearance"),
        (["--vary", "joint.clearence=20 um"], "joint.clearance"),
        (["--vary", "joint.clearance=normal(20, 2 um)"], "--samples"),
        (["--vary", "joint.clearance=20 um", "--workers", "-1"], "--workers"),
        (["--vary", "joint.clearance=20 um", "--scheduler", "nonsense"], "--scheduler"),
        (["--vary", "joint.clearance=20 um", "-o", "/dev/null/x"], "--output"),
        ([*ON_TLS, "--tls-ca", "ca.pem"], "--tls-cert"),
        ([*ON_TLS, "--tls-cert", "cert.pem"], "--tls-ca"),
        ([*ON_TLS, "--tls-ca", "ca.pem", "--tls-cert", "cert.pem"], "--tls-ca"),
        ([*ON_TLS, "--tls-ca", __file__, "--tls-cert", __file__, "--tls-key", "key.pem"], "--tls-key"),
        ([*ON_TLS, "--tls-ca", __file__, "--tls-cert", __file__], "--scheduler"),
        ([*ON_TLS[:-1], "tcp://127.0.0.1:1", "--tls-ca", __file__, "--tls-cert", __file__], "tls://"),
        ([*ON_TLS[:-2], "--tls-ca", __file__, "--tls-cert", __file__], "--scheduler"),
        (ON_TLS, "certificates"),
    ],
)
def test_bad_input_names_the_key_and_leaves_nothing(options, named, in_empty_directory, simulated, capsys):
    assert main(["sweep", "vsv", "--quiet", *options]) == 2
    message = capsys.readouterr().err
    assert named in message
    assert message.count("\n") == 1
    assert simulated == []
    assert list(in_empty_directory.iterdir()) == []


@pytest.mark.parametrize(
    ("study", "options"),
    [
        ("slopes", ["--vary", "joint.clearance", "--of", "vane_angle_error_max_deg"]),
        ("find", ["--vary", "joint.clearance=20..30 um", "--until", "vane_angle_error_max_deg=0.03"]),
    ],
)
def test_other_studies_know_a_scheduler_as_sweeps_do(study, options, in_empty_directory, simulated, capsys):
    for where, named in (
        (["--scheduler", "nonsense"], "no scheduler answers there"),
        (["--scheduler", "tcp://127.0.0.1:1", "--tls-ca", "ca.pem"], "certificates need both"),
        (["--workers", "-1"], "--workers: given -1"),
    ):
        assert main([study, "vsv", "--quiet", *options, *where]) == 2
        assert named in capsys.readouterr().err
    assert simulated == []
    assert list(in_empty_directory.iterdir()) == []


def test_a_scheduler_without_dask_says_what_to_install(simulated, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["sweep", "vsv", "--vary", "joint.clearance=20 um", "--scheduler", "tcp://127.0.0.1:1"]) == 2
    assert "install tribodyn[cluster]" in capsys.readouterr().err


def test_a_sweep_with_nothing_to_compute_starts_no_process(monkeypatch, capsys):
    assert main([*SWEEP, "-o", "out"]) == 0

    def never(**_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("tribodyn.core.fork_server.start", never)
    assert main([word for word in SWEEP if word not in {"--workers", "0"}] + ["-o", "out"]) == 0
    assert "2 are there already" in capsys.readouterr().err


@pytest.mark.parametrize("options", [[], ["--workers", "two"], ["--workers", "1", "--scheduler", "tcp://x"]])
def test_wrong_options_end_with_status_2(options: list[str]) -> None:
    vary = ["--vary", "joint.clearance=20 um"] if options else []
    assert main(["sweep", "vsv", *vary, *options]) == 2


def test_warnings_of_points_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sweep", "vsv", "--workers", "0", "--vary", "joint.clearance=20,45 um", "--quiet"]) == 0
    assert "warning of 1 of 2 points" in (err := capsys.readouterr().err)
    assert err.endswith(": odd\n")


def test_the_table_shows_what_varies_or_what_is_asked_for() -> None:
    from tribodyn.cli.tables import sweep_in_words

    numbers = {"contact_force_max_N": 5.0, "tilt_max_mrad": 1.0, "steps": 7}
    points = [
        {"changes": {"joint.clearance": f"{c} um"}, "failure": "", **numbers, "tilt_max_mrad": c}
        for c in (20.0, 30.0)
    ]
    record = {"statistics": [], "points": points, "kind": "vsv"}
    heading = " ".join(" ".join(list(sweep_in_words(record))[:-2]).split())
    assert "Tilt" in heading
    assert "force" not in heading
    heading = " ".join(list(sweep_in_words(record, ["steps", "contact_force_max_N"]))[:-2])
    assert heading.index("Steps") < heading.index("Contact")
    assert "Tilt" not in heading


def test_set_and_solver_change_every_point(simulated: list[Any]) -> None:
    assert main([*SWEEP, "--set", "run.duration=0.5 s", "--solver", "radau"]) == 0
    assert {(case.run.duration, case.solver.name) for case in simulated} == {(0.5, "radau")}


def test_a_number_that_nobody_knows_cannot_be_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SWEEP, "-o", "out", "--show", "tilt_max_rad"]) == 2
    assert ": tilt_max_mrad, " in capsys.readouterr().err
