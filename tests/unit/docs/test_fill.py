"""Pages of the manual are complete as files: tables of the program and measured numbers stand in them."""

import importlib.util
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from benchmarks.__main__ import NAMES, TARGET

DOCS = Path(__file__).parents[3] / "docs"


@pytest.fixture(scope="module")
def fill() -> Iterator[ModuleType]:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        spec = importlib.util.spec_from_file_location("fill", DOCS / "fill.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        yield module
        for name in [name for name in sys.modules if name.partition(".")[0] == "tables"]:
            del sys.modules[name]


def test_tables_of_pages_are_those_of_the_program(fill: ModuleType) -> None:
    # `make pages` writes them.
    for page in fill.pages():
        text = page.read_text(encoding="utf-8")
        assert fill.filled(text, {}) == text, page


def test_every_table_stands_on_a_page_and_has_rows_of_one_width(fill: ModuleType) -> None:
    texts = {page: page.read_text(encoding="utf-8") for page in fill.pages()}
    shown = {found[2] for text in texts.values() for found in fill.TABLE.finditer(text)}
    from tables import TABLES

    assert shown == set(TABLES)
    assert set(json.loads(TARGET.read_text(encoding="utf-8"))) == set(NAMES)
    for name, table in TABLES.items():
        lines = [line for line in table() if line.startswith("|")]
        assert len(lines) > 2
        if not name.startswith("keys"):
            assert len({line.replace("\\|", "").count("|") for line in lines}) == 1


def test_no_page_needs_the_build_to_be_read(fill: ModuleType) -> None:
    for page in fill.pages():
        text = page.read_text(encoding="utf-8")
        assert "{number}" not in text
        assert all(found[3].strip() not in ("", "?") for found in fill.NUMBER.finditer(text)), page


def test_a_page_is_filled(fill: ModuleType) -> None:
    page = "x <!--= force [N] -->18.4<!--/--> N\n<!-- table: joints -->\nwritten by hand\n<!-- end -->\n"
    new = fill.filled(page, {"force [N]": "18.6"})
    assert "<!--= force [N] -->18.6<!--/-->" in new
    assert "written by hand" not in new
    assert re.search(r"^\| `revolute` \|", new, re.MULTILINE)
    assert fill.filled(new, {"force [N]": "18.6"}) == new


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("18.4", "18.5", True),
        ("18.4", "18.6", False),
        ("1e-4", "2e-4", True),
        ("1e-4", "1e-3", False),
        ("3 to 5", "3 to 6", True),
        ("3 to 5", "3", False),
        ("−0.4", "0.4", False),
    ],
)
def test_a_number_may_be_rounded_on_another_processor(fill, old, new, same):
    assert fill.alike(old, new) == same
