"""A mechanism is one folder and one line: a falling disc is added to a copy, and every command knows it."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tribodyn
from mebdf.compiled.cache import folder
from tribodyn.kernels.jit import SOURCES

HERE = Path(__file__).parent
SOURCE = Path(tribodyn.__file__).parent


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a copy of the package to which the disc was added."""
    place = tmp_path_factory.mktemp("package")
    copy = place / "tribodyn"
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(HERE / "disc", copy / "mechanisms" / "disc")
    catalogue = copy / "mechanisms" / "catalogue.py"
    text = catalogue.read_text(encoding="utf-8")
    catalogue.write_text(text.replace('    "journal",\n', '    "journal",\n    "disc",\n'), encoding="utf-8")
    return place


COMMANDS = [
    ["cases"],
    ["show", "disc"],
    ["check", "disc", "--set", "disc.mass=0.2 kg"],
    ["run", "disc", "-o", "one", "--quiet"],
    ["run", "disc", "--set", "disc.mass=0.2 kg", "-o", "two", "--quiet"],
    ["compare", "one", "two", "-o", "both.html"],
    ["sweep", "disc", "--vary", "disc.height=10 um,20 um", "--workers", "0", "-o", "swept", "--quiet"],
    ["report", "swept"],
]
ALL = (
    "import json, sys; from tribodyn.cli.main import main; sys.exit(max(map(main, json.loads(sys.argv[1]))))"
)


@pytest.fixture(scope="module")
def machine_code(package: Path) -> Path:
    """Return a place with a copy of the machine code: types of the disc mean nothing to other processes."""
    place = package / "cache"
    known = folder(SOURCES)
    if known is not None:
        shutil.copytree(known, place / "tribodyn" / known.name)
    for path in (place, place / "tribodyn"):
        path.mkdir(exist_ok=True)
        path.chmod(0o700)
    return place


@pytest.fixture(scope="module")
def said(package: Path, machine_code: Path) -> str:
    """Return what all commands, given in one process, print."""
    done = subprocess.run(
        [sys.executable, "-c", ALL, json.dumps(COMMANDS)],
        cwd=package,
        env=os.environ | {"PYTHONPATH": str(package), "NUMBA_CACHE_DIR": str(machine_code)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def numbers(folder: Path) -> dict[str, float]:
    found: dict[str, float] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return found


def test_its_cases_and_keys_are_known(said: str) -> None:
    assert "a disc that falls on an elastic floor" in said
    assert "stiffness of the floor" in said


def test_it_runs_and_has_figures_and_a_report(package: Path, said: str) -> None:
    # Energy at the deepest: m g (h + d) = k d²/2, and the floor bears k d.
    weight, stiffness, height = 0.981, 1e7, 20e-6
    deepest = (weight + math.sqrt(weight**2 + 2.0 * stiffness * weight * height)) / stiffness
    found = numbers(package / "one")
    assert found["kind"] == "disc"
    assert found["floor_force_max_N"] == pytest.approx(stiffness * deepest, rel=0.02)  # rows 50 µs apart
    assert (package / "one" / "figures" / "height.png").exists()
    assert "Height of the disc" in (package / "one" / "report.html").read_text(encoding="utf-8")


def test_it_is_compared_and_swept(package: Path, said: str) -> None:
    assert "Force of the floor, largest" in (package / "both.html").read_text(encoding="utf-8")
    page = (package / "swept" / "report.html").read_text(encoding="utf-8")
    assert "Curves over each other" in page
