"""A kernel is never older than what it calls, and unchanged sources are never compiled twice."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tribodyn

PROGRAM = """
import json
import numpy as np
from tribodyn.core.tables import ContactTable
from tribodyn.kernels.joints.pressure import node_pressure

table = ContactTable(0.0, 2.0, 1.0, np.ones((3, 4)), np.ones(3), np.ones(32))
pressure = node_pressure(table, 1e-6, 1e-3, 1.0, 0.5e-6, 1e-3, 0.0)[1]
print(json.dumps([pressure, *(sum(count.values()) for count in node_pressure.stats[1:])]))
"""
# Called by node_pressure, which is in another file.
CALLEE = "kernels/lookup.py"
BEFORE = "        cubic(table.cubics, first, x),\n"


def copy(folder: Path) -> Path:
    """Return a folder with a copy of the package, as new as can be."""
    source = Path(tribodyn.__file__).parent
    shutil.copytree(
        source, folder / "tribodyn", ignore=shutil.ignore_patterns("__pycache__"), copy_function=shutil.copy
    )
    return folder


def run(folder: Path, caches: Path) -> tuple[float, int, int]:
    """Return the pressure that a new process finds, and how often it found code and did not."""
    changes = {"PYTHONPATH": str(folder), "XDG_CACHE_HOME": str(caches), "NUMBA_CACHE_DIR": ""}
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, env=os.environ | changes, capture_output=True, text=True, check=True)
    pressure, hits, missed = json.loads(done.stdout)
    return pressure, hits, missed


def test_an_edit_counts_at_once_and_a_copy_compiles_nothing(tmp_path: Path) -> None:
    caches = tmp_path / "caches"
    first = copy(tmp_path / "first")
    before, _, missed = run(first, caches)
    assert missed == 1
    kept = sorted(caches.rglob("*.nb?"))

    assert run(copy(tmp_path / "second"), caches) == (before, 1, 0)
    assert sorted(caches.rglob("*.nb?")) == kept

    callee = first / "tribodyn" / CALLEE
    text = callee.read_text(encoding="utf-8")
    assert text.count(BEFORE) == 1
    callee.write_text(text.replace(BEFORE, BEFORE.replace("cubic", "7.0 * cubic", 1)), encoding="utf-8")
    edited, _, missed = run(first, caches)
    assert edited > 1.5 * before
    assert missed == 1

    # Both are known now, whatever the times of the files say.
    callee.write_text(text, encoding="utf-8")
    assert run(first, caches) == (pytest.approx(before, rel=1e-12), 1, 0)
    assert not list(first.rglob("*.nb?"))
