"""Python examples of the guide, page by page, and of docstrings run as they are printed."""

from __future__ import annotations

import doctest
import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

import tribodyn as td

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs" / "guide"
MODULES = [
    ".".join(path.relative_to(source).with_suffix("").parts).removesuffix(".__init__")
    for source in (ROOT / "src", ROOT / "packages" / "mebdf" / "src")
    for path in sorted(source.rglob("*.py"))
    if "    >>> " in path.read_text(encoding="utf-8")
]
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
    demo = [sys.executable, "-m", "tribodyn", "run", "vsv", "-o", "out/demo", "--quiet", "--no-figures"]
    subprocess.run([*demo, "--set", "run.duration=50 ms"], cwd=folder, check=True)
    return folder


@pytest.mark.parametrize("code", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_guide_example_runs(code: str, after_the_demo: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(after_the_demo)
    monkeypatch.setenv("MPLBACKEND", "agg")
    exec(compile(code, "guide", "exec"), {})


@pytest.fixture(scope="module")
def result() -> xr.Dataset:
    """Return what examples call ``result``."""
    return td.simulate("slider-crank")


@pytest.mark.parametrize("module", MODULES)
def test_examples_in_docstrings_run(module, result, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tribodyn.report.figures._PER_SECOND", 2)  # frames of a film
    found = doctest.testmod(importlib.import_module(module), extraglobs={"result": result})
    assert found.failed == 0 < found.attempted
