"""The Python examples of the guide run as they are printed, each page from top to bottom."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

GUIDE = Path(__file__).parents[2] / "docs" / "guide"
PYTHON_BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
EXAMPLES = {
    page.stem: "\n".join(blocks)
    for page in sorted(GUIDE.glob("*.md"))
    if (blocks := PYTHON_BLOCK.findall(page.read_text(encoding="utf-8")))
}


@pytest.fixture(scope="module")
def after_the_demo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder where the demo has been run, shortened."""
    folder = tmp_path_factory.mktemp("guide")
    demo = [sys.executable, "-m", "tribodyn", "run", "vsv", "-o", "out/demo", "--quiet"]
    subprocess.run([*demo, "--set", "run.duration=50 ms"], cwd=folder, check=True)
    return folder


@pytest.mark.parametrize("code", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_guide_example_runs(code: str, after_the_demo: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(after_the_demo)
    monkeypatch.setenv("MPLBACKEND", "agg")
    exec(compile(code, "guide", "exec"), {})
