"""The package by itself: nothing of tribodyn is needed, and the examples of its README run."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

import mebdf
import tribodyn.integrate

ROOT = Path(__file__).parents[3]
PACKAGE = ROOT / "packages" / "mebdf"
README = PACKAGE / "README.md"
ALONE = """
import sys

sys.modules["tribodyn"] = None  # importing it fails
"""
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)


def run(script: str) -> str:
    """Run a script in a process that cannot import tribodyn; return what it prints."""
    done = subprocess.run([sys.executable, "-c", ALONE + script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_examples_of_the_readme_run_without_tribodyn() -> None:
    blocks = BLOCK.findall(README.read_text(encoding="utf-8"))
    check = "assert solution.success\nprint(*solution.y[:, -1])\n"
    ends = [
        [float(number) for number in line.split()] for line in run(check.join([*blocks, ""])).splitlines()
    ]
    oscillator, reactions, circuit, pendulum, damper, compiled, decays, ball, rod, _ = ends
    # IVP Test Set (Mazzia and Magherini), problem VDPOL, whose time is in units of 1000.
    assert abs(oscillator[0] - 1.706167732170469) < 1e-4
    assert abs(sum(reactions) - 1.0) < 1e-6
    assert circuit[0] < circuit[1] < 3.0
    assert abs(pendulum[0] ** 2 + pendulum[1] ** 2 - 1.0) < 1e-5
    assert abs(damper[1]) < 1.0
    np.testing.assert_allclose(compiled, oscillator, rtol=1e-5)
    np.testing.assert_allclose(decays, [np.exp(-2.0), 0.0], atol=1e-6)
    assert abs(ball[0]) < 1e-8
    np.testing.assert_allclose(rod, 1.0 - np.arange(1, 201) / 201, atol=1e-5)


def test_the_import_is_cheap() -> None:
    assert run("import mebdf\nprint('numba' in sys.modules or 'scipy' in sys.modules)").strip() == "False"


def test_every_package_of_the_source_is_in_the_wheel() -> None:
    for root in (ROOT, PACKAGE):
        project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
        packages = project["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
        there = [path.parent for path in (root / "src").glob("*/__init__.py")]
        assert packages == [str(path.relative_to(root)) for path in there]
        assert all((path / "py.typed").is_file() for path in there)


def test_tribodyn_needs_this_version() -> None:
    whole, solver = (
        tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        for root in (ROOT, PACKAGE)
    )
    assert f"mebdf=={solver['version']}" in whole["dependencies"]


def test_tribodyn_has_the_same_class() -> None:
    assert tribodyn.integrate.MEBDF is mebdf.MEBDF
