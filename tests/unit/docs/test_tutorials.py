"""Every tutorial, and every guide with code to run, runs as it stands in the manual."""

import re
from pathlib import Path

import matplotlib as mpl
import pytest

DOCS = Path(__file__).parents[3] / "docs"
CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(?::[^\n]*\n)*(.*?)^```", re.MULTILINE | re.DOTALL)
TUTORIALS = sorted((DOCS / "tutorials").glob("*.md"))
GUIDES = [
    path
    for path in (DOCS / "gallery.md", *sorted((DOCS / "guide").glob("*.md")))
    if CELL.search(path.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize("path", [*TUTORIALS, *GUIDES], ids=lambda path: path.stem)
def test_the_page_runs(path, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    names = {"__name__": path.stem}
    cells = CELL.findall(path.read_text(encoding="utf-8"))
    assert cells
    for cell in cells:
        exec(compile(cell, str(path), "exec", dont_inherit=True), names)
