"""What the README shows works as it stands there."""

import json
import re
import shlex
import subprocess
import sys
import time
import tomllib
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import tribodyn as td
from tribodyn.cli.main import COMMANDS, main
from tribodyn.mechanisms.catalogue import parse_case

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CODE_LINES = [line.strip() for line in TEXT.splitlines() if line.startswith("    ")]
COMMAND_LINES = [
    text.split(" # ")[0].split(" > ")[0]
    for text in [*CODE_LINES, *re.findall(r"`([^`\n]+)`", TEXT)]
    if text.startswith("tribodyn ")
]


def test_every_link_leads_somewhere() -> None:
    links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", TEXT)
    assert len(links) > 10
    assert [link for link in links if "://" not in link and not (ROOT / link).exists()] == []


@pytest.mark.parametrize("line", COMMAND_LINES)
def test_every_command_is_understood(line, monkeypatch, tmp_path, capsys):
    """Its options are those of the command, and what it sets can be set."""
    name, *arguments = shlex.split(line)[1:]
    asked = []
    monkeypatch.setattr(COMMANDS[name], "execute", lambda args: asked.append(args) or 0)
    assert main([name, *arguments]) == 0
    case = getattr(asked[0], "case", None)
    if case and not case.endswith(".toml"):
        changes = [f"--set={change}" for change in getattr(asked[0], "changes", [])]
        assert main(["check", case, *changes]) == 0


def test_the_lines_of_python_run() -> None:
    lines = ["import tribodyn as td", *(line for line in CODE_LINES if line.startswith("result = "))]
    names: dict[str, object] = {}
    exec(compile("\n".join(lines), "README", "exec"), names)
    result = names["result"]
    assert isinstance(result, xr.Dataset)
    assert result.attrs["clearance"] == 40e-6
    assert not result.attrs["failure"]


def test_installing_gives_the_command_on_python_3_11() -> None:
    module, function = PROJECT["scripts"]["tribodyn"].split(":")
    assert PROJECT["requires-python"] == ">=3.11"
    # As the script does that an installer writes.
    script = f"import sys; from {module} import {function}; sys.exit({function}())"
    version = subprocess.run([sys.executable, "-c", script, "--version"], capture_output=True, text=True)
    assert version.stdout == f"tribodyn {td.__version__}\n"


def test_the_licence_is_the_one_named() -> None:
    assert PROJECT["license"] == "BSD-3-Clause"
    assert f"Licence: {PROJECT['license']}" in TEXT
    assert "BSD 3-Clause" in (ROOT / "LICENSE").read_text(encoding="utf-8")


def test_the_demo_is_several_times_faster_than_its_motion() -> None:
    case = td.load_case("vsv")
    td.simulate(case.replace({"run.duration": "10 ms"}))  # compiles, or finds what was compiled
    began = time.thread_time()
    td.simulate(case.replace({"run.cycles": 0.5}))
    # A twelfth is said; a slow machine may take four times as long.
    assert time.thread_time() - began < 3.15 / 3.0


def test_every_wrong_equation_has_what_was_built_instead_and_why() -> None:
    lines = (ROOT / "docs" / "theory" / "errata.md").read_text(encoding="utf-8").splitlines()
    rows = [
        [cell.strip() for cell in line.strip("|").split(" | ")] for line in lines if line.startswith("| ")
    ]
    assert rows[0] == ["where", "printed", "built", "why"]
    assert len(rows) > 15
    assert all(len(row) == 4 and all(row) for row in rows)


def test_the_ratio_to_another_program_is_the_stored_one() -> None:
    stored = json.loads((ROOT / "docs" / "_static" / "benchmarks.json").read_text(encoding="utf-8"))
    ratios = sorted(at["ratio"] for at in stored["mechanism"]["ratios"])
    assert f"takes Exudyn {ratios[0]:.2g} to {ratios[-1]:.2g} times as long" in TEXT


def test_joints_with_clearance_are_those_listed() -> None:
    from tribodyn.mechanism.joints import JOINTS

    (real,) = re.findall(r"Clearance exists in ([^;]*) joints; others have none", TEXT)
    assert set(re.split(", | and ", real)) == {name for name, kind in JOINTS.items() if kind.SHAPE}


def test_there_are_as_many_validation_sets_as_it_says() -> None:
    from tribodyn.validation import NAMES

    assert len(NAMES) == 17
    assert "Seventeen measured sets" in TEXT


def test_the_mechanism_is_a_dozen_lines_and_runs() -> None:
    found = re.search(r"^    bar = \{.*?^    motion = [^\n]*", TEXT, flags=re.MULTILINE | re.DOTALL)
    assert found is not None
    lines = [line[4:] for line in found[0].splitlines()]
    assert len(lines[1:-1]) <= 12
    names: dict[str, Any] = {"td": td}
    exec(compile("\n".join(lines), "README", "exec"), names)
    motion = names["motion"]
    assert motion.attrs["failure"] == ""
    assert [*motion["joint"].values] == ["main", "crankpin", "wrist", "guide"]
    assert motion.tribodyn.plot.orbit(joint="wrist").axes
    assert names["press"].case() == parse_case(names["press"].case().to_toml(), "README")
