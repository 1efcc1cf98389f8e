"""The page on performance is made from stored measurements: tables and figure must be able to read them."""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from benchmarks.__main__ import NAMES, TARGET
from benchmarks.figure import bars, draw

EXTENSIONS = Path(__file__).parents[3] / "docs" / "_ext"


@pytest.fixture(scope="module")
def tables() -> Iterator[ModuleType]:
    pytest.importorskip("docutils")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(EXTENSIONS))
        for module in ("cost_tables", "counted_tables", "solver_tables"):
            importlib.import_module(module).setup(None)
        yield importlib.import_module("benchmark_tables")


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
