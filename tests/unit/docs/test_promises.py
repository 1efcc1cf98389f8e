"""The page of promises names tests that exist, and leaves out no sentence of the README."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "developer" / "promises.md"
SECTIONS = {"The README", "The interface"}
UNTESTED = "no test:"


def plain(text: str) -> str:
    """Return a text without its marks: links, code, emphasis, line breaks."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return " ".join(re.sub(r"[`*]", "", text).split())


def units(text: str) -> list[str]:
    """Return everything that a page says: sentences, lines of code, rows of tables."""
    found = []
    for block in re.split(r"\n\s*\n", text):
        if block.startswith("    "):
            found += [plain(line) for line in block.splitlines()]
        elif block.startswith("|"):
            found += [plain(row.strip("|").replace(" | ", " ")) for row in block.splitlines()[2:]]
        elif not block.startswith(("#", "![")):
            for item in re.split(r"^- ", block, flags=re.MULTILINE):
                sentences = re.split(r"(?<=[.!?]) (?=[A-Z`\[])", " ".join(item.split()))
                found += [plain(sentence) for sentence in sentences]
    return [unit for unit in found if unit]


def promises(section: str) -> dict[str, list[str]]:
    """Return what stands under each promise of a section of the page, by the words quoted."""
    text = PAGE.read_text(encoding="utf-8").split(f"\n## {section}\n")[1].split("\n## ")[0]
    found: dict[str, list[str]] = {}
    text = re.sub(r"^### .*$", "", text, flags=re.MULTILINE)
    for item in re.split(r"^- ", text, flags=re.MULTILINE)[1:]:
        quote, *below = re.split(r"^  - ", item, flags=re.MULTILINE)
        found[plain(quote)] = [" ".join(line.split()) for line in below]
    return found


@cache
def functions_in(path: str) -> frozenset[str]:
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    return frozenset(node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


@pytest.mark.parametrize("section", sorted(SECTIONS))
def test_every_promise_stands_beside_a_test_that_exists(section: str) -> None:
    for quote, below in promises(section).items():
        assert below, f"nothing stands under: {quote}"
        for line in below:
            if line.startswith(UNTESTED):
                assert len(line) > len(UNTESTED) + 10, f"say why: {quote}"
                continue
            path, _, name = line.strip("`").partition("::")
            assert (ROOT / path).is_file(), line
            assert name.startswith("test_"), line
            assert name in functions_in(path), line


def test_every_sentence_of_the_readme_is_listed() -> None:
    """A sentence is listed by its first words, so that a number in it may change."""
    beginnings = [quote.removesuffix("…").strip() for quote in promises("The README")]
    said = units((ROOT / "README.md").read_text(encoding="utf-8"))
    assert len(said) > 40
    assert [unit for unit in said if not any(map(unit.startswith, beginnings))] == []
    assert [words for words in beginnings if not any(unit.startswith(words) for unit in said)] == []


def test_the_page_says_how_much_is_not_tested() -> None:
    listed = [line for section in SECTIONS for below in promises(section).values() for line in below]
    untested = [line for line in listed if line.startswith(UNTESTED)]
    # Lead-ins, and what only a person or another machine can measure.
    assert len(untested) < 0.15 * len(listed)
