"""The same case gives the same bits in every process of a machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

BEGIN = """
import json, sys
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate
"""
BEFORE = """
simulate(load_case("journal-oil").replace({"run.duration": "0.5 ms"}))
"""
RUN = """
result = simulate(load_case("vsv").replace({"run.duration": "20 ms", "run.output_interval": "1 ms"}))
json.dump({name: result[name].values.tolist() for name in result.data_vars}, sys.stdout)
"""


def numbers(script: str, **environment: str) -> dict[str, object]:
    """Return all numbers of a run in a process of its own; as text they read back exactly."""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=os.environ | environment)
    found: dict[str, object] = json.loads(done.stdout)
    return found


def test_what_a_process_did_before_changes_no_bit() -> None:
    assert numbers(BEGIN + RUN) == numbers(BEGIN + BEFORE + RUN)


@pytest.mark.long
def test_the_first_run_of_all_is_the_second_to_the_bit(tmp_path: Path) -> None:
    first = numbers(BEGIN + RUN, NUMBA_CACHE_DIR=str(tmp_path))
    assert any(tmp_path.rglob("*.nbc"))
    assert numbers(BEGIN + RUN, NUMBA_CACHE_DIR=str(tmp_path)) == first
