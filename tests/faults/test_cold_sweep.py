"""A sweep where the equations were never compiled: one worker compiles them, the others read them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SAVED = re.compile(r"\[cache\] data saved to '([^']+)'")
LOADED = re.compile(r"\[cache\] data loaded from '([^']+)'")


@pytest.mark.long
def test_two_workers_compile_nothing_twice(tmp_path: Path) -> None:
    command = [
        *(sys.executable, "-m", "tribodyn", "sweep", "vsv", "--workers", "2", "--summary-only"),
        *("--vary", "joint.clearance=20,25,30,35 um", "--set", "run.duration=20 ms"),
    ]
    # Numba says what each process writes to the cache and reads from it.
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "NUMBA_DEBUG_CACHE": "1"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    saved = SAVED.findall(done.stdout)
    assert len(saved) > 10
    assert len(saved) == len(set(saved))
    # The other worker takes part.
    assert set(LOADED.findall(done.stdout)) & set(saved)
    assert "preparing the workers" in done.stderr
