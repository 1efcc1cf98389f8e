"""The page on parameters: its model is a case, and its command answers as shown."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from tribodyn.cli.main import main

PAGE = (Path(__file__).parents[3] / "docs" / "guide" / "parameters.md").read_text(encoding="utf-8")


def test_the_crank_is_swept_as_shown(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")  # as wide as the table of the page
    model, command, answer = (
        re.search(pattern, PAGE, re.DOTALL)[1]  # type: ignore[index]
        for pattern in (r"```toml\n(.*?)```", r"\n    tribodyn (sweep .*?)\n", r"```text\n(.*?)```")
    )
    Path("press.toml").write_text(model)
    assert main(shlex.split(command)) == 0
    shown = [_numbers(line) for line in answer.splitlines()]
    printed = [_numbers(line) for line in capsys.readouterr().out.splitlines()]
    for row in shown:
        assert any(row == pytest.approx(other, rel=5e-3) for other in printed), row


def _numbers(line: str) -> list[float]:
    """Return the numbers of a line but the mean power over a cycle, which is zero but for rounding."""
    numbers = map(float, re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?", line))
    return [number for number in numbers if number > 1e-6]
