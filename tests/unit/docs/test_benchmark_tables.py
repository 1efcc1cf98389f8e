"""The page on performance is made from stored measurements: tables and figure must be able to read them."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from types import ModuleType

import pytest

from benchmarks.__main__ import NAMES, TARGET
from benchmarks.figure import bars, draw

EXTENSION = Path(__file__).parents[3] / "docs" / "_ext" / "benchmark_tables.py"


@pytest.fixture(scope="module")
def tables() -> ModuleType:
    pytest.importorskip("docutils")
    spec = importlib.util.spec_from_file_location("benchmark_tables", EXTENSION)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_table_has_rows_of_one_width(tables: ModuleType) -> None:
    assert set(json.loads(TARGET.read_text(encoding="utf-8"))) == set(NAMES)
    for source, table in tables.TABLES.values():
        lines = list(table(json.loads(source.read_text(encoding="utf-8"))))
        assert len(lines) > 2
        assert len({line.count("|") for line in lines}) == 1


def test_the_figure_shows_every_peer(tmp_path: Path) -> None:
    found = json.loads(TARGET.read_text(encoding="utf-8"))
    draw(found, tmp_path / "figure.svg")
    drawn = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    for name, _, _ in bars(found):
        assert name in drawn
