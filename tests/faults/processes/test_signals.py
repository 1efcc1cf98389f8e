"""SIGINT and SIGTERM at random moments of every command: the promise is kept.

The process ends soon, with status 1, or 0 where all was done already; it prints no traceback; what stands in
its folder is whole, and of a run that was under way complete with figures and report.
"""

from __future__ import annotations

import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np
import psutil
import pytest
import xarray as xr

from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import read

SOON = 30.0  #: Time within which a process ends after the signal [s], without what it waits for a processor.
#: Processor time until which a command is left alone; a run is certainly under way by then [s].
LONGEST = 8.0
PARTS, SIGNALS = 14, 15  #: The long campaign: parts, and signals in each.
WEAR = ["run.output_interval=50 ms", "wear.specific_wear_rate=1.1e-12 m^2/N", "wear.cycles=400"]


@dataclass(frozen=True)
class Command:
    """A command: what follows ``tribodyn``, and what is set in its environment."""

    words: list[str]
    environment: dict[str, str] = field(default_factory=dict)


def settings(*texts: str) -> list[str]:
    return [word for text in texts for word in ("--set", text)]


#: A run of a journal in oil that would take hours, each step many milliseconds.
ENDLESS = settings(
    "run.duration=50 s",
    "run.output_interval=5 ms",
    "joints.bearing.film.grid.theta=360",
    "joints.bearing.film.grid.z=64",
)
SWEEP = ["sweep", "vsv", "--vary", "joint.clearance=20:38:3 um", *settings("run.duration=0.3 s")]
COMMANDS = {
    "run": Command(["run", "vsv", "-o", "out"]),
    "endless": Command(["run", "journal-oil", *ENDLESS, "-o", "out"]),
    "radau": Command(["run", "journal-oil", "--solver", "radau", *ENDLESS, "-o", "out"]),
    "cvode": Command(["run", "vsv", "--solver", "cvode", *settings("run.cycles=40"), "-o", "out"]),
    "wear": Command(["run", "vsv", *settings(*WEAR), "-o", "out"]),
    "sweep": Command([*SWEEP, "--workers", "2", "-o", "out"]),
    "sweep here": Command([*SWEEP, "--workers", "0", "-o", "out"]),
    "report": Command(["report", "made"]),
    "reproduce": Command(["reproduce", "fig8", "fig19", "-o", "out"]),
    "surface": Command(["surface", "profile.csv", "--unit", "um", "--spacing", "0.5 um", "-o", "out"]),
    "bounce": Command(["bounce", "vsv"]),
    "check": Command(["check", "journal-oil", "--deep"]),
    "show": Command(["show", "vsv"]),
    "cases": Command(["cases"]),
}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], None]:
    """Return what puts into a folder the files that commands read: a stored result and a profile."""
    kept = tmp_path_factory.mktemp("inputs")
    short = [sys.executable, "-m", "tribodyn", "run", "vsv", *settings("run.duration=0.1 s"), "-o", "made"]
    subprocess.run(short, cwd=kept, check=True, capture_output=True)
    heights = np.random.default_rng(1).normal(size=4000)
    np.savetxt(kept / "profile.csv", heights, delimiter=",")
    return lambda folder: subprocess.run(["cp", "-r", f"{kept}/.", str(folder)], check=True)


def begun(command: Command, folder: Path, *, silent: bool = False) -> subprocess.Popen[str]:
    """Start a command and wait until it hears signals: before, Python itself answers them."""
    process = subprocess.Popen(
        [sys.executable, "-m", "tribodyn", *command.words],
        cwd=folder,
        env={**os.environ, **command.environment},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL if silent else subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 600.0
    while not hears(process.pid) and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.005)
    return process


def hears(pid: int) -> bool:
    """Tell whether a process has a handler for SIGTERM."""
    try:
        status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    except OSError:
        return False
    caught = re.search(r"^SigCgt:\s*([0-9a-f]+)$", status, re.MULTILINE)
    return caught is not None and bool(int(caught[1], 16) >> (signal.SIGTERM - 1) & 1)


def spent(session: int) -> float:
    """Return the processor time of a session [s]: how far it is, however busy the machine."""
    times = [process.cpu_times() for process in members(session)]
    return float(sum(sum(time[:4]) for time in times))


def members(session: int) -> list[psutil.Process]:
    """Return the processes of a session that have not ended."""
    found = []
    for pid in psutil.pids():
        with suppress(OSError, psutil.Error):
            if os.getsid(pid) == session and (one := psutil.Process(pid)).status() != psutil.STATUS_ZOMBIE:
                found.append(one)
    return found


def goes_on(process: subprocess.Popen[str], until: float) -> bool:
    """Wait until a session has spent a processor time; False if its command ends before."""
    while process.poll() is None:
        with suppress(psutil.Error):
            if spent(process.pid) >= until:
                return True
        time.sleep(0.03)
    return False


def stopped(
    command: Command, folder: Path, moment: float, number: signal.Signals, everyone: bool
) -> tuple[int, str, float]:
    """Send a signal at a moment; return status, what was said on stderr, and how long it took to end [s]."""
    process = begun(command, folder)
    alive, sent = goes_on(process, moment), time.monotonic()
    if alive:
        # To the whole session, as Ctrl-C on a terminal does, or to the command alone.
        with suppress(ProcessLookupError):
            (os.killpg if everyone else os.kill)(process.pid, number)
    try:
        said, took = ended(process, sent)
    finally:
        process.kill()
    assert no_one_left(process.pid), "processes that the command had started go on"
    return process.returncode, said, took if alive else 0.0


def ended(process: subprocess.Popen[str], sent: float) -> tuple[str, float]:
    """Wait for a process to end; return what it said on stderr, and its time since the signal [s]."""
    before = waited = waiting(process.pid)
    while (took := time.monotonic() - sent - (waited - before)) < SOON:
        with suppress(subprocess.TimeoutExpired):
            return process.communicate(timeout=0.1)[1], took
        waited = max(waited, waiting(process.pid))
    raise AssertionError(f"it goes on {took:.1f} s after the signal")


def waiting(pid: int) -> float:
    """Return how long a process was ready and had no processor [s], which is not its fault."""
    try:
        return int(Path(f"/proc/{pid}/schedstat").read_text(encoding="ascii").split()[1]) / 1e9
    except OSError:
        return 0.0


def no_one_left(session: int) -> bool:
    """Wait until nothing of a session runs; False if something goes on."""
    deadline = time.monotonic() + SOON
    while left := members(session):
        if time.monotonic() > deadline:
            for process in left:
                process.kill()
            return False
        time.sleep(0.05)
    return True


@pytest.fixture(scope="module")
def lasts(inputs: Callable[[Path], None], tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], float]:
    """Return what tells the processor time of a command that is left alone, or :data:`LONGEST`."""

    @cache
    def measured(name: str) -> float:
        folder = tmp_path_factory.mktemp("alone")
        inputs(folder)
        process, reached = begun(COMMANDS[name], folder, silent=True), 0.0
        while process.poll() is None and reached < LONGEST:
            with suppress(psutil.Error):
                reached = max(reached, spent(process.pid))
            time.sleep(0.1)
        for left in members(process.pid):
            with suppress(psutil.Error):
                left.kill()
        process.wait()
        return reached

    return measured


def assert_whole(folder: Path) -> None:
    """Assert that every file is whole, and that no temporary one was left."""
    ends = {".png": b"IEND\xaeB`\x82", ".pdf": b"%%EOF", ".html": b"</html>"}
    for path in (path for path in folder.rglob("*") if path.is_file()):
        content = path.read_bytes()
        if path.suffix == ".nc" and path.name.startswith("fig"):
            xr.load_dataset(path).close()  # the data of a figure, not a result
        elif path.suffix == ".nc":
            read(path)
        elif path.suffix == ".json":
            json.loads(content)
        elif path.name == "case.toml":
            parse_case(content.decode(), path.name)
        elif path.suffix == ".npz":
            np.load(path).close()
        elif path.suffix in ends:
            assert content.rstrip(b"\n").endswith(ends[path.suffix]), path
        assert path.suffix != ".part", path


def assert_kept(command: Command, folder: Path, status: int, said: str) -> None:
    """Assert the promise after a signal."""
    assert status in (0, 1), said
    for word in ("Traceback", "Exception ignored", "internal error", "Error:"):
        assert word not in said, said
    out = folder / "out"
    assert_whole(out)
    result = out / "result.nc"
    if "nothing was saved" in said:
        assert status == 1
        assert not result.exists()
        assert command.words[0] != "run" or not out.exists() or "checkpoint.npz" in os.listdir(out)
    elif command.words[0] == "run" and "interrupted while drawing" not in said:
        assert result.exists(), said
        assert "while saving" in said or (out / "report.html").exists(), said
        if status == 1 and "while saving" not in said and "everything is in" not in said:
            assert "interrupted" in read(result).attrs["failure"], said


def disturb(
    name: str, moment: float, chance: random.Random, inputs: Callable[[Path], None], folder: Path
) -> None:
    """Start a command, stop it at a moment and look at what is left."""
    folder.mkdir()
    inputs(folder)
    number, everyone = chance.choice([signal.SIGINT, signal.SIGTERM]), chance.random() < 0.5
    print(f"{name}: {number.name} to {'all' if everyone else 'one'} at {moment:.3f} s", end="", flush=True)
    status, said, took = stopped(COMMANDS[name], folder, moment, number, everyone)
    print(f": status {status} in {took:.2f} s", flush=True)
    assert_kept(COMMANDS[name], folder, status, said)


def test_a_run_of_hours_ends_at_once_and_whole(tmp_path: Path) -> None:
    disturb("endless", 2.5, random.Random(16), lambda _: None, tmp_path / "here")
    assert (tmp_path / "here" / "out" / "report.html").exists()


# In parts, each a test: a campaign of minutes shows how far it is.
@pytest.mark.long(minutes=4)
@pytest.mark.parametrize("part", range(PARTS))
def test_signals_at_random_moments_of_all_commands(part, inputs, lasts, tmp_path):
    chance, names = random.Random(part), list(COMMANDS)
    for turn in range(SIGNALS):
        name = names[(part * SIGNALS + turn) % len(names)]
        disturb(name, chance.uniform(0.0, lasts(name)), chance, inputs, tmp_path / str(turn))
