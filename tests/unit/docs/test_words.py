"""Texts for users hold no word of the list: manual, keys, key results, messages, report, workbench."""

import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

from tribodyn.cases.keys import keys_of
from tribodyn.cli.main import COMMANDS
from tribodyn.mechanisms.catalogue import MECHANISMS, kinds
from tribodyn.results.summary import EFFORT

sys.path.insert(0, str(Path(__file__).parent))
from pages import ROOT, name, pages, prose

sys.path.pop(0)

WORDS: dict[str, str] = tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
MESSAGES = ROOT / "tests" / "golden" / "messages.txt"
SOURCES = (".py", ".pyi", ".js", ".css", ".html")
#: What is left of the list in sources: names that kernels have, and a part of names of key results.
LEFT = {
    "records.py": ["books -> energy balance"] * 3,
    "problem.py": ["ledger -> energy balance", "books -> energy balance"],
}
LONGEST = 25  #: Words of the longest sentence there.
MEAN = 16.0


def found(text: str) -> list[str]:
    """Return the words of the list that a text has, each with what to write instead."""
    return [f"{match[0]} -> {WORDS[word]}" for word in WORDS for match in re.finditer(word, text)]


def descriptions() -> Iterator[tuple[str, str]]:
    """Yield what users read of keys, key results, variables and commands, each with its name."""
    for kind, model in kinds().items():
        yield from ((f"{kind}: {key.path}", key.description) for key in keys_of(model).values())
    for kind, mechanism in MECHANISMS.items():
        of_parts = (made("part") for numbers in mechanism.by_part.values() for made in numbers.values())
        for number in (*mechanism.key_results.values(), *of_parts, *EFFORT.values()):
            yield f"{kind}: {number.label}", f"{number.label}. {number.meaning}"
        for variable, about in mechanism.variables.items():
            yield f"{kind}: {variable}", about.long_name
    yield from ((command, module.HELP) for command, module in COMMANDS.items())


def shown() -> Iterator[tuple[str, str]]:
    """Yield what report and workbench show, and the case files to start from, each with its name."""
    source = ROOT / "src" / "tribodyn"
    for path in (*source.rglob("*.html"), *source.glob("mechanisms/*/templates/*.toml")):
        yield path.name, re.sub(r"\{[%{].*?[%}]\}|<[^>]*>", "", path.read_text(encoding="utf-8"))
    for path in source.rglob("assets/*.js"):
        lines = path.read_text(encoding="utf-8").splitlines()
        # Names inside the scripts have no spaces.
        texts = (text for line in lines for text in re.findall(r'"([^"]* [^"]*)"', line))
        yield path.name, "\n".join(texts)
    for kind, mechanism in MECHANISMS.items():
        for chapter in mechanism.chapters:
            captions = (text for section in chapter.sections for text in (section.title, section.caption))
            yield f"{kind}: {chapter.name}", "\n".join((chapter.title, chapter.lead, *captions))


@pytest.mark.parametrize("page", pages(), ids=name)
def test_pages_have_standard_terms(page: Path) -> None:
    assert found(prose(page)) == []


def test_descriptions_have_standard_terms() -> None:
    assert {where: found(text) for where, text in descriptions() if found(text)} == {}


def test_report_workbench_and_templates_have_standard_terms() -> None:
    texts = list(shown())
    assert len(texts) > 40
    assert {where: found(text) for where, text in texts if found(text)} == {}


def test_messages_have_standard_terms() -> None:
    assert found(MESSAGES.read_text(encoding="utf-8")) == []


def test_sources_have_standard_terms() -> None:
    """Names and comments, too; kernels keep theirs, because a change of one compiles all of them anew."""
    files = (
        path for path in (ROOT / "src").rglob("*") if path.suffix in SOURCES and "kernels" not in path.parts
    )
    texts = {path: path.read_text(encoding="utf-8") for path in files}
    assert len(texts) > 400
    assert {path.name: found(text) for path, text in texts.items() if found(text)} == LEFT


def sentences(page: Path) -> list[int]:
    """Return the lengths of the sentences of a page in words, tables and headings left out."""
    text = re.sub(r"^(#|\||:|>|!\[).*$", "\n", prose(page), flags=re.MULTILINE)
    parts = re.split(r"(?<=[.?!:;])\s|\n\s*\n|^\s*- ", re.sub(r"¶", "code", text), flags=re.MULTILINE)
    lengths = (len(re.findall(r"\w[\w'’.-]*", part)) for part in parts)
    return [length for length in lengths if length > 2]


@pytest.mark.parametrize("page", pages(), ids=name)
def test_sentences_are_short(page: Path) -> None:
    lengths = sentences(page)
    assert sum(lengths) <= MEAN * len(lengths)
    assert max(lengths, default=0) <= LONGEST
