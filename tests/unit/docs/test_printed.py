"""Commands that README and manual show with their answers print these."""

import re
import shlex
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import templates

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SHOWN = re.compile(
    r"^    \$ tribodyn (?P<command>[^\n]*)\n(?P<answer>(?:    (?!\$ )[^\n]*\n)+)", re.MULTILINE
)
#: A file that a page shows after its name.
FILE = re.compile(
    r"^[^\n]*`(?P<name>[\w-]+\.toml)`[^\n]*\n\n```toml\n(?P<text>.*?)^```", re.MULTILINE | re.DOTALL
)
#: Commands that take seconds: ``make check`` runs them, too.
LONG = re.compile(r"allocate .*(wear\.cycles|samples 100)|find |contributions ")
EXAMPLES = [
    pytest.param(
        found["command"],
        found["answer"],
        {file["name"]: file["text"] for file in FILE.finditer(text) if file["name"] in found["command"]},
        id=f"{page.stem}-{found['command'].split()[0]}",
        marks=[pytest.mark.long] if LONG.match(found["command"]) else [],
    )
    for page in PAGES
    if "_build" not in page.parts
    for text in [page.read_text(encoding="utf-8")]
    for found in SHOWN.finditer(text)
]


NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


@pytest.mark.parametrize(("command", "answer", "files"), EXAMPLES)
def test_a_command_answers_as_shown(command, answer, files, monkeypatch, tmp_path, capsys):
    """Every line that is shown is printed, in this order; templates and files of pages are written first."""
    monkeypatch.chdir(tmp_path)
    for name, text in files.items():
        Path(name).write_text(text, encoding="utf-8")
    for name in templates():
        if f" {name}.toml" in command:
            assert main(["new", name]) == 0
    assert main(shlex.split(command)) == 0
    printed = iter(capsys.readouterr().out.splitlines())
    missing = [line for line in answer.splitlines() if not any(alike(line, other) for other in printed)]
    assert missing == []


def alike(line: str, other: str) -> bool:
    """Tell whether two lines have the same words and nearly the same numbers.

    Peaks of impacts move with the rounding of a processor, by 0.05 % here; 2 % leave room.
    """
    (words, numbers), (other_words, other_numbers) = map(_parts, (line, other))
    return words == other_words and numbers == pytest.approx(other_numbers, rel=0.02)


def _parts(line: str) -> tuple[list[str], list[float]]:
    return [part.strip() for part in NUMBER.split(line)], [float(number) for number in NUMBER.findall(line)]
