"""A real run that is told to stop: what was computed is saved, status 1, and it reads back."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.mechanisms.results import read


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.long)])
def test_a_stopped_run_saves_what_it_has(number: signal.Signals, tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "tribodyn",
        "run",
        "vsv",
        "--set",
        "run.cycles=4",
        "--no-figures",
        "-o",
        "out",
    ]
    process = subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=tmp_path
    )
    assert process.stderr is not None
    # The first line of progress: the run is under way, and has far to go.
    while " 10 %" not in (line := process.stderr.readline()):
        assert line, "the run ended before it could be stopped"
    process.send_signal(number)
    out, err = process.communicate(timeout=600)
    assert process.returncode == 1
    assert "the run stopped at t = " in err
    assert "saved in out" in err
    assert "Traceback" not in err
    assert "Contact force" in out
    result = read(tmp_path / "out")
    assert result.attrs["failure"]
    assert 0.0 < float(result["time"][-1]) < 4 * 2 * 3.2
