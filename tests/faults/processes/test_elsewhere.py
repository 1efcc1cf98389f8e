"""Commands as on Windows and macOS: the same numbers as here, whatever those systems lack.

Nothing here runs on another system. A hook (``elsewhere/sitecustomize.py``) takes from Python what they do
not have, in the command and in the processes that it starts.
"""

import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
import xarray as xr
from tests.unit.cli.test_workbench import asked

from tribodyn.cli.main import main
from tribodyn.core import platforms

HOOK = Path(__file__).parents[1] / "elsewhere"
SOURCES = Path(platforms.__file__).parents[1]
LONG = 300.0  #: Longest that a command may take on a busy machine [s].
SHORT = ("slider-crank", "--set", "run.duration=20 ms")
RADIAL = "joints.wrist.clearance.radial"
FITTED = ("--vary", f"{RADIAL}=20..40um", "--data", "run.csv")
SWEPT = ("--vary", f"{RADIAL}=20,30um", "--workers", "2")
#: In their order: what one writes, a later one reads.
COMMANDS = {
    "run": ("run", *SHORT, "--no-figures", "--no-report", "-o", "run"),
    "sweep": ("sweep", *SHORT, *SWEPT, "--summary-only", "-o", "sweep"),
    "find": ("find", *SHORT, "--vary", f"{RADIAL}=20..30um", "--until", "offset_max_um=22", "--json"),
    "fit": ("fit", *SHORT, *FITTED, "--starts", "1", "--no-profiles", "--json"),
    "compare": ("compare", "run", "run", "--json"),
    "report": ("report", "run"),
}
MEASURED = "time [s],drive_moment.main [N m]\n" + "".join(
    f"{1e-3 * k:g},{138.0 + 0.1 * k:g}\n" for k in range(1, 19)
)

TIMES = ("wall_time_s", "real_time_factor")
TIMED = re.compile(r'"(wall_time_s|real_time_factor|time_s|seconds)": [^,\n]*')


def environment(system: str, home: Path) -> dict[str, str]:
    """Return the variables of a process as if elsewhere, with a console of Western Europe."""
    there = {
        **{"ELSEWHERE": system, "PYTHONPATH": str(HOOK)},
        **{"PYTHONIOENCODING": "cp1252:strict", "PYTHONWARNDEFAULTENCODING": "1"},
    }
    known = {"HOME": str(home), "USERPROFILE": str(home), "XDG_CACHE_HOME": str(Path.home() / ".cache")}
    return os.environ | known | there


def begun(arguments: Sequence[str], system: str, folder: Path) -> subprocess.Popen[str]:
    """Return a process of Python that has begun in a folder as if elsewhere."""
    return subprocess.Popen(
        [sys.executable, *arguments],
        cwd=folder,
        env=environment(system, folder),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="cp1252",
    )


ALL = """
import json, sys
from tribodyn.cli.main import main
for name, command in json.loads(sys.argv[1]).items():
    print("####", name, flush=True)
    assert main(command) == 0, name
"""


def done_in(home: Path, system: str) -> dict[str, str]:
    """Return what each command prints, all run by one process in a home."""
    home.mkdir()
    (home / "run.csv").write_text(MEASURED, encoding="utf-8")
    with begun(["-c", ALL, json.dumps(COMMANDS)], system, home) as process:
        out, err = process.communicate(timeout=LONG)
    assert process.returncode == 0, err
    parts = (part.partition("\n") for part in out.split("#### ")[1:])
    return {name: TIMED.sub("", printed) for name, _, printed in parts}


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Return the folder in which each command has run here, and what each printed."""
    home = tmp_path_factory.mktemp("here")
    (home / "run.csv").write_text(MEASURED, encoding="utf-8")
    printed = {}
    with contextlib.chdir(home):
        for name, command in COMMANDS.items():
            with contextlib.redirect_stdout(io.StringIO()) as stream:
                assert main(list(command)) == 0
            printed[name] = TIMED.sub("", stream.getvalue())
    return home, printed


@pytest.mark.long  # `make check` runs it
@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_commands_compute_the_same_elsewhere(system, here, tmp_path):
    home = tmp_path / "Jörg Müller"
    printed = done_in(home, system)
    for name in ("find", "fit", "compare"):
        assert printed[name] == here[1][name]
    for result, dropped in (("run/result.nc", ()), ("sweep/sweep.nc", TIMES)):
        with xr.open_dataset(home / result) as found, xr.open_dataset(here[0] / result) as known:
            xr.testing.assert_equal(*(of.drop_vars(dropped, errors="ignore") for of in (found, known)))
    written, known_files = (
        {path.relative_to(root) for path in root.rglob("*.*")} for root in (home, here[0])
    )
    assert {path for path in written if ".cache" not in path.parts} >= known_files


@pytest.mark.long  # `make check` runs it
@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_ctrl_c_saves_what_was_computed_elsewhere(system: str, tmp_path: Path) -> None:
    command = ["run", "slider-crank", "--set", "run.cycles=400", "--no-figures", "--no-report", "-o", "long"]
    with begun(["-m", "tribodyn", *command], system, tmp_path) as process:
        assert process.stderr is not None
        while " 10 %" not in (line := process.stderr.readline()):
            assert line, "the run ended before it could be stopped"
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=LONG)
    assert process.returncode == 1
    assert "saved in long" in said
    assert "Traceback" not in said
    assert (tmp_path / "long/result.nc").is_file()


@pytest.mark.long  # `make check` runs it
@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_the_workbench_begins_and_ends_elsewhere(system: str, tmp_path: Path) -> None:
    command = ["workbench", "slider-crank", "--json", "--workers", "1"]
    with begun(["-m", "tribodyn", *command], system, tmp_path) as process:
        assert process.stdout is not None
        address = json.loads("".join(process.stdout.readline() for _ in range(3)))["address"]
        assert ("localhost" in address) == (system == "win32")
        with asked(address) as answer:
            assert answer.status == 200
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=LONG)
    assert process.returncode == 0, said
    assert "Traceback" not in said


@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_two_cannot_write_into_one_folder_elsewhere(system: str, tmp_path: Path) -> None:
    program = (
        "from pathlib import Path\nfrom tribodyn.core.platforms import locked\n"
        "with locked(Path('.')) as mine: print(mine, flush=True); input()"
    )
    with begun(["-c", program], system, tmp_path) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "True\n"
        with begun(["-c", program], system, tmp_path) as other:
            assert other.communicate("\n", timeout=LONG)[0] == "False\n"
        process.communicate("\n", timeout=LONG)


def test_one_module_asks_which_system_this_is() -> None:
    asked = re.compile(
        r"\b(sys\.platform|os\.name\b|platform\.system|fcntl|msvcrt|import resource|geteuid|getuid"
        r"|O_DIRECTORY|pthread_sigmask|signal\.SIGHUP|os\.fork|sched_getaffinity)"
    )
    found = {
        str(path.relative_to(SOURCES))
        for path in SOURCES.rglob("*.py")
        if asked.search(path.read_text(encoding="utf-8"))
    }
    assert found == {"core/platforms.py"}
