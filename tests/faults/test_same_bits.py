"""The same case gives the same bits in every process of a machine, but for the one that compiles."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

BEGIN = """
import json, sys
from tribodyn.cases import load_case
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
    numbers(BEGIN + BEFORE + RUN)  # where nothing was compiled, this does it
    assert numbers(BEGIN + RUN) == numbers(BEGIN + BEFORE + RUN)


@pytest.mark.long
def test_a_process_that_compiles_agrees_to_rounding(tmp_path: Path) -> None:
    # Its functions were made one by one, in the cache they are woven into each other: sums round otherwise.
    cache = str(tmp_path)
    first, second, third = (numbers(BEGIN + RUN, NUMBA_CACHE_DIR=cache) for _ in range(3))
    assert second == third
    for name in ("e_x", "e_y", "phi_x", "phi_y", "F_cx", "F_cy", "theta_v"):
        # Errors of the integration itself, with rtol = 1e-3, are thousands of times larger.
        scale = np.abs(second[name]).max()
        np.testing.assert_allclose(first[name], second[name], rtol=0.0, atol=1e-8 * scale, err_msg=name)
