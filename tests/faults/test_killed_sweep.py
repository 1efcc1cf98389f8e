"""Sweeps of real processes whose workers are killed, which are killed themselves, or told to stop."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import cloudpickle
import numpy as np
import psutil
import pytest

from tribodyn.cases import load_case
from tribodyn.results import read
from tribodyn.studies import make_plan, runners
from tribodyn.studies.work import Outcome

POINTS = 7
# The seconds of a point are those in which it can be killed.
SWEEP = [
    *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "-o", "out", "--workers", "2", "--summary-only"),
    *("--vary", "joint.clearance=20:38:3 um", "--set", "run.duration=0.3 s"),
]


def started(folder: Path) -> subprocess.Popen[str]:
    # A session of its own: a signal to the group reaches the workers too, as Ctrl-C on a terminal does.
    return subprocess.Popen(SWEEP, cwd=folder, stderr=subprocess.PIPE, text=True, start_new_session=True)


def wait_for(process: subprocess.Popen[str], text: str) -> None:
    assert process.stderr is not None
    while text not in (line := process.stderr.readline()):
        assert line, f"the sweep ended before it said {text!r}"


def workers(process: subprocess.Popen[str]) -> list[psutil.Process]:
    children = psutil.Process(process.pid).children(recursive=True)
    return [child for child in children if any("spawn_main" in word for word in child.cmdline())]


def finished(folder: Path) -> dict[str, int]:
    """Return when each finished point was written, by name."""
    return {path.parent.name: path.stat().st_mtime_ns for path in folder.glob("out/points/*/summary.json")}


def assert_whole(folder: Path, before: dict[str, int]) -> None:
    """Run the sweep again: it keeps what was there, and ends with all points."""
    again = subprocess.run(SWEEP, cwd=folder, capture_output=True, text=True, check=True)
    assert f"computing {POINTS - len(before)} of {POINTS} points" in again.stderr
    after = finished(folder)
    assert len(after) == POINTS
    assert {name: after[name] for name in before} == before
    assert np.isfinite(read(folder / "out" / "sweep.nc")["contact_force_max_N"]).all()


def test_killing_a_worker_and_then_the_sweep_loses_and_repeats_nothing(tmp_path: Path) -> None:
    process = started(tmp_path)
    wait_for(process, "10 %")
    victim, *_ = workers(process)
    victim.kill()
    # The sweep goes on, with the other worker and one in the place of the victim.
    wait_for(process, "40 %")
    left = workers(process)
    process.kill()
    process.communicate()
    # Workers whose sweep is gone end by themselves.
    assert psutil.wait_procs(left, timeout=20)[1] == []
    before = finished(tmp_path)
    assert 3 <= len(before) < POINTS
    assert not (tmp_path / "out" / "sweep.nc").exists()
    assert_whole(tmp_path, before)


@pytest.mark.long
def test_an_interrupted_sweep_saves_what_it_has(tmp_path: Path) -> None:
    process = started(tmp_path)
    wait_for(process, "20 %")
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=180)
    assert process.returncode == 1
    assert "points have no result" in err
    assert "Traceback" not in err
    before = finished(tmp_path)
    merged = read(tmp_path / "out" / "sweep.nc")
    assert np.isfinite(merged["contact_force_max_N"]).sum() == len(before) < POINTS
    assert merged.attrs["points_failed"] == POINTS - len(before)
    assert_whole(tmp_path, before)


def deadly(toml: str, made_by: str, keep_result: bool) -> Outcome:
    """Stand for a point that no worker survives."""
    if 'clearance = "30 um"' in toml:
        os.kill(os.getpid(), signal.SIGKILL)
    return Outcome({"status": "complete", "failure": ""})


@pytest.mark.long
def test_a_point_that_kills_its_workers_has_no_result_and_the_rest_go_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Workers cannot import this module, so its functions are sent as they are.
    cloudpickle.register_pickle_by_value(sys.modules[__name__])
    monkeypatch.setattr(runners, "compute", deadly)
    plan = make_plan(load_case("vsv"), {"joint.clearance": "20,30,40 um"})
    found = {
        point.changes["joint.clearance"]: outcome
        for point, outcome in runners.local(runners.Job(plan.points, False, lambda: False, print), 2)
    }
    assert found["20 um"].failure == found["40 um"].failure == ""
    assert "worker process died" in found["30 um"].failure
    assert not found["30 um"].final
