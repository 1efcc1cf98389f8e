"""A developer can step through the kernels with a debugger."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

SCRIPT = """
from tribodyn import simulate
from tribodyn.mechanisms.catalogue import load_case

# Few nodes, and a law with few integrals.
small = {"solver.grid.theta": 12, "solver.grid.z": 2, "contact.law": "gw"}
case = load_case("vsv").replace(small | {"run.duration": "0.02 ms", "run.output_interval": "0.01 ms"})
print(float(simulate(case)["F_cx"][-1]))
"""


def force(disabled: str) -> float:
    """Return the contact force at the end of a short run [N]."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": disabled}
    done = subprocess.run([sys.executable, "-c", SCRIPT], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


def test_a_run_without_compilation_is_the_same() -> None:
    # To the rounding of elementary functions, which NumPy evaluates otherwise.
    assert force("1") == pytest.approx(force("0"), rel=1e-9)
