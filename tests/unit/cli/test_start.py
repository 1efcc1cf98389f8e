"""Starting the command: quick, light, and helpful."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
import time

import pytest

from tribodyn.cli.main import COMMANDS, main

HEAVY = ("numpy", "numba", "scipy", "pydantic", "pint", "xarray", "matplotlib", "tqdm", "importlib.metadata")


#: Libraries that no run and no sweep of ``vsv`` without figures needs.
UNNEEDED = (
    *("pint", "dask", "matplotlib", "jinja2", "numpy.f2py", "scipy.integrate", "scipy.interpolate"),
    *("scipy.linalg", "scipy.optimize", "scipy.sparse", "scipy.special", "numba.np.arrayobj"),
)


def test_help_imports_nothing_heavy() -> None:
    program = (
        "import sys\nfrom tribodyn.cli.main import main\n"
        "try: main(['--help'])\nexcept SystemExit: pass\n"
        f"print([name for name in {HEAVY!r} if name in sys.modules])"
    )
    output = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout
    assert output.splitlines()[-1] == "[]"


def test_help_answers_in_under_half_a_second() -> None:
    command = [sys.executable, "-c", "from tribodyn.cli.main import main; main(['--help'])"]
    times = []
    # The best of several: other work on the machine only ever adds time.
    for _ in range(5):
        began = time.perf_counter()
        subprocess.run(command, capture_output=True, check=True)
        times.append(time.perf_counter() - began)
    assert min(times) < 0.5


def test_a_home_that_cannot_be_written_to_is_no_matter_to_drawing() -> None:
    program = (
        "import sys; from tribodyn.cli.main import main; main(['cases', '--quiet'])\n"
        "assert 'xarray' not in sys.modules  # half of what importing takes, and there is no result\n"
        "import matplotlib; matplotlib.get_configdir()"
    )
    bare = {name: value for name, value in os.environ.items() if not name.startswith(("MPL", "XDG_"))}
    done = subprocess.run(
        [sys.executable, "-c", program], env=bare | {"HOME": os.devnull}, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_every_command_explains_itself(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main([*([command] if command else []), "--help"])
    assert caught.value.code == 0
    assert "usage: tribodyn" in capsys.readouterr().out


@pytest.mark.parametrize("command", COMMANDS)
def test_the_help_of_a_command_ends_with_an_example_that_is_understood(command, monkeypatch, capsys):
    with pytest.raises(SystemExit):
        main([command, "--help"])
    example = " ".join(capsys.readouterr().out.split()).partition("example: ")[2]
    name, *arguments = shlex.split(example.partition(" > ")[0])[1:]
    assert name == command
    monkeypatch.setattr(COMMANDS[command], "execute", lambda args: 0)
    assert main([name, *arguments]) == 0


def test_the_package_itself_is_light_and_what_stands_behind_its_functions_draws_nothing() -> None:
    program = (
        "import sys, tribodyn\n"
        f"assert not [name for name in {HEAVY!r} if name in sys.modules]\n"
        "assert tribodyn.__version__ and tribodyn.load_case and tribodyn.simulate\n"
        "assert tribodyn.contact.LAWS and tribodyn.integrate.SOLVERS and tribodyn.read\n"
        "assert not {'matplotlib', 'netCDF4'} & sys.modules.keys()\n"
        "import tribodyn.simulation, tribodyn.cases\n"
        "assert callable(tribodyn.simulate) and callable(tribodyn.load_case)\n"
        "assert set(tribodyn.__all__) <= set(dir(tribodyn))\n"
        "try: tribodyn.nonsense\nexcept AttributeError: print('good')"
    )
    output = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout
    assert output == "good\n"


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(["run", "vsv"], marks=pytest.mark.long),
        ["sweep", "vsv", "--vary", "joint.clearance=20 um, 21 um", "--workers", "0"],
    ],
)
def test_a_run_imports_no_library_that_only_some_need(command: list[str]) -> None:
    """Those here took a third of a short run's time; counted in modules, not in seconds."""
    program = (
        "import sys, tempfile\n"
        "from tribodyn.cli.main import main\n"
        "arguments = ['--set', 'run.cycles=0.02', '--no-figures', '--no-report', '--quiet']\n"
        f"assert main([*{command!r}, *arguments, '-o', tempfile.mkdtemp()]) == 0\n"
        f"print([name for name in {UNNEEDED!r} if name in sys.modules], len(sys.modules) < 1500)"
    )
    output = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout
    assert output.splitlines()[-1] == "[] True"
