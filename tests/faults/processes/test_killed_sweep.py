"""Sweeps of real processes whose workers are killed, which are killed themselves, or told to stop."""

import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
import xarray as xr

from tribodyn.mechanisms.results import read

POINTS = 7
#: Kills of a part of the campaign, and when a part, or one sweep in it, counts as one that hangs [s].
KILLS, LONGEST = 10, 1800.0
# The seconds of a point are those in which it can be killed.
SWEEP = [
    *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "-o", "out", "--workers", "2", "--summary-only"),
    *("--vary", "joint.clearance=20:38:3 um", "--set", "run.duration=0.3 s"),
]


def started(folder: Path, *more: str) -> subprocess.Popen[str]:
    # A session of its own: a signal to the group reaches the workers too, as Ctrl-C on a terminal does.
    command = [*SWEEP, *more]
    return subprocess.Popen(command, cwd=folder, stderr=subprocess.PIPE, text=True, start_new_session=True)


def wait_for(process: subprocess.Popen[str], text: str) -> None:
    assert process.stderr is not None
    while text not in (line := process.stderr.readline()):
        assert line, f"the sweep ended before it said {text!r}"


def workers(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Return the workers: what the fork server has forked, or what was spawned where there is none."""
    children = psutil.Process(process.pid).children(recursive=True)
    servers = {child.pid for child in children if child.ppid() == process.pid and says(child, "forkserver")}
    return [child for child in children if child.ppid() in servers or says(child, "spawn_main")]


def says(process: psutil.Process, text: str) -> bool:
    return any(text in word for word in process.cmdline())


def finished(folder: Path) -> dict[str, str]:
    """Return the line of each finished point, with the time that it took, by name."""
    file = folder / "out" / "points.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    return {json.loads(line)["point"]: line for line in lines if line.endswith("}}")}


def assert_whole(folder: Path, before: dict[str, str]) -> None:
    """Run the sweep again: it keeps what was there, and ends with all points."""
    again = subprocess.run([*SWEEP, "--no-figures"], cwd=folder, capture_output=True, text=True, check=True)
    assert f"computing {POINTS - len(before)} of {POINTS} points" in again.stderr
    after = finished(folder)
    assert len(after) == POINTS
    assert {name: after[name] for name in before} == before
    assert np.isfinite(read(folder / "out" / "sweep.nc")["contact_force_max_N"]).all()


def test_killing_a_worker_and_then_the_sweep_loses_and_repeats_nothing(tmp_path: Path) -> None:
    process = started(tmp_path, "--no-figures")
    wait_for(process, "10 %")
    victim, *_ = workers(process)
    victim.kill()
    # The sweep goes on, with the other worker and one in the place of the victim.
    wait_for(process, "40 %")
    left = workers(process)
    process.kill()
    process.communicate()
    # Workers whose sweep is gone end by themselves.
    assert psutil.wait_procs(left, timeout=300)[1] == []
    before = finished(tmp_path)
    assert 3 <= len(before) < POINTS
    assert not (tmp_path / "out" / "sweep.nc").exists()
    assert_whole(tmp_path, before)


@pytest.mark.long
def test_a_sweep_without_room_on_the_disk_goes_on_when_there_is_some(tmp_path: Path) -> None:
    command = [
        *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "--workers", "0", "-o", "out"),
        *("--vary", "joint.clearance=20,30 um", "--set", "run.duration=0.1 s"),
    ]

    def no_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, preexec_fn=no_room)
    assert done.returncode == 1
    assert "tribodyn: writing or reading failed: " in done.stderr
    assert "Traceback" not in done.stderr
    assert finished(tmp_path) == {}
    assert not list(tmp_path.rglob("*.nc"))
    # Without whole results there is less to draw, and the reports of points are no matter here.
    subprocess.run([*command, "--summary-only"], cwd=tmp_path, capture_output=True, check=True)
    assert len(finished(tmp_path)) == 2


@pytest.mark.parametrize(
    ("limit", "status", "told"),
    [
        (20, 2, r"--workers: the limit of open files"),
        pytest.param(29, 0, r"\(`ulimit -n`\) allows [12] of 3 workers", marks=pytest.mark.long),
    ],
)
def test_a_sweep_short_of_handles_has_fewer_workers_or_says_so(limit, status, told, tmp_path):
    command = [
        *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "--workers", "3", "--summary-only"),
        *("--vary", "joint.clearance=20,24,28 um", "--set", "run.duration=20 ms"),
    ]

    def few_handles() -> None:
        resource.setrlimit(resource.RLIMIT_NOFILE, (limit, limit))

    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, preexec_fn=few_handles)
    assert done.returncode == status, done.stderr
    assert re.search(told, done.stderr)
    assert len(done.stderr.splitlines()) < 10
    assert not (status and list(tmp_path.iterdir())), "nothing is written after bad input"


def killed(process: subprocess.Popen[str], after: float) -> bool:
    """Kill a sweep after a while, as a power cut would, and wait for its workers; False if it was over."""
    print(f"to be killed {after:.4f} s after its start")  # which pytest shows where a test fails
    try:
        process.communicate(timeout=after)
    except subprocess.TimeoutExpired:
        left = psutil.Process(process.pid).children(recursive=True)
        process.kill()
        process.communicate()
        assert psutil.wait_procs(left, timeout=300)[1] == []
        return True
    assert process.returncode == 0
    return False


def assert_nothing_torn(folder: Path) -> None:
    """Assert that what has the name of a result is a whole one."""
    for path in folder.rglob("*.json"):
        assert json.loads(path.read_text(encoding="utf-8"))
    for path in folder.rglob("*.nc"):
        assert read(path).attrs["kind"] == "sweep"


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> tuple[xr.Dataset, float]:
    """Return the result of a sweep that is left alone, and how long it took [s]."""
    folder = tmp_path_factory.mktemp("undisturbed")
    began = time.monotonic()
    assert not killed(started(folder), LONGEST)
    return read(folder / "out" / "sweep.nc"), time.monotonic() - began


def goes_on(folder: Path, alone: xr.Dataset, after: float) -> bool:
    """Start a sweep or go on with it, kill it after a while, and look at what is there; False at its end."""
    folder.mkdir(exist_ok=True)
    before = finished(folder)
    goes_on = killed(started(folder), after)
    assert before.items() <= finished(folder).items()
    assert_nothing_torn(folder)
    if not goes_on:
        effort = ["wall_time_s", "real_time_factor"]
        found = read(folder / "out" / "sweep.nc")
        xr.testing.assert_equal(found.drop_vars(effort), alone.drop_vars(effort))
    return goes_on


# In parts, each a test: a campaign of minutes shows how far it is, and can be taken up by -k.
@pytest.mark.long
@pytest.mark.parametrize("part", range(5))
def test_a_sweep_killed_at_fifty_moments(part, undisturbed, tmp_path):
    # At any moment of its life: while its workers start, compute, points are kept, merged, drawn.
    alone, lasts = undisturbed
    chance, deadline = random.Random(part), time.monotonic() + LONGEST
    kills = rounds = 0
    while kills < KILLS:
        assert time.monotonic() < deadline, f"{kills} of {KILLS} kills in {LONGEST:g} s"
        if goes_on(tmp_path / str(rounds), alone, chance.uniform(0.0, lasts)):
            kills += 1
        else:
            rounds += 1  # the next one begins anew
    assert not goes_on(tmp_path / str(rounds), alone, LONGEST)


@pytest.mark.long
def test_an_interrupted_sweep_saves_what_it_has(tmp_path: Path) -> None:
    process = started(tmp_path)
    wait_for(process, "20 %")
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=600)
    assert process.returncode == 1
    assert "points have no result" in err
    assert "Traceback" not in err
    before = finished(tmp_path)
    merged = read(tmp_path / "out" / "sweep.nc")
    assert np.isfinite(merged["contact_force_max_N"]).sum() == len(before) < POINTS
    assert merged.attrs["points_failed"] == POINTS - len(before)
    assert_whole(tmp_path, before)
