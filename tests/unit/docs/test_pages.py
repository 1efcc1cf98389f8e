"""Pages of the manual: every module, trade words, validation sets; the build of the manual runs its code."""

from __future__ import annotations

import importlib.util
import re
import shlex
from argparse import ArgumentParser
from pathlib import Path

import pytest

from tribodyn.cases.keys import keys_of
from tribodyn.cli.main import COMMANDS
from tribodyn.mechanism.elements import ELEMENTS
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.mechanism_case import MechanismCase

ROOT = Path(__file__).parents[3]
EXTENSION = ROOT / "docs" / "_ext" / "reference.py"


def test_every_package_and_module_stands_in_the_reference() -> None:
    spec = importlib.util.spec_from_file_location("reference", EXTENSION)
    assert spec is not None
    assert spec.loader is not None
    reference = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reference)
    source = ROOT / "src"
    files = {
        ".".join(path.relative_to(source).with_suffix("").parts).removesuffix(".__init__")
        for path in source.rglob("*.py")
        if path.name != "__main__.py"
    }
    shown = "".join(reference.page(package) for package in reference.packages())
    missing = [name for name in files - {"tribodyn"} if f".. automodule:: {name}\n" not in shown]
    assert missing == []


#: Files that the examples of the page for contributors make.
EXAMPLES = ("ball_on_plane.py", "belt.py", "oval_bore.py", "stokes.py")
TOPS = ("src", "packages", "tests", "docs", "benchmarks")
DEVELOPERS = ("docs/developer/architecture.md", "CONTRIBUTING.md")


@pytest.mark.parametrize("page", DEVELOPERS)
def test_files_that_pages_for_developers_name_exist(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w/]+\.(?:py|toml))`", text)) - {*EXAMPLES}
    there = [str(path) for top in TOPS for path in (ROOT / top).rglob("*.*")]
    assert len(named) > 20
    missing = [name for name in named if not any(path.endswith(f"/{name}") for path in there)]
    assert missing == []


def test_the_page_on_architecture_is_short() -> None:
    assert len((ROOT / DEVELOPERS[0]).read_text(encoding="utf-8").split()) <= 2000


PAGE = Path(__file__).parents[3] / "docs/guide/words.md"
TEXT = PAGE.read_text(encoding="utf-8")


def test_keys_are_those_of_cases() -> None:
    known = {*keys_of(MechanismCase)}
    tables = {path.rpartition(".")[0] for path in known} | {kind.TABLE + ".NAME" for kind in ELEMENTS}
    keys = re.findall(r"`((?:joints|gears|outputs|bodies|drives|wear|surfaces)\.[a-zA-Z_.]+)`", TEXT)
    assert len(keys) > 10
    shown = {path.replace("*", "NAME") for path in {*known, *tables}}
    assert [key for key in keys if not any(key == path or path.startswith(f"{key}.") for path in shown)] == []
    named = re.findall(r"`\[([a-z_]+)\.NAME\]`", TEXT)
    assert [table for table in named if f"{table}.NAME" not in shown] == []


def test_joints_are_those_of_the_list() -> None:
    assert {*re.findall(r'`type = "([^"]+)"`', TEXT)} <= {*JOINTS}


@pytest.mark.parametrize("command", re.findall(r"`(tribodyn [^`]+)`", TEXT))
def test_commands_are_there(command: str) -> None:
    name, *rest = shlex.split(command.replace("…", ""))[1:]
    parser = ArgumentParser()
    COMMANDS[name].add_arguments(parser)
    options = {option for action in parser._actions for option in action.option_strings}
    assert [word for word in rest if word.startswith("--") and word not in options] == []
