"""Every tutorial runs as it stands in the manual."""

from __future__ import annotations

import re
from pathlib import Path

import matplotlib as mpl
import pytest

FOLDER = Path(__file__).parents[3] / "docs" / "tutorials"
TUTORIALS = sorted(FOLDER.glob("*.md"))
CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)


def test_there_are_tutorials():
    assert len(TUTORIALS) >= 6


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_the_tutorial_runs(path, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    names = {"__name__": path.stem}
    cells = CELL.findall(path.read_text(encoding="utf-8"))
    assert cells
    for cell in cells:
        exec(compile(cell, str(path), "exec", dont_inherit=True), names)
