"""Words of the trade lead to keys, commands and pages that there are."""

from __future__ import annotations

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
