"""Numbers on pages: each is measured by the build, or listed with what else holds it."""

import importlib.util
import re
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from pages import DOCS, ROOT, name, numbers, pages, prose

sys.path.pop(0)

LIST = Path(__file__).parent / "numbers_by_hand.toml"
LISTED: dict[str, dict[str, list[str]]] = tomllib.loads(LIST.read_text(encoding="utf-8"))
#: Kinds of numbers that no run gives; any other key of the list names the test that holds the number.
KINDS = {"given", "published", "derived", "prototype"}


@pytest.fixture(scope="module")
def measured() -> ModuleType:
    sys.path.insert(0, str(DOCS / "plots"))
    spec = importlib.util.spec_from_file_location("measured", DOCS / "plots" / "measured.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.path.pop(0)
    return module


def test_pages_and_measurements_name_the_same_numbers(measured: ModuleType) -> None:
    texts = (page.read_text(encoding="utf-8") for page in pages())
    used = {number for text in texts for number in re.findall(r"<!--= ([^>]+?) -->", text)}
    assert used == set(measured.NUMBERS)


def on_one_line(text: str) -> str:
    """Return a text as if no line of it were broken."""
    return " ".join(text.split())


def unheld(text: str, snippets: list[str]) -> list[str]:
    """Return the numbers of a text that stand in none of the snippets."""
    text = on_one_line(text)
    flat = [re.escape(on_one_line(snippet)) for snippet in snippets]
    held = [found.span() for snippet in flat for found in re.finditer(snippet, text)]
    return [
        number[0]
        for number in numbers(text)
        if not any(begin <= number.start() and number.end() <= end for begin, end in held)
    ]


@pytest.mark.parametrize("page", pages(), ids=name)
def test_no_number_of_a_page_is_typed_without_something_that_holds_it(page: Path) -> None:
    listed = LISTED.get(name(page), {})
    assert unheld(prose(page), [snippet for snippets in listed.values() for snippet in snippets]) == []


@pytest.mark.parametrize("page", [page for page in pages() if name(page) in LISTED], ids=name)
def test_every_listed_number_stands_on_its_page(page: Path) -> None:
    text = on_one_line(prose(page))
    snippets = [on_one_line(snippet) for of_kind in LISTED[name(page)].values() for snippet in of_kind]
    assert [snippet for snippet in snippets if snippet not in text] == []


def test_what_holds_a_number_exists() -> None:
    assert set(LISTED) <= {name(page) for page in pages()}
    for listed in LISTED.values():
        for holder in set(listed) - KINDS:
            path, _, function = holder.partition("::")
            assert f"def {function}(" in (ROOT / path).read_text(encoding="utf-8"), holder
