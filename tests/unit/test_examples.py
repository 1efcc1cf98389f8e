"""The Python examples of the guide run as they are printed, each page from top to bottom."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

GUIDE = Path(__file__).parents[2] / "docs" / "guide"
PYTHON_BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
EXAMPLES = {
    page.stem: "\n".join(blocks)
    for page in sorted(GUIDE.glob("*.md"))
    if (blocks := PYTHON_BLOCK.findall(page.read_text(encoding="utf-8")))
}


@pytest.mark.parametrize("code", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_guide_example_runs(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "guide", "exec"), {})
