"""A package registers a mechanism, a falling disc, by an entry point; every command then knows it."""

import json
import math
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS

HERE = Path(__file__).parent


def register(place: Path, entries: Mapping[str, str]) -> None:
    """Write what remains of an installed package that has these entry points."""
    about = place / "falling_disc-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: falling-disc\nVersion: 1.0\n")
    lines = [f"{name} = {value}" for name, value in entries.items()]
    (about / "entry_points.txt").write_text("\n".join(["[tribodyn.mechanisms]", *lines]))


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a package of another name, as installed, that holds the disc."""
    place = tmp_path_factory.mktemp("package")
    shutil.copytree(HERE / "disc", place / "falling_disc", ignore=shutil.ignore_patterns("__pycache__"))
    register(place, {"disc": "falling_disc.descriptor:MECHANISM"})
    return place


def test_the_reduced_model_of_the_paper_is_registered_the_same_way() -> None:
    assert MECHANISMS["vsv"].folder == "tribodyn.papers.cheng_2022.reduced"


def test_a_built_in_case_imports_the_mechanism_of_its_own_kind_alone_and_neither_pint_nor_xarray() -> None:
    script = "import sys, tribodyn; tribodyn.load_case('vsv'); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    imported = set(done.stdout.split())
    assert "tribodyn.papers.cheng_2022.reduced.case" in imported
    assert not imported & {"tribodyn.mechanism", "scipy.optimize", "pint", "xarray"}


def test_one_that_is_wrong_is_left_out_with_the_reason(tmp_path: Path) -> None:
    shutil.copytree(HERE / "disc", tmp_path / "falling_disc")
    wrong = {
        "absent": "falling_disc.nowhere:MECHANISM",
        "none": "falling_disc.case:DiscCase",
        "taken": "tribodyn.mechanism.descriptor:MECHANISM",
    }
    register(tmp_path, wrong)
    done = subprocess.run(
        [sys.executable, "-c", "from tribodyn.mechanisms.catalogue import MECHANISMS; print(*MECHANISMS)"],
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == list(MECHANISMS)
    assert "No module named 'falling_disc.nowhere'" in done.stderr
    assert "it is no MechanismDescriptor" in done.stderr
    assert "there is a mechanism 'mechanism' already" in done.stderr


COMMANDS = [
    ["cases"],
    ["show", "disc"],
    ["check", "disc", "--set", "disc.mass=0.2 kg"],
    ["run", "disc", "-o", "one", "--quiet"],
    ["run", "disc", "--set", "disc.mass=0.2 kg", "-o", "two", "--quiet", "--no-figures", "--no-report"],
    ["compare", "one", "two", "-o", "both.html"],
    ["sweep", "disc", "--vary", "disc.height=10 um,20 um", "--workers", "0", "-o", "swept", "--quiet"],
    ["report", "swept"],
]
ALL = (
    "import json, sys; from tribodyn.cli.main import main; sys.exit(max(map(main, json.loads(sys.argv[1]))))"
)


@pytest.fixture(
    scope="module",
    # Its kernels as Python, which is the same source, or compiled with the solver around them.
    params=[pytest.param("1", id="plain"), pytest.param("0", id="compiled", marks=pytest.mark.long)],
)
def said(request: pytest.FixtureRequest, package: Path) -> str:
    """Return what all commands, given in one process, print."""
    done = subprocess.run(
        [sys.executable, "-c", ALL, json.dumps(COMMANDS)],
        cwd=package,
        env=os.environ | {"PYTHONPATH": str(package), "NUMBA_DISABLE_JIT": request.param},
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
