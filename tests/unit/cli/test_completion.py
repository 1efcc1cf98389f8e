"""What a shell is offered, and the log of a command."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.cli.commands.completion import SHELLS
from tribodyn.cli.main import main


def offered(line: str, tmp_path: Path) -> list[str]:
    """Return what a shell is offered at the end of a line."""
    pytest.importorskip("argcomplete")
    answer = tmp_path / "answer"
    asked = {
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_SHELL": "fish",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": os.fspath(answer),
    }
    subprocess.run([sys.executable, "-m", "tribodyn"], env=os.environ | asked, cwd=tmp_path, check=True)
    return [entry.split("\t")[0].strip() for entry in answer.read_text().splitlines()]


@pytest.mark.parametrize(
    ("line", "some"),
    [
        ("tribodyn sw", {"sweep"}),
        ("tribodyn run vsv --set joint.cl", {"joint.clearance="}),
        ("tribodyn sweep vsv --vary contact.law=", {"contact.law=rsdc", "contact.law=ke"}),
        ("tribodyn run vsv --set wear.feedback=", {"wear.feedback=true", "wear.feedback=false"}),
        ("tribodyn run vsv --no", {"--no-figures", "--no-report"}),
    ],
)
def test_commands_keys_and_values_are_offered(line: str, some: set[str], tmp_path: Path) -> None:
    assert some <= set(offered(line, tmp_path))


@pytest.mark.parametrize("shell", SHELLS)
def test_lines_for_a_shell(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("argcomplete")
    assert main(["completion", shell]) == 0
    assert "tribodyn" in capsys.readouterr().out


def test_a_log_holds_what_was_done_and_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = tmp_path / "work.log"
    assert main(["check", "vsv", "-v", "--log", os.fspath(log)]) == 0
    assert "s in all" in capsys.readouterr().err
    assert main(["check", "vsv", "--set", "joint.clearanc=1", "--log", os.fspath(log)]) == 2
    written = log.read_text(encoding="utf-8")
    assert "vsv: valid" in written
    assert "nearest valid one is joint.clearance" in written
    assert main(["cases", "--log", os.fspath(tmp_path / "none" / "x")]) == 2
