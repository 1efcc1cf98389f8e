"""Studies on a Dask scheduler and workers that were started on their own and are known by an address."""

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest
from distributed import Security

from tribodyn.mechanism.descriptor import TEMPLATES

SWEEP = [
    *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "--summary-only", "--quiet", "--json"),
    *("--vary", "joint.clearance=20,30 um", "--vary", "mechanism.formulation=exact,paper"),
    *("--set", "run.duration=50 ms"),
]
EFFORT = {"wall_time_s", "real_time_factor"}
KEY, NUMBER = "joints.wrist.clearance.radial", "error_rms_um_slider"
CRANK = ("slider-crank", "--set", "run.duration=20 ms", "--set", "run.output_interval=2 ms")
#: All that computes many cases and keeps them.
STUDIES = {
    "slopes": (*CRANK, "--vary", KEY, "--of", NUMBER),
    "contributions": (*CRANK, "--no-figures"),
    "allocate": (
        *(*CRANK, "--limit", f"{NUMBER}=17.5", "--probability", "0.9"),
        *("--cost", "costs.toml", "--samples", "6"),
    ),
    "builds": (
        *("ring.toml", "--copies", "6", "--draws", "100", "--coupled", "2", "--no-figures"),
        *("--set", "run.duration=0.1 s", "--set", "run.output_interval=20 ms"),
    ),
}
COSTS = f'[wrist]\nkey = "{KEY}"\nwidths = {{"4 um" = 1, "2 um" = 2}}\n'

pytestmark = pytest.mark.long


def dask(*arguments: str, folder: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "dask", *arguments]
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, cwd=folder, stdout=quiet, stderr=quiet)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a process with its children, by their numbers."""
    family = [*psutil.Process(process.pid).children(recursive=True), psutil.Process(process.pid)]
    for member in family:
        member.kill()
    process.wait()


@contextmanager
def started(folder: Path, *options: str) -> Iterator[str]:
    """Start a scheduler and two workers; give the address."""
    about = folder / "scheduler.json"
    file = ("--scheduler-file", str(about))
    local = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    processes = [dask("scheduler", *local, *file, *options, folder=folder)]
    try:
        deadline = time.monotonic() + 120.0
        while not about.exists():
            assert time.monotonic() < deadline, "the scheduler did not start"
            time.sleep(0.1)
        found = str(json.loads(about.read_text(encoding="utf-8"))["address"])
        workers = ("--nworkers", "2", "--nthreads", "1", "--no-dashboard")
        processes.append(dask("worker", found, *workers, *options, folder=folder))
        yield found
    finally:
        for process in processes:
            end(process)


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Return the address of a scheduler with two workers."""
    with started(tmp_path) as found:
        yield found


def certificates(folder: Path) -> list[str]:
    """Write keys of their own into a folder; return the options with which Dask and tribodyn take them."""
    made = Security.temporary()
    contents = {"ca": made.tls_ca_file, "cert": made.tls_scheduler_cert, "key": made.tls_scheduler_key}
    folder.mkdir()
    for name, content in contents.items():
        (folder / f"{name}.pem").write_text(content, encoding="utf-8")
    return [word for name in contents for word in (f"--tls-{name}", str(folder / f"{name}.pem"))]


def rows(*options: str, folder: Path) -> list[dict[str, object]]:
    done = subprocess.run([*SWEEP, *options], cwd=folder, capture_output=True, text=True, check=True)
    points: list[dict[str, object]] = json.loads(done.stdout)["points"]
    return [{name: value for name, value in row.items() if name not in EFFORT} for row in points]


def test_the_same_sweep_gives_the_same_numbers_on_a_cluster(address: str, tmp_path: Path) -> None:
    there = rows("--scheduler", address, "-o", "there", folder=tmp_path)
    here = rows("--workers", "1", "-o", "here", folder=tmp_path)
    assert there == here
    # Results travel: only the client writes, and where it was told.
    assert {path.name for path in tmp_path.iterdir() if path.is_dir()} >= {"there", "here"}
    assert (tmp_path / "there" / "points.jsonl").read_text(encoding="utf-8").count("\n") == len(there)


@pytest.mark.long(minutes=3)
def test_all_studies_give_the_same_numbers_on_a_cluster(address: str, tmp_path: Path) -> None:
    (tmp_path / "costs.toml").write_text(COSTS, encoding="utf-8")
    rigid = TEMPLATES["vsv-ring"].text.replace('elastic = "beam"\n', "")
    (tmp_path / "ring.toml").write_text(rigid, encoding="utf-8")
    for name, options in STUDIES.items():
        command = [sys.executable, "-m", "tribodyn", name, *options, "--quiet", "--json"]
        there, here = (
            subprocess.run([*command, *where], cwd=tmp_path, capture_output=True, text=True, check=True)
            for where in (["--scheduler", address, "-o", f"{name}-there"], ["--workers", "0", "-o", name])
        )
        found, expected = (json.loads(one.stdout) for one in (there, here))
        assert str(found).replace(f"{name}-there", name) == str(expected)
        assert (tmp_path / f"{name}-there").is_dir()


def test_a_scheduler_that_goes_away_loses_no_point_that_had_finished(address: str, tmp_path: Path) -> None:
    # Long enough that one of the points is still under way when the scheduler is gone.
    options = ["--set", "run.duration=3 s", "--scheduler", address, "-o", "there"]
    command = [word for word in SWEEP if word not in {"--quiet", "--json"}]
    sweep = subprocess.Popen([*command, *options], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    assert sweep.stderr is not None
    while "1 of 4 points" not in (line := sweep.stderr.readline()):
        assert line
    port = int(address.rpartition(":")[2])
    scheduler = next(
        process
        for process in psutil.Process().children(recursive=True)
        if any(c.laddr.port == port and c.status == "LISTEN" for c in process.net_connections("tcp"))
    )
    scheduler.kill()
    _, err = sweep.communicate(timeout=120)
    assert sweep.returncode == 1
    assert "scheduler is gone" in err
    assert "Traceback" not in err
    lines = tmp_path / "there" / "points.jsonl"
    before = lines.read_text(encoding="utf-8").splitlines()
    assert 1 <= len(before) < 4
    assert (tmp_path / "there" / "sweep.nc").exists()
    # The same command goes on, here or on another cluster.
    again = [*command, *options[:2], "--workers", "1", "-o", "there"]
    done = subprocess.run(again, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert f"computing {4 - len(before)} of 4 points" in done.stderr
    assert lines.read_text(encoding="utf-8").splitlines()[: len(before)] == before


def test_an_encrypted_cluster_takes_only_who_has_its_certificates(tmp_path: Path) -> None:
    ours, others = (certificates(tmp_path / name) for name in ("ours", "others"))
    dask_says = ["--tls-ca-file" if word == "--tls-ca" else word for word in ours]
    with started(tmp_path, *dask_says) as address:
        assert address.startswith("tls://")
        to_it = ["--scheduler", address, "-o", "there"]
        for strange in ([], others):
            refused = subprocess.run([*SWEEP, *to_it, *strange], cwd=tmp_path, capture_output=True, text=True)
            assert refused.returncode == 2
            assert "no scheduler answers" in refused.stderr
            assert refused.stderr.count("\n") == 1
        assert len(rows(*to_it, *ours, folder=tmp_path)) == 4
