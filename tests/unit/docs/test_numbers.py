"""Numbers inside sentences of the manual: each is measured, and each that is measured stands on a page."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from tribodyn.papers.cheng_2022 import Runs

DOCS = Path(__file__).parents[3] / "docs"
ROLE = re.compile(r"\{number\}`([^`]+)`")


@pytest.fixture(scope="module")
def measured() -> ModuleType:
    spec = importlib.util.spec_from_file_location("measured", DOCS / "plots" / "measured.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_pages_and_measurements_name_the_same_numbers(measured: ModuleType) -> None:
    pages = [path for path in DOCS.rglob("*.md") if "_build" not in path.parts]
    used = {name for page in pages for name in ROLE.findall(page.read_text(encoding="utf-8"))}
    assert used == set(measured.NUMBERS)


def test_numbers_of_the_issue_come_out(measured: ModuleType) -> None:
    # Cheap ones, with the digits that the pages show: a page cannot contradict a run any more.
    runs = Runs()
    assert float(measured.NUMBERS["damping heat, 20 µm [mJ]"](runs)) == pytest.approx(0.62, abs=0.02)
    assert float(measured.NUMBERS["stiffness at 9 MPa [MPa/µm]"](runs)) == pytest.approx(15.2, abs=0.1)
    assert float(measured.NUMBERS["elastic-plastic share, h* = 2 [%]"](runs)) == pytest.approx(98.2, abs=0.1)
