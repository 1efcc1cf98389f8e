"""Modules and settings files that somebody has put into the working directory: no command reads one."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.cli.main import BAD_INPUT, COMMANDS, DONE

NEEDED = {
    "matplotlib",
    "mebdf",
    "numba",
    "numpy",
    "pandas",
    "pydantic",
    "scipy",
    "tornado",
    "tribodyn",
    "xarray",
}
#: Names of planted modules: all of Python, and what tribodyn is made of and needs.
NAMES = {*sys.stdlib_module_names, *NEEDED}
#: Commands that start helper processes: each is run by itself. The others, and what is refused, share one.
HELPED = {"run", "sweep", "find", "validate"}
SHORT = ("vsv", "--set", "run.duration=2 ms", "--set", "run.output_interval=1 ms", "--quiet")
VARIED = (*SHORT, "--vary", "joint.clearance=20:30:10 um", "--workers", "2", "--summary-only", "--no-figures")
FOUND = (*SHORT, "--vary", "joint.clearance=10..60um", "--until", "vane_angle_error_max_deg=0.03")
#: Commands that come to their end.
DONE_BY = {
    "run": ("run", *SHORT),
    "cases": ("cases",),
    "show": ("show", "vsv"),
    "new": ("new", "slider-crank"),
    "check": ("check", "vsv"),
    "sweep": ("sweep", *VARIED),
    "find": ("find", *FOUND, "--within", "30", "--workers", "2"),
    "materials": ("materials",),
    "completion": ("completion", "bash"),
    "validate": ("validate", "dry_liners", "-o", "planted-validation"),
}
#: Commands with arguments that they refuse.
REFUSED_BY = {
    "sweep": ("sweep", "vsv", "--vary", "nothing=1:2:1", "--workers", "2"),
    "find": ("find", "vsv", *FOUND[-4:], "--workers", "-1"),
    "workbench": ("workbench", "vsv", "--port", "-1"),
    "report": ("report", "missing"),
    "export": ("export", "missing", "--csv", "forces"),
    "bounce": ("bounce", "vsv", "--law", "nothing"),
    "compare": ("compare", "missing", "missing"),
    "stribeck": ("stribeck", "missing"),
    "reproduce": ("reproduce", "missing"),
    "surface": ("surface", "missing.csv"),
    "contributions": ("contributions", "vsv"),
    "builds": ("builds", "vsv"),
    "slopes": ("slopes", "vsv", "--vary", "nothing", "--of", "tilt_max_mrad"),
    "allocate": (
        "allocate",
        "vsv",
        "--limit",
        "tilt_max_mrad=2",
        "--probability",
        "0.9",
        "--cost",
        "missing",
    ),
    "fit": ("fit", "vsv", "--data", "missing.csv", "--vary", "joint.clearance=1..2"),
}

SETTINGS = {".numba_config.yaml": "{"}  #: Settings files that end the process which reads them.
#: Names under which other packages could look for settings; whoever opens such a pipe waits for ever.
NEVER_OPENED = (
    *("matplotlibrc", ".matplotlibrc", ".ncrc", ".dodsrc", ".daprc", ".netrc", "dask.yaml", "fonts.conf"),
    *("default_en.txt", "constants_en.txt", "pint.toml", "fontlist.json", "pyproject.toml", ".condarc"),
)

#: Runs commands in one process, as the installed script does one.
ONE_AFTER_ANOTHER = """
import json, sys
from tribodyn.__main__ import main
if __name__ == "__main__":
    for status, given in json.loads(sys.argv.pop()):
        sys.argv[1:] = given
        if main() != status:
            sys.exit(f"{given} did not end with {status}")
"""


@pytest.fixture(scope="module")
def planted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of modules, each of which notes that it was imported in a file beside the folder."""
    folder = tmp_path_factory.mktemp("planted")
    for name in NAMES:
        (folder / f"{name}.py").write_text(f"print(__name__, file=open({str(_log(folder))!r}, 'a'))\n")
    for name, content in SETTINGS.items():
        (folder / name).write_text(content)
    for name in NEVER_OPENED:
        os.mkfifo(folder / name)
    return folder


def _log(folder: Path) -> Path:
    return folder.with_suffix(".log")


@pytest.fixture(scope="module")
def script(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Return the command as it is installed: a script, in whose folder Python looks for modules first."""
    path = tmp_path_factory.mktemp("bin") / "tribodyn"
    path.write_text(
        "import sys\nfrom tribodyn.__main__ import main\nif __name__ == '__main__':\n    sys.exit(main())\n"
    )
    return [sys.executable, str(path)]


def imported(command: list[str], folder: Path) -> tuple[int, set[str]]:
    """Run a command until all its helpers have ended; return its status and the planted modules that ran."""
    log = _log(folder)
    log.unlink(missing_ok=True)
    # The end of its output comes when no process holds it any more.
    done = subprocess.run(command, cwd=folder, capture_output=True, timeout=600)
    return done.returncode, set(log.read_text().split()) if log.exists() else set()


def test_a_planted_module_is_noted(planted: Path) -> None:
    assert imported([sys.executable, "-c", "import numpy"], planted)[1] >= {"numpy"}


@pytest.mark.parametrize("arguments", [pytest.param(DONE_BY[name], id=name) for name in sorted(HELPED)])
def test_no_command_imports_from_the_working_directory(arguments, planted, script):
    assert imported([*script, *arguments], planted) == (DONE, set())


def test_commands_without_helpers_import_nothing_from_there(planted: Path, tmp_path: Path) -> None:
    tried = [
        *((DONE, given) for name, given in DONE_BY.items() if name not in HELPED),
        *((BAD_INPUT, given) for given in REFUSED_BY.values()),
    ]
    script = tmp_path / "tribodyn"
    script.write_text(ONE_AFTER_ANOTHER)
    status, found = imported([sys.executable, str(script), json.dumps(tried)], planted)
    assert (status, found) == (DONE, set())


def test_every_command_is_tried() -> None:
    assert {*DONE_BY, *REFUSED_BY} == {*COMMANDS}
