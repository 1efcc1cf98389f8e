"""The page on parameters: its model is a case, and its commands answer as shown; ``make check`` runs it."""

import re
import shlex
from pathlib import Path

import pytest

from tribodyn.cli.main import main

PAGE = (Path(__file__).parents[3] / "docs" / "guide" / "parameters.md").read_text(encoding="utf-8")
MODEL = re.search(r"```toml\n(.*?)```", PAGE, re.DOTALL)[1]  # type: ignore[index]
SHOWN = re.findall(r"\n    tribodyn ([^\n]*press\.toml[^\n]*)\n\n```text\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.long
@pytest.mark.parametrize(("command", "answer"), SHOWN, ids=("sweep", "find", "samples", "wear"))
def test_a_command_answers_as_shown(command, answer, monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    Path("press.toml").write_text(MODEL, encoding="utf-8")
    assert main(shlex.split(command)) == 0
    shown = [_numbers(line) for line in answer.splitlines()]
    printed = [_numbers(line) for line in capsys.readouterr().out.splitlines()]
    for row in shown:
        assert any(row == pytest.approx(other, rel=5e-3) for other in printed), row


def _numbers(line: str) -> list[float]:
    """Return the numbers of a line."""
    return [float(found) for found in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?", line)]
